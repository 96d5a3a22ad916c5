/// Edits of meshes: what they make, and what becomes of the old elements.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "lattice/build/cells.h"
#include "lattice/build/extrude.h"
#include "lattice/build/extrude_faces.h"
#include "lattice/build/primitives.h"
#include "lattice/build/reshape.h"
#include "lattice/build/split.h"
#include "lattice/build/weld.h"
#include "lattice/core/error.h"
#include "lattice/topology/validate.h"
#include "tests/lattice/mesh_shape.h"
#include "tests/support/families.h"

namespace espalier {
namespace {

using test::shape_by_place;
using test::volume_of;
using Indices = std::vector<std::int32_t>;

CellMesh unit_box(int nx, int ny, int nz) {
  return make_box({nx, ny, nz}, {0, 0, 0}, {nx, ny, nz});
}

/// The boundary faces all of whose points satisfy `is_there`, or inner ones too.
template <class IsThere>
Indices faces_where(const CellMesh& mesh, const IsThere& is_there) {
  Indices faces;
  for (std::size_t face = 0; face < mesh.cells.faces.n_rows(); ++face) {
    const auto loop = mesh.cells.faces[face];
    if (std::all_of(loop.begin(), loop.end(), [&](std::int32_t v) {
          return is_there(mesh.points[static_cast<std::size_t>(v)]);
        })) {
      faces.push_back(static_cast<std::int32_t>(face));
    }
  }
  return faces;
}

std::int32_t vertex_at(const CellMesh& mesh, const glm::dvec3& point) {
  const auto found = std::find(mesh.points.begin(), mesh.points.end(), point);
  EXPECT_NE(found, mesh.points.end());
  return static_cast<std::int32_t>(found - mesh.points.begin());
}

void expect_valid(const CellMesh& mesh) {
  const std::vector<Defect> defects = validate(mesh.cells, mesh.points);
  EXPECT_TRUE(defects.empty()) << (defects.empty() ? "" : defects.front().message);
}

template <class Edit>
std::string complaint(const Edit& edit) {
  try {
    (void)edit();
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(ExtrudeFaces, grow_a_cube_into_the_box_grid) {
  CellMesh mesh = unit_box(1, 1, 1);
  const auto at = [](int axis, double place) {
    return [axis, place](const glm::dvec3& p) { return p[axis] == place; };
  };
  mesh = extrude_faces_along(mesh, faces_where(mesh, at(0, 1)), {2, 0, 0}, 2).mesh;
  mesh = extrude_faces_along(mesh, faces_where(mesh, at(1, 1)), {0, 1, 0}, 1).mesh;
  mesh = extrude_faces_along(mesh, faces_where(mesh, at(2, 1)), {0, 0, 3}, 3).mesh;
  expect_valid(mesh);
  EXPECT_EQ(shape_by_place(mesh), shape_by_place(unit_box(3, 2, 4)));
}

TEST(ExtrudeFaces, says_where_old_elements_are_and_what_new_vertices_follow) {
  const CellMesh cube = unit_box(1, 1, 1);
  const Indices top = faces_where(cube, [](const glm::dvec3& p) { return p.z == 1; });
  const Edited edit = extrude_faces_along(cube, top, {0, 0, 2}, 2);
  EXPECT_EQ(edit.map.vertices, (Indices{0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(edit.map.faces, (Indices{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(edit.map.cells, (Indices{0}));
  ASSERT_EQ(edit.sources.n_rows(), 16u);
  for (std::size_t i = 8; i < 16; ++i) {
    ASSERT_EQ(edit.sources[i].size(), 1u);
    const auto source = static_cast<std::size_t>(edit.sources[i][0].vertex);
    EXPECT_EQ(edit.sources[i][0].weight, 1);
    EXPECT_EQ(cube.points[source].z, 1);
    EXPECT_EQ(edit.mesh.points[i].x, cube.points[source].x);
    EXPECT_EQ(edit.mesh.points[i].y, cube.points[source].y);
  }
}

TEST(ExtrudeFaces, outward_keep_the_distance_of_flat_faces_at_edges_and_corners) {
  const CellMesh cube = unit_box(1, 1, 1);
  const Edited edit = extrude_faces_outward(cube, Indices{0, 1, 2, 3, 4, 5}, 0.5, 1);
  expect_valid(edit.mesh);
  EXPECT_EQ(edit.mesh.cells.cells.n_rows(), 7u);
  // The old cube in a shell of six cells that share their sides: a cube of size 2.
  EXPECT_NEAR(volume_of(edit.mesh), 8, 1e-14);
  for (std::size_t i = 8; i < 16; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(std::abs(edit.mesh.points[i][axis] - 0.5), 1, 1e-15);
    }
  }
}

TEST(ExtrudeFaces, between_cells_insert_a_layer_that_takes_its_room_from_the_cells_beyond) {
  const CellMesh box = unit_box(2, 2, 2);
  const Indices middle = faces_where(box, [](const glm::dvec3& p) { return p.z == 1; });
  ASSERT_EQ(middle.size(), 4u);
  for (const double by : {0.5, -0.5}) {
    const Edited edit = extrude_faces_along(box, middle, {0, 0, by}, 1);
    expect_valid(edit.mesh);
    CellMesh expected = unit_box(2, 2, 3);
    for (glm::dvec3& point : expected.points) {
      const std::array<double, 4> heights =
          by > 0 ? std::array{0.0, 1.0, 1.5, 2.0} : std::array{0.0, 0.5, 1.0, 2.0};
      point.z = heights[static_cast<std::size_t>(point.z)];
    }
    EXPECT_EQ(shape_by_place(edit.mesh), shape_by_place(expected));
    EXPECT_TRUE(std::equal(edit.map.cells.begin(), edit.map.cells.end(),
                           Indices{0, 1, 2, 3, 4, 5, 6, 7}.begin()));
  }
}

TEST(ExtrudeFaces, refuse_inner_faces_whose_rim_is_inside_or_that_are_parallel) {
  const CellMesh box = unit_box(2, 2, 2);
  const Indices one =
      faces_where(box, [](const glm::dvec3& p) { return p.z == 1 && p.x <= 1 && p.y <= 1; });
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(complaint([&] {
              return extrude_faces_along(box, one, {0, 0, 0.5}, 1);
            }),
            "extrude: the lattice cannot be opened at vertex 10: inner faces must reach the "
            "boundary all round");
  EXPECT_EQ(complaint([&] {
              return extrude_faces_along(box, one, {1, 0, 0}, 1);
            }),
            "extrude: inner face " + std::to_string(one[0]) + " is parallel to the direction");
  EXPECT_EQ(complaint([&] {
              return extrude_faces_along(box, Indices{}, {1, 0, 0}, 1);
            }),
            "extrude: faces: none is given");
  EXPECT_EQ(complaint([&] {
              return extrude_faces_along(box, Indices{36}, {1, 0, 0}, 1);
            }),
            "extrude: face 36 does not exist, there are 36");
  EXPECT_EQ(complaint([&] {
              return extrude_faces_along(box, Indices{1, 1}, {1, 0, 0}, 1);
            }),
            "extrude: face 1 is given twice");
}

/// Sections of a ring of square cross-section, `n` of them, a whole turn apart.
CellMesh open_ring(int n_sections, int n_round) {
  const test::Section section = test::grid_section(1, 1);
  std::vector<glm::dvec3> points;
  for (int step = 0; step < n_sections; ++step) {
    const double angle = 2 * std::numbers::pi * step / n_round;
    for (const glm::dvec3& p : section.points) {
      points.emplace_back((3 + p.x) * std::cos(angle), (3 + p.x) * std::sin(angle), p.y);
    }
  }
  return stack(points, section.faces, static_cast<std::size_t>(n_sections));
}

TEST(BridgeFaces, close_a_ring_without_twist_from_any_start) {
  constexpr int kRound = 7;
  const CellMesh open = open_ring(kRound, kRound);
  CellMesh closed = open;
  const auto n = static_cast<std::int32_t>(open.points.size());
  ASSERT_EQ(n, 4 * kRound);
  const CellComplex complex(open.cells);
  Indices ends;
  for (const FaceId face : complex.faces()) {
    const auto loop = complex.vertices(face);
    if (std::all_of(loop.begin(), loop.end(), [](VertexId v) { return v.value < 4; }) ||
        std::all_of(loop.begin(), loop.end(), [n](VertexId v) { return v.value >= n - 4; })) {
      ends.push_back(face.value);
    }
  }
  ASSERT_EQ(ends.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    std::swap(ends[0], ends[1]);
    const Edited edit = bridge_faces(open, ends[0], ends[1]);
    expect_valid(edit.mesh);
    // As stacked in a closed ring.
    const CellMesh expected = stack(open.points, test::grid_section(1, 1).faces, kRound, true);
    EXPECT_EQ(shape_by_place(edit.mesh), shape_by_place(expected));
  }
}

TEST(BridgeFaces, join_faces_that_look_the_same_way_by_an_arch_and_neighbours_by_a_wedge) {
  CellMesh towers = side_by_side(unit_box(1, 1, 1), make_box({1, 1, 1}, {2, 0, 0}, {3, 1, 1}));
  const Indices tops = faces_where(towers, [](const glm::dvec3& p) { return p.z == 1; });
  ASSERT_EQ(tops.size(), 2u);
  // Flat, since both tops are in one plane: refused by validation, but paired without twist.
  for (glm::dvec3& point : towers.points) {
    point.z += point.z > 0 ? (point.x == 0 || point.x == 3 ? 1.0 : 0.0) : 0.0;
  }
  const Edited arch = bridge_faces(towers, tops[0], tops[1]);
  expect_valid(arch.mesh);
  EXPECT_NEAR(volume_of(arch.mesh), 3 + 2, 1e-14);  // a trapezoid: (3 + 1) / 2 of height 1

  const CellMesh corner = [] {
    const CellMesh box = unit_box(2, 1, 2);
    return delete_cells(box, Indices{3}).mesh;
  }();
  const Indices across =
      faces_where(corner, [](const glm::dvec3& p) { return p.z == 1 && p.x >= 1; });
  const Indices up = faces_where(corner, [](const glm::dvec3& p) { return p.x == 1 && p.z >= 1; });
  ASSERT_EQ(across.size() + up.size(), 2u);
  const Edited wedge = bridge_faces(corner, across[0], up[0]);
  expect_valid(wedge.mesh);
  EXPECT_EQ(wedge.mesh.cells.cells.n_rows(), 4u);
  EXPECT_EQ(wedge.mesh.cells.cells[3].size(), 5u);
  EXPECT_NEAR(volume_of(wedge.mesh), 3.5, 1e-14);
}

TEST(BridgeFaces, names_what_it_refuses) {
  const CellMesh prism =
      test::mesh_from_loops({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
                            {{{0, 1, 2}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}});
  EXPECT_EQ(complaint([&] { return bridge_faces(prism, 0, 2); }),
            "attach: face 0 has 3 vertices and face 2 has 4; only faces of equal size are bridged");
  EXPECT_EQ(complaint([&] { return bridge_faces(prism, 0, 0); }), "attach: face 0 is given twice");
  const CellMesh box = unit_box(2, 1, 1);
  const Indices inner = faces_where(box, [](const glm::dvec3& p) { return p.x == 1; });
  EXPECT_EQ(complaint([&] { return bridge_faces(box, inner[0], inner[0] == 0 ? 1 : 0); }),
            "attach: face " + std::to_string(inner[0]) +
                " is between two cells, only boundary faces can be attached to");
}

TEST(AddSpannedCell, makes_the_hull_of_faces_and_vertices_and_shares_faces) {
  // The missing corner of a box: three faces, or one and the vertex opposite.
  const CellMesh box = unit_box(2, 2, 2);
  const CellMesh notched = delete_cells(box, Indices{7}).mesh;
  const Indices walls = faces_where(notched, [](const glm::dvec3& p) {
    return p.x >= 1 && p.y >= 1 && p.z >= 1 && (p.x == 1 || p.y == 1 || p.z == 1);
  });
  ASSERT_EQ(walls.size(), 3u);
  const Edited filled = add_spanned_cell(notched, walls, {});
  expect_valid(filled.mesh);
  EXPECT_EQ(filled.mesh.cells.cells[7].size(), 7u);  // three squares, four triangles
  EXPECT_NEAR(volume_of(filled.mesh), 8 - 1.0 / 6, 1e-14);

  const Indices wall =
      faces_where(notched, [](const glm::dvec3& p) { return p.x == 1 && p.y >= 1 && p.z >= 1; });
  ASSERT_EQ(wall.size(), 1u);
  const Edited pyramid = add_spanned_cell(notched, wall, Indices{vertex_at(notched, {2, 2, 1})});
  EXPECT_EQ(pyramid.mesh.cells.cells[7].size(), 5u);
  EXPECT_NEAR(volume_of(pyramid.mesh), 7 + 1.0 / 3, 1e-14);
}

TEST(AddSpannedCell, joins_free_vertices_and_keeps_warped_faces_whole) {
  CellMesh towers = side_by_side(unit_box(1, 1, 1), make_box({1, 1, 1}, {2, 0, 0}, {3, 1, 1}));
  const std::int32_t raised = vertex_at(towers, {1, 1, 1});
  towers.points[static_cast<std::size_t>(raised)].z = 1.25;  // a side is no longer flat
  towers.points[static_cast<std::size_t>(raised)].x = 0.9;
  const Indices left =
      faces_where(towers, [](const glm::dvec3& p) { return p.x >= 0.9 && p.x <= 1; });
  const Indices right = faces_where(towers, [](const glm::dvec3& p) { return p.x == 2; });
  ASSERT_EQ(left.size() + right.size(), 2u);
  const Edited edit = add_spanned_cell(towers, Indices{left[0], right[0]}, {});
  expect_valid(edit.mesh);
  EXPECT_EQ(CellComplex(edit.mesh.cells)
                .n_cells(FaceId{edit.map.faces[static_cast<std::size_t>(left[0])]}),
            2);
}

TEST(AddSpannedCell, refuses_what_spans_no_volume) {
  const CellMesh box = unit_box(1, 1, 1);
  EXPECT_EQ(complaint([&] {
              return add_spanned_cell(box, {}, Indices{0, 1, 2, 3});
            }),
            "attach: the chosen faces and vertices span no volume");
  EXPECT_EQ(complaint([&] { return add_spanned_cell(box, {}, {}); }),
            "attach: faces: none is given");
  EXPECT_EQ(complaint([&] {
              return add_spanned_cell(box, {}, Indices{0, 8});
            }),
            "attach: vertex 8 does not exist, there are 8");
}

TEST(Weld, of_two_boxes_is_one) {
  const CellMesh left = unit_box(2, 2, 2);
  const CellMesh right = make_box({1, 2, 2}, {2, 0, 0}, {3, 2, 2});
  const CellMesh apart = side_by_side(left, right);
  expect_valid(apart);
  const Edited edit = weld(apart, 1e-6);
  expect_valid(edit.mesh);
  EXPECT_EQ(shape_by_place(edit.mesh), shape_by_place(unit_box(3, 2, 2)));
  EXPECT_EQ(edit.mesh.points.size(), apart.points.size() - 9);
  for (std::size_t i = 0; i < apart.points.size(); ++i) {
    const auto now = static_cast<std::size_t>(edit.map.vertices[i]);
    EXPECT_EQ(edit.mesh.points[now], apart.points[i]);
  }
}

TEST(Weld, moves_close_vertices_to_their_mean_and_nothing_else) {
  CellMesh apart = side_by_side(unit_box(1, 1, 1), make_box({1, 1, 1}, {1, 0, 0}, {2, 1, 1}));
  for (std::size_t i = 8; i < 16; ++i) {
    apart.points[i].x += 0.125;
  }
  const Edited edit = weld(apart, 0.125);
  expect_valid(edit.mesh);
  ASSERT_EQ(edit.mesh.points.size(), 12u);
  for (const glm::dvec3& point : edit.mesh.points) {
    EXPECT_TRUE(point.x == 0 || point.x == 1.0625 || point.x == 2.125) << point.x;
  }
  EXPECT_EQ(weld(apart, 0.12).mesh.points, apart.points);
  EXPECT_EQ(complaint([&] { return weld(apart, -1); }),
            "the tolerance must be a length, 0 or more");
  EXPECT_NE(complaint([&] { return weld(apart, std::nan("")); }), "");
}

TEST(Weld, lets_cells_without_extent_vanish) {
  const CellMesh box = make_box({3, 1, 1}, {0, 0, 0}, {3, 1, 1});
  CellMesh thin = box;
  for (glm::dvec3& point : thin.points) {
    point.x = point.x > 1 ? point.x - 0.999 : point.x;
  }
  const Edited edit = weld(thin, 0.01);
  expect_valid(edit.mesh);
  EXPECT_EQ(edit.map.cells, (Indices{0, -1, 1}));
  EXPECT_EQ(edit.mesh.points.size(), 12u);
}

TEST(Mirror, of_half_a_box_is_the_box) {
  const CellMesh half = unit_box(2, 1, 2);
  const Edited edit = mirror(half, {2, 0, 0}, {3, 0, 0}, 1e-9);
  expect_valid(edit.mesh);
  EXPECT_EQ(shape_by_place(edit.mesh), shape_by_place(unit_box(4, 1, 2)));
  EXPECT_EQ(edit.map.cells, (Indices{0, 1, 2, 3}));
  EXPECT_EQ(edit.turns.back(), glm::dmat3(-1, 0, 0, 0, 1, 0, 0, 0, 1));
  EXPECT_EQ(complaint([&] {
              return mirror(half, {0, 0, 0}, {0, 0, 0}, 0);
            }),
            "mirror: the normal must be finite and not zero");
}

TEST(DeleteCells, leaves_no_loose_elements_and_at_least_a_cell) {
  const CellMesh box = unit_box(3, 1, 1);
  const Edited edit = delete_cells(box, Indices{2, 0});
  EXPECT_EQ(shape_by_place(edit.mesh), shape_by_place(make_box({1, 1, 1}, {1, 0, 0}, {2, 1, 1})));
  EXPECT_EQ(edit.map.cells, (Indices{-1, 0, -1}));
  EXPECT_EQ(edit.map.vertices[0], -1);
  EXPECT_EQ(edit.map.vertices[1], 0);
  EXPECT_EQ(complaint([&] {
              return delete_cells(box, Indices{0, 1, 2});
            }),
            "delete: no cell would be left");
}

TEST(SplitLayer, of_a_box_is_the_finer_box) {
  const CellMesh box = unit_box(2, 2, 1);
  const Edited edit = split_layer(box, vertex_at(box, {2, 1, 0}), vertex_at(box, {1, 1, 0}), 0.25);
  expect_valid(edit.mesh);
  CellMesh expected = unit_box(3, 2, 1);
  for (glm::dvec3& point : expected.points) {
    point.x = std::array{0.0, 1.0, 1.75, 2.0}[static_cast<std::size_t>(point.x)];
  }
  EXPECT_EQ(shape_by_place(edit.mesh), shape_by_place(expected));
  // Cell 1 keeps the part at (2, 1, 0).
  const auto lower = CellComplex(edit.mesh.cells).vertices(CellId{edit.map.cells[1]});
  for (const VertexId vertex : lower) {
    EXPECT_GE(edit.mesh.points[vertex.index()].x, 1.75);
  }
}

TEST(SplitLayer, passes_rings_and_wedges) {
  const CellMesh ring = stack(open_ring(7, 7).points, test::grid_section(1, 1).faces, 7, true);
  const Edited round = split_layer(ring, 0, 1, 0.5);
  expect_valid(round.mesh);
  EXPECT_EQ(round.mesh.cells.cells.n_rows(), 14u);
  EXPECT_NEAR(volume_of(round.mesh), volume_of(ring), 1e-13);

  const CellMesh wedges = make_cylinder({});
  const Edited along = split_layer(wedges, 0, 9, 0.5);
  expect_valid(along.mesh);
  EXPECT_EQ(along.mesh.cells.cells.n_rows(), 40u);
  EXPECT_EQ(complaint([&] { return split_layer(wedges, 1, 2, 0.5); }).substr(0, 34),
            "split: the layer runs into face 0,");
}

TEST(SplitLayer, names_what_it_refuses) {
  const CellMesh box = unit_box(1, 1, 1);
  EXPECT_EQ(complaint([&] { return split_layer(box, 0, 3, 0.5); }), "split: there is no edge 0-3");
  EXPECT_EQ(complaint([&] { return split_layer(box, 0, 8, 0.5); }), "split: there is no edge 0-8");
  EXPECT_EQ(complaint([&] { return split_layer(box, 0, 1, 1); }),
            "split: at is 1, must be between 0 and 1");
  EXPECT_NE(complaint([&] { return split_layer(box, 0, 1, std::nan("")); }), "");
  // A ring whose section is turned by a quarter at its seam: its one layer comes back to itself.
  CellMesh twisted = open_ring(8, 8);
  CellLoops loops{static_cast<std::int32_t>(twisted.points.size()), {}, {0}};
  const auto section = std::array<std::int32_t, 4>{0, 1, 3, 2};
  for (std::int32_t step = 0; step < 8; ++step) {
    Indices lower;
    Indices upper;
    for (std::size_t i = 0; i < 4; ++i) {
      lower.push_back(4 * step + section[i]);
      upper.push_back(step < 7 ? 4 * (step + 1) + section[i] : section[(i + 1) % 4]);
    }
    for (const VertexLoop& loop : prism_loops(lower, upper)) {
      loops.loops.push_back(loop);
    }
    loops.cells.push_back(static_cast<std::uint32_t>(loops.loops.n_rows()));
  }
  twisted.cells = match_faces(loops);
  orient(twisted.cells, twisted.points);
  EXPECT_NE(complaint([&] { return split_layer(twisted, 0, 1, 0.5); }), "");
}

TEST(Placed, turns_moves_and_scales_vertices_about_a_point) {
  const CellMesh box = unit_box(1, 1, 1);
  Indices all(8);
  for (std::size_t i = 0; i < 8; ++i) {
    all[i] = static_cast<std::int32_t>(i);
  }
  Placement placement{rotation({0, 0, 2}, 90) * 2.0, {1, 1, 1}, {0, 0, 5}};
  const Edited edit = placed(box, all, placement);
  expect_valid(edit.mesh);
  for (std::size_t i = 0; i < 8; ++i) {
    const glm::dvec3 p = box.points[i] - glm::dvec3(1);
    const glm::dvec3 expected = glm::dvec3(-2 * p.y, 2 * p.x, 2 * p.z) + glm::dvec3(1, 1, 6);
    EXPECT_LT(glm::distance(edit.mesh.points[i], expected), 1e-14);
  }
  EXPECT_EQ(edit.map.faces, (Indices{0, 1, 2, 3, 4, 5}));
  // A reflection is a valid lattice too.
  placement.linear = glm::dmat3(-1, 0, 0, 0, 1, 0, 0, 0, 1);
  expect_valid(placed(box, all, placement).mesh);
  EXPECT_NE(complaint([&] { return rotation({0, 0, 0}, 90); }), "");
  placement.by.x = std::nan("");
  EXPECT_EQ(complaint([&] { return placed(box, all, placement); }),
            "transform: all numbers must be finite");
}

TEST(Relaxed, makes_a_shaken_grid_regular_and_keeps_its_boundary) {
  const CellMesh box = unit_box(3, 3, 3);
  const CellComplex complex(box.cells);
  CellMesh shaken = box;
  const std::vector<glm::dvec3> noisy = test::jittered(box.points, 0.2, 1);
  for (const VertexId vertex : complex.vertices()) {
    if (!complex.is_boundary(vertex)) {
      shaken.points[vertex.index()] = noisy[vertex.index()];
    }
  }
  // Harmonic coordinates are linear; the slowest mode halves at each step.
  const Edited edit = relaxed(shaken, 60);
  for (std::size_t i = 0; i < box.points.size(); ++i) {
    EXPECT_LT(glm::distance(edit.mesh.points[i], box.points[i]), 1e-15);
  }
  EXPECT_EQ(complaint([&] { return relaxed(box, 0); }), "relax: steps is 0, must be 1 to 10000");
}

}  // namespace
}  // namespace espalier
