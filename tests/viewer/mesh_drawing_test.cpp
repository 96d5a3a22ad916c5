#include "viewer/render/mesh_drawing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <set>

#include "lattice/core/error.h"
#include "lattice/core/parallel.h"

namespace espalier::viewer {
namespace {

using Faces = CompressedRows<std::int32_t>;

const std::vector<glm::dvec3> kCubePoints{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0},
                                          {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
const Faces kCubeFaces{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                       {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};

/// A ring of quadrilaterals around the y axis.
struct Tube {
  std::vector<glm::dvec3> points;
  Faces faces;

  explicit Tube(int n) {
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * M_PI * i / n;
      points.push_back({std::sin(angle), 0, std::cos(angle)});
      points.push_back({std::sin(angle), 1, std::cos(angle)});
      const int next = (i + 1) % n;
      faces.push_back(std::vector<std::int32_t>{2 * i, 2 * next, 2 * next + 1, 2 * i + 1});
    }
  }
};

TEST(MeshDrawing, gives_a_box_flat_faces) {
  const TriangleMesh mesh = draw_mesh(kCubePoints, kCubeFaces);
  ASSERT_EQ(mesh.positions.size(), 24u);
  ASSERT_EQ(mesh.indices.size(), 36u);
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const glm::vec3& a = mesh.positions[mesh.indices[i]];
    const glm::vec3& b = mesh.positions[mesh.indices[i + 1]];
    const glm::vec3& c = mesh.positions[mesh.indices[i + 2]];
    const glm::vec3 outward = (a + b + c) / 3.F - glm::vec3(0.5F);
    const glm::vec3 facet = glm::normalize(glm::cross(b - a, c - a));
    EXPECT_GT(glm::dot(facet, outward), 0);
    for (int k = 0; k < 3; ++k) {
      EXPECT_LE(glm::length(mesh.normals[mesh.indices[i + k]] - facet), 1e-6F);
    }
  }
}

TEST(MeshDrawing, draws_the_same_with_its_vertices_in_another_order) {
  const Tube tube(12);
  const MeshDrawing drawing(tube.points, tube.faces);
  std::vector<std::uint32_t> order(drawing.n_vertices());
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    order[i] = (7 * i + 3) % static_cast<std::uint32_t>(order.size());
  }
  const MeshDrawing reordered = drawing.reordered(order);
  const TriangleMesh before = drawing.triangle_mesh(tube.points);
  const TriangleMesh after = reordered.triangle_mesh(tube.points);
  for (std::size_t i = 0; i < before.indices.size(); ++i) {
    EXPECT_EQ(after.positions[after.indices[i]], before.positions[before.indices[i]]);
    EXPECT_EQ(after.normals[after.indices[i]], before.normals[before.indices[i]]);
  }
}

TEST(MeshDrawing, gives_a_box_one_normal_a_corner_when_nothing_is_a_crease) {
  const TriangleMesh mesh = draw_mesh(kCubePoints, kCubeFaces, {.crease_angle = 180});
  ASSERT_EQ(mesh.positions.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) {
    const glm::vec3 expected = glm::normalize(mesh.positions[i] - glm::vec3(0.5F));
    EXPECT_LE(glm::length(mesh.normals[i] - expected), 1e-6F);
  }
}

TEST(MeshDrawing, is_smooth_below_the_crease_angle_and_split_above) {
  // The faces of an octagonal tube meet at 45°.
  const Tube tube(8);
  const MeshDrawing smooth(tube.points, tube.faces, {.crease_angle = 46});
  EXPECT_EQ(smooth.n_vertices(), 16u);
  EXPECT_EQ(MeshDrawing(tube.points, tube.faces, {.crease_angle = 44}).n_vertices(), 32u);
  const std::vector<glm::vec3> normals = smooth.normals(tube.points);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const glm::dvec3& p = tube.points[smooth.vertex_points()[i]];
    EXPECT_LE(glm::length(normals[i] - glm::vec3(p.x, 0, p.z)), 1e-6F);
  }
}

TEST(MeshDrawing, normals_do_not_depend_on_how_a_face_is_cut) {
  std::vector<std::vector<std::int32_t>> cut;
  for (std::size_t f = 0; f < kCubeFaces.n_rows(); ++f) {
    const auto face = kCubeFaces[f];
    cut.push_back({face[0], face[1], face[2]});
    cut.push_back({face[0], face[2], face[3]});
  }
  Faces cut_faces;
  for (const auto& face : cut) {
    cut_faces.push_back(face);
  }
  const TriangleMesh mesh = draw_mesh(kCubePoints, cut_faces, {.crease_angle = 180});
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::vec3 expected = glm::normalize(mesh.positions[i] - glm::vec3(0.5F));
    EXPECT_LE(glm::length(mesh.normals[i] - expected), 1e-6F);
  }
}

TEST(MeshDrawing, leaves_out_faces_that_cannot_be_drawn) {
  std::vector<glm::dvec3> points = kCubePoints;
  points.push_back({std::numeric_limits<double>::quiet_NaN(), 0, 0});
  const Faces faces{{},         {0},       {0, 1},    {0, 1, 0, 1},   {0, 1, 99},
                    {0, 1, -1}, {0, 1, 8}, {0, 0, 0}, {0, 1, 1, 3, 0}};
  const TriangleMesh mesh = draw_mesh(points, faces);
  ASSERT_EQ(mesh.indices.size(), 3u);
  std::set<std::uint32_t> drawn;
  const MeshDrawing drawing(points, faces);
  for (const std::uint32_t vertex : drawing.triangles()) {
    drawn.insert(drawing.vertex_points()[vertex]);
  }
  EXPECT_EQ(drawn, (std::set<std::uint32_t>{0, 1, 3}));
}

TEST(MeshDrawing, has_zero_normals_where_faces_have_no_area) {
  const std::vector<glm::dvec3> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const TriangleMesh mesh = draw_mesh(points, Faces{{0, 1, 2}});
  ASSERT_EQ(mesh.normals.size(), 3u);
  for (const glm::vec3& normal : mesh.normals) {
    EXPECT_EQ(normal, glm::vec3(0));
  }
}

TEST(MeshDrawing, has_the_same_normals_at_every_scale) {
  const Tube tube(24);
  const std::vector<glm::vec3> expected = MeshDrawing(tube.points, tube.faces).normals(tube.points);
  for (const double scale : {1e-8, 1e8}) {
    std::vector<glm::dvec3> points = tube.points;
    for (glm::dvec3& p : points) {
      p = scale * (p + glm::dvec3(100, -50, 20));
    }
    const std::vector<glm::vec3> normals = MeshDrawing(points, tube.faces).normals(points);
    ASSERT_EQ(normals.size(), expected.size());
    for (std::size_t i = 0; i < normals.size(); ++i) {
      EXPECT_LE(glm::length(normals[i] - expected[i]), 1e-6F);
    }
  }
}

TEST(MeshDrawing, keeps_a_small_shape_far_from_the_origin) {
  std::vector<glm::dvec3> points = kCubePoints;
  Box box;
  for (glm::dvec3& p : points) {
    p += glm::dvec3(1e8);
  }
  box.add(points);
  const MeshDrawingOptions options{.frame = DrawingFrame::of(box)};
  const TriangleMesh mesh = draw_mesh(points, kCubeFaces, options);
  for (const glm::vec3& p : mesh.positions) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(std::abs(p[axis]), 1 / std::sqrt(3.0), 1e-6);
    }
  }
}

TEST(MeshDrawing, follows_points_that_move) {
  const MeshDrawing drawing(kCubePoints, kCubeFaces);
  std::vector<glm::dvec3> turned;
  for (const glm::dvec3& p : kCubePoints) {
    turned.push_back({-p.y, p.x, p.z});
  }
  const auto rest = drawing.triangle_mesh(kCubePoints);
  const auto posed = drawing.triangle_mesh(turned);
  for (std::size_t i = 0; i < rest.positions.size(); ++i) {
    const glm::vec3& p = rest.positions[i];
    const glm::vec3& n = rest.normals[i];
    EXPECT_LE(glm::length(posed.positions[i] - glm::vec3(-p.y, p.x, p.z)), 1e-6F);
    EXPECT_LE(glm::length(posed.normals[i] - glm::vec3(-n.y, n.x, n.z)), 1e-6F);
  }
  EXPECT_EQ(rest.indices, posed.indices);
}

TEST(MeshDrawing, refuses_another_number_of_points) {
  const MeshDrawing drawing(kCubePoints, kCubeFaces);
  const std::vector<glm::dvec3> fewer(7);
  EXPECT_THROW((void)drawing.positions(fewer), ParameterError);
  EXPECT_THROW((void)drawing.normals(fewer), ParameterError);
}

TEST(MeshDrawing, has_the_same_bits_for_any_number_of_threads) {
  const Tube tube(5000);
  set_thread_count(1);
  const TriangleMesh serial = draw_mesh(tube.points, tube.faces);
  set_thread_count(4);
  const TriangleMesh parallel = draw_mesh(tube.points, tube.faces);
  set_thread_count(0);
  EXPECT_EQ(serial.normals, parallel.normals);
  EXPECT_EQ(serial.positions, parallel.positions);
}

}  // namespace
}  // namespace espalier::viewer
