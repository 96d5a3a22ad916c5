/// Edits of lattices: valid or refused, with pose and tags.

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lattice/build/cells.h"
#include "lattice/build/extrude_faces.h"
#include "lattice/build/primitives.h"
#include "lattice/build/reshape.h"
#include "lattice/build/split.h"
#include "lattice/build/weld.h"
#include "lattice/core/error.h"
#include "lattice/core/parallel.h"
#include "lattice/io/json_lattice.h"
#include "lattice/subdivision/edit.h"
#include "lattice/topology/crease.h"
#include "lattice/topology/validate.h"
#include "tests/support/families.h"
#include "tests/support/random_edits.h"

namespace espalier {
namespace {

using Indices = std::vector<std::int32_t>;

SubdivisionLattice box(int nx, int ny, int nz) {
  return test::lattice_from(make_box({nx, ny, nz}, {0, 0, 0}, {nx, ny, nz}));
}

EdgeId edge_between(const SubdivisionLattice& lattice, const glm::dvec3& a, const glm::dvec3& b) {
  const auto vertex = [&](const glm::dvec3& point) {
    const auto found = std::find(lattice.rest.begin(), lattice.rest.end(), point);
    return VertexId{static_cast<std::int32_t>(found - lattice.rest.begin())};
  };
  return lattice.complex->find_edge(vertex(a), vertex(b));
}

std::int32_t face_at_height(const SubdivisionLattice& lattice, double z) {
  for (const FaceId face : lattice.complex->faces()) {
    const auto loop = lattice.complex->vertices(face);
    if (std::all_of(loop.begin(), loop.end(),
                    [&](VertexId v) { return lattice.rest[v.index()].z == z; })) {
      return face.value;
    }
  }
  return -1;
}

/// Edits that were done, a thousand from each seed; and those that were refused between them.
class RandomEdits : public ::testing::TestWithParam<unsigned> {
 protected:
  void SetUp() override { set_thread_count(1); }  // small loops, many of them
  void TearDown() override { set_thread_count(0); }
};

void expect_sound(const SubdivisionLattice& lattice, bool is_posed, const std::string& what) {
  const std::size_t n = lattice.complex->n_vertices();
  EXPECT_TRUE(validate(lattice.complex->polyhedra(), lattice.rest).empty()) << what;
  EXPECT_EQ(lattice.rest.size(), n);
  EXPECT_EQ(lattice.pose.size(), is_posed ? n : 0) << what;
  EXPECT_EQ(lattice.sharpness.edges.size(), lattice.complex->n_edges());
  EXPECT_EQ(lattice.sharpness.vertices.size(), n);
}

TEST_P(RandomEdits, a_thousand_done_leave_valid_complexes_and_undo_restores_equal_bytes) {
  std::mt19937 random(GetParam());
  std::map<std::string, int> n_done;
  // What undo keeps: the lattices before, and what they were when they were made.
  std::vector<std::pair<SubdivisionLattice, std::string>> before;
  SubdivisionLattice lattice = test::random_seed(random);
  const auto undo_all = [&] {
    for (; !before.empty(); before.pop_back()) {
      EXPECT_EQ(json_text(before.back().first), before.back().second);
    }
  };
  for (int n = 0; n < 1000;) {
    const test::RandomEdit edit = test::random_edit(lattice, random);
    if (!edit.refusal.empty()) {
      continue;
    }
    ++n;
    ++n_done[edit.name];
    expect_sound(edit.result, !lattice.pose.empty(), edit.name);
    before.emplace_back(lattice, json_text(lattice));
    lattice = edit.result;
    if (lattice.complex->n_cells() > 20) {
      undo_all();
      lattice = test::random_seed(random);
    }
  }
  undo_all();
  for (const char* name : {"extrude", "attach", "split", "transform", "weld", "mirror", "delete",
                           "relax", "merge", "crease"}) {
    EXPECT_GT(n_done[name], 2) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomEdits, ::testing::Range(1u, 11u));

TEST(EditedLattice, refuses_with_the_first_defect) {
  const SubdivisionLattice cube = box(1, 1, 1);
  const auto inward = [&] {
    return edited_lattice(cube, extrude_faces_along(mesh_of(cube), Indices{0}, {0.5, 0, 0}, 1));
  };
  try {
    (void)inward();
    FAIL();
  } catch (const LatticeError& error) {
    EXPECT_NE(std::string(error.what()).find("cell"), std::string::npos) << error.what();
  }
}

TEST(EditedLattice, moves_new_vertices_in_a_pose_with_what_they_were_made_from) {
  SubdivisionLattice lattice = box(1, 1, 2);
  lattice.pose = test::jittered(lattice.rest, 0.3, 3);
  const CellMesh mesh = mesh_of(lattice);
  const auto displacement = [](const SubdivisionLattice& l, std::size_t i) {
    return l.pose[i] - l.rest[i];
  };
  const auto near = [](const glm::dvec3& a, const glm::dvec3& b) {
    return glm::distance(a, b) < 1e-15;
  };
  const auto grown = edited_lattice(
      lattice, extrude_faces_along(mesh, Indices{face_at_height(lattice, 2)}, {0, 0, 1}, 1));
  ASSERT_EQ(grown.pose.size(), 16u);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto top = static_cast<std::size_t>(
        std::find(grown.rest.begin(), grown.rest.end(), grown.rest[8 + i] + glm::dvec3(0, 0, 1)) -
        grown.rest.begin());
    EXPECT_TRUE(near(displacement(grown, top), displacement(lattice, 8 + i)));
  }
  const Edited cut = split_layer(mesh, 0, 1, 0.25);
  const auto split = edited_lattice(lattice, cut);
  for (std::size_t i = 12; i < 18; ++i) {
    const auto sources = cut.sources[i];
    ASSERT_EQ(sources.size(), 2u);
    EXPECT_TRUE(
        near(displacement(split, i),
             0.75 * displacement(lattice, static_cast<std::size_t>(sources[0].vertex)) +
                 0.25 * displacement(lattice, static_cast<std::size_t>(sources[1].vertex))));
  }
  const auto both = edited_lattice(lattice, mirror(mesh, {0, 0, 0}, {0, 0, 1}, 1e-9));
  EXPECT_TRUE(near(displacement(both, both.rest.size() - 1),
                   displacement(lattice, 11) * glm::dvec3(1, 1, -1)));
}

TEST(EditedLattice, keeps_automatic_tags_automatic_and_smooth_lattices_smooth) {
  SubdivisionLattice lattice = box(1, 1, 1);
  const auto grow = [](const SubdivisionLattice& l) {
    return edited_lattice(l, extrude_faces_along(mesh_of(l), Indices{5}, {0, 0, 1}, 1));
  };
  SubdivisionLattice grown = grow(lattice);
  EXPECT_EQ(grown.sharpness, automatic_sharpness(*grown.complex));
  lattice.sharpness = smooth_sharpness(*lattice.complex);
  grown = grow(lattice);
  EXPECT_EQ(grown.sharpness, smooth_sharpness(*grown.complex));
}

TEST(EditedLattice, keeps_tags_set_by_hand_on_what_is_left_on_copies_and_on_parts) {
  SubdivisionLattice lattice = box(2, 1, 1);
  const auto tag = [](const SubdivisionLattice& l, const glm::dvec3& a, const glm::dvec3& b) {
    return l.sharpness.edges[edge_between(l, a, b)];
  };
  lattice.sharpness.edges[edge_between(lattice, {0, 0, 0}, {0, 0, 1})] = 2.5f;
  lattice.sharpness.edges[edge_between(lattice, {1, 0, 1}, {1, 1, 1})] = 1.5f;  // smooth before
  lattice.sharpness.vertices[VertexId{0}] = 0;                                  // a corner before
  const CellMesh mesh = mesh_of(lattice);

  const auto less = edited_lattice(lattice, delete_cells(mesh, Indices{1}));
  EXPECT_EQ(tag(less, {0, 0, 0}, {0, 0, 1}), 2.5f);
  EXPECT_EQ(tag(less, {1, 0, 1}, {1, 1, 1}), 1.5f);
  EXPECT_EQ(tag(less, {1, 0, 0}, {1, 1, 0}), 10) << "automatic: on one cell now";
  EXPECT_EQ(less.sharpness.vertices[VertexId{0}], 0);

  const auto split = edited_lattice(lattice, split_layer(mesh, 0, 6, 0.5));
  EXPECT_EQ(tag(split, {0, 0, 0}, {0, 0, 0.5}), 2.5f);
  EXPECT_EQ(tag(split, {0, 0, 0.5}, {0, 0, 1}), 2.5f);
  EXPECT_EQ(tag(split, {2, 0, 0}, {2, 0, 0.5}), 10);

  const auto both = edited_lattice(lattice, mirror(mesh, {2, 0, 0}, {1, 0, 0}, 1e-9));
  EXPECT_EQ(tag(both, {4, 0, 0}, {4, 0, 1}), 2.5f);
  EXPECT_EQ(tag(both, {2, 0, 0}, {2, 0, 1}), 0) << "automatic: on two cells now";

  const auto merged =
      merged_lattice(lattice, test::lattice_from(make_box({1, 1, 1}, {0, 0, 1}, {1, 1, 2})), 1e-6);
  EXPECT_EQ(tag(merged, {0, 0, 0}, {0, 0, 1}), 2.5f);
  EXPECT_EQ(tag(merged, {0, 0, 2}, {0, 1, 2}), 10);
}

TEST(EditedLattice, tags_nothing_inside) {
  SubdivisionLattice lattice = box(2, 2, 1);
  lattice.sharpness.edges[edge_between(lattice, {1, 1, 1}, {1, 2, 1})] = 3;
  const CellMesh mesh = mesh_of(lattice);
  Indices top;
  for (const FaceId face : lattice.complex->faces()) {
    const auto loop = lattice.complex->vertices(face);
    if (std::all_of(loop.begin(), loop.end(),
                    [&](VertexId v) { return lattice.rest[v.index()].z == 1; })) {
      top.push_back(face.value);
    }
  }
  const auto grown = edited_lattice(lattice, extrude_faces_along(mesh, top, {0, 0, 1}, 1));
  EXPECT_EQ(grown.sharpness.edges[edge_between(grown, {1, 1, 1}, {1, 2, 1})], 0);
  EXPECT_EQ(grown.sharpness.edges[edge_between(grown, {1, 1, 2}, {1, 2, 2})], 3);
}

TEST(MergedLattice, is_posed_if_one_is_and_keeps_the_first_one_s_scheme) {
  SubdivisionLattice first = box(1, 1, 1);
  first.scheme = Scheme::MacCrackenJoy;
  SubdivisionLattice second = test::lattice_from(make_box({1, 1, 1}, {1, 0, 0}, {2, 1, 1}));
  second.pose = second.rest;
  for (glm::dvec3& point : second.pose) {
    point += glm::dvec3(0, 0, 4);
  }
  const auto merged = merged_lattice(first, second, 1e-6);
  EXPECT_EQ(merged.scheme, Scheme::MacCrackenJoy);
  ASSERT_EQ(merged.pose.size(), 12u);
  for (std::size_t i = 0; i < 12; ++i) {
    const double shared = merged.rest[i].x;
    EXPECT_EQ(merged.pose[i] - merged.rest[i], glm::dvec3(0, 0, 2 * shared));
  }
}

TEST(BoundaryLine, goes_round_and_ends_where_it_is_not_straight) {
  const SubdivisionLattice lattice = box(2, 2, 2);
  const EdgeId waist = edge_between(lattice, {0, 0, 1}, {1, 0, 1});
  const auto round = boundary_line(*lattice.complex, waist);
  EXPECT_EQ(round.size(), 8u);
  for (const EdgeId edge : round) {
    for (const VertexId vertex : lattice.complex->vertices(edge)) {
      EXPECT_EQ(lattice.rest[vertex.index()].z, 1);
    }
  }
  const EdgeId rim = edge_between(lattice, {0, 0, 0}, {1, 0, 0});
  EXPECT_EQ(boundary_line(*lattice.complex, rim).size(), 2u);  // from corner to corner
  EXPECT_THROW((void)boundary_line(*lattice.complex, edge_between(lattice, {1, 1, 1}, {1, 1, 2})),
               LatticeError);
}

TEST(WithTags, sets_and_clears_on_the_boundary_alone) {
  const SubdivisionLattice lattice = box(2, 2, 2);
  const EdgeId inner = edge_between(lattice, {1, 1, 1}, {1, 1, 2});
  const EdgeId rim = edge_between(lattice, {0, 0, 0}, {1, 0, 0});
  const CellComplex& complex = *lattice.complex;
  const VertexId corner{0};
  const Sharpness tags = with_tags(complex, lattice.sharpness, {&rim, 1}, {&corner, 1}, 0.5f);
  EXPECT_EQ(tags.edges[rim], 0.5f);
  EXPECT_EQ(tags.vertices[corner], 0.5f);
  EXPECT_THROW((void)with_tags(complex, tags, {&inner, 1}, {}, 1), LatticeError);
  const VertexId middle{13};
  EXPECT_THROW((void)with_tags(complex, tags, {}, {&middle, 1}, 1), LatticeError);
  EXPECT_THROW((void)with_tags(complex, tags, {&rim, 1}, {}, -1), ParameterError);
  EXPECT_THROW((void)with_tags(complex, tags, {&rim, 1}, {}, std::nanf("")), ParameterError);
}

}  // namespace
}  // namespace espalier
