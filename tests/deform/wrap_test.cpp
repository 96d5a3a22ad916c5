/// wrap() encloses models, keeps limbs apart and never folds.

#include "deform/fit/wrap.h"

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <tuple>

#include "deform/embed/embed.h"
#include "deform/injectivity/boundary.h"
#include "deform/injectivity/injectivity.h"
#include "deform/model/model_file.h"
#include "lattice/core/box.h"
#include "lattice/core/error.h"
#include "lattice/core/parallel.h"
#include "lattice/io/json_lattice.h"
#include "lattice/subdivision/freeze.h"
#include "lattice/topology/validate.h"
#include "tests/deform/surfaces.h"

namespace espalier {
namespace {

using test::Surface;

/// Parts of a complex that no face joins.
std::size_t n_parts(const CellComplex& complex) {
  std::vector<char> is_seen(complex.n_cells(), 0);
  std::size_t n = 0;
  for (const CellId seed : complex.cells()) {
    std::vector<CellId> waiting;
    if (is_seen[seed.index()] == 0) {
      ++n;
      is_seen[seed.index()] = 1;
      waiting.push_back(seed);
    }
    while (!waiting.empty()) {
      const CellId cell = waiting.back();
      waiting.pop_back();
      for (const HalfFaceId side : complex.half_faces(cell)) {
        const CellId next = complex.cell(side.opposite());
        if (next.is_valid() && is_seen[next.index()] == 0) {
          is_seen[next.index()] = 1;
          waiting.push_back(next);
        }
      }
    }
  }
  return n;
}

/// What every wrap must be: valid, with each point inside, and certified one-to-one at rest, as
/// finely as lattices are frozen.
void expect_sound(const Wrap& wrapped, const Model& model, const std::string& what) {
  const SubdivisionLattice& lattice = wrapped.lattice;
  EXPECT_TRUE(validate(lattice.complex->polyhedra(), lattice.rest).empty()) << what;
  const auto volume = std::make_shared<const Volume>(freeze_adaptive(lattice));
  const StatusCounts counts = embed(*volume, model.points()).counts();
  EXPECT_EQ(counts.inside, model.points().size()) << what;
  try {
    const InjectivityCheck check(volume);
    EXPECT_EQ(check.local(lattice.rest).verdict, Verdict::Certified) << what;
  } catch (const LatticeError& error) {
    ADD_FAILURE() << what << ": " << error.what();
  }
}

/// The same, and a boundary that does not meet itself: injective, as a whole.
void expect_injective(const Wrap& wrapped, const Model& model, const std::string& what) {
  expect_sound(wrapped, model, what);
  const Volume volume = freeze_adaptive(wrapped.lattice);
  const BoundaryReport boundary = check_boundary(volume, wrapped.lattice.rest);
  EXPECT_EQ(boundary.verdict, BoundaryVerdict::Simple) << what;
  EXPECT_TRUE(boundary.is_unnested) << what;
}

/// Three limbs on a bar, a hand of sorts: gaps of `gap`.
Surface comb(double gap) {
  // One closed outline of a comb, extruded: 12 corners, two n-gons as ends.
  const double w = 1;
  const std::vector<glm::dvec2> outline = {{0, 0},
                                           {3 * w + 2 * gap, 0},
                                           {3 * w + 2 * gap, 6},
                                           {2 * w + 2 * gap, 6},
                                           {2 * w + 2 * gap, 1},
                                           {2 * w + gap, 1},
                                           {2 * w + gap, 6},
                                           {w + gap, 6},
                                           {w + gap, 1},
                                           {w, 1},
                                           {w, 6},
                                           {0, 6}};
  Surface surface;
  const auto n = static_cast<std::int32_t>(outline.size());
  std::vector<std::int32_t> bottom;
  std::vector<std::int32_t> top;
  for (std::int32_t i = 0; i < n; ++i) {
    const glm::dvec2& p = outline[static_cast<std::size_t>(i)];
    surface.points.emplace_back(p.x, p.y, 0);
    surface.points.emplace_back(p.x, p.y, 1);
    const std::int32_t k = (i + 1) % n;
    surface.faces.push_back(std::array{2 * i, 2 * k, 2 * k + 1, 2 * i + 1});
    bottom.insert(bottom.begin(), 2 * i);
    top.push_back(2 * i + 1);
  }
  surface.faces.push_back(bottom);
  surface.faces.push_back(top);
  return surface;
}

/// Closed models, ours and those of the tests, and cells along their longest side.
class ClosedModels : public ::testing::TestWithParam<std::tuple<std::string, int>> {
 protected:
  static Model model(const std::string& name) {
    const Surface ball = test::sphere_surface({1, 2, 3}, 1, 12);
    const std::map<std::string, Surface> surfaces = {
        {"ball", ball},
        {"two_near_balls", ball.with(test::sphere_surface({3.1, 2, 3}, 1, 12))},
        {"torus", test::torus_surface(2, 0.5, 16)},
        {"plate", test::box_surface({0, 0, 0}, {4, 3, 0.01})},
        {"comb", comb(0.3)}};
    const auto found = surfaces.find(name);
    return found == surfaces.end()
               ? read_model(std::string(ESPALIER_TEST_DATA) + "/" + name + ".obj")
               : found->second.model();
  }
};

TEST_P(ClosedModels, are_enclosed_by_wraps_that_are_certified_injective_at_rest) {
  const auto& [name, n] = GetParam();
  const Model closed = model(name);
  expect_injective(wrap(closed, n), closed, name + " at " + std::to_string(n));
}

std::string name_of_wrap(const ::testing::TestParamInfo<std::tuple<std::string, int>>& test) {
  return std::get<0>(test.param) + "_at_" + std::to_string(std::get<1>(test.param));
}

INSTANTIATE_TEST_SUITE_P(Wrap, ClosedModels,
                         ::testing::Combine(::testing::Values("ball", "two_near_balls", "torus",
                                                              "plate", "comb", "figure", "disk",
                                                              "block"),
                                            ::testing::Values(1, 3, 5)),
                         name_of_wrap);
INSTANTIATE_TEST_SUITE_P(FineWrap, ClosedModels,
                         ::testing::Combine(::testing::Values("two_near_balls", "plate", "comb",
                                                              "figure", "disk", "block"),
                                            ::testing::Values(8)),
                         name_of_wrap);

TEST(Wrap, of_a_box_that_fills_its_cells_is_the_box_grid) {
  const Model model = test::box_surface({0, 0, 0}, {4, 2, 1}).model();
  const Wrap wrapped = wrap(model, 4);
  EXPECT_EQ(wrapped.lattice.complex->n_cells(), 4u * 3 * 2);
  const Box bounds = box_of(wrapped.lattice.rest);
  EXPECT_NEAR(bounds.center().x, 2, 1e-12);
  EXPECT_NEAR(bounds.center().y, 1, 1e-12);
  EXPECT_NEAR(bounds.center().z, 0.5, 1e-12);
}

TEST(Wrap, moves_and_scales_with_the_model) {
  const Surface hand = comb(0.25);
  Surface moved = hand;
  for (glm::dvec3& point : moved.points) {
    point = 4.0 * point + glm::dvec3(8, -16, 32);
  }
  const Wrap wrapped = wrap(hand.model(), 7);
  const Wrap there = wrap(moved.model(), 7);
  ASSERT_EQ(there.lattice.rest.size(), wrapped.lattice.rest.size());
  for (std::size_t i = 0; i < there.lattice.rest.size(); ++i) {
    const glm::dvec3 expected = 4.0 * wrapped.lattice.rest[i] + glm::dvec3(8, -16, 32);
    EXPECT_LT(glm::distance(there.lattice.rest[i], expected), 1e-12);
  }
}

TEST(Wrap, is_the_same_for_any_number_of_threads) {
  const Model model = test::torus_surface(2, 0.5, 24).model();
  set_thread_count(1);
  const std::string one = json_text(wrap(model, 9).lattice);
  set_thread_count(3);
  EXPECT_EQ(json_text(wrap(model, 9).lattice), one);
  set_thread_count(0);
}

TEST(Wrap, keeps_the_hole_of_a_torus_and_fills_the_inside_of_closed_models) {
  const Wrap torus = wrap(test::torus_surface(2, 0.5, 24).model(), 10);
  const CellComplex& complex = *torus.lattice.complex;
  const auto euler = [](const CellComplex& c) {
    return static_cast<long>(c.n_vertices()) - static_cast<long>(c.n_edges()) +
           static_cast<long>(c.n_faces()) - static_cast<long>(c.n_cells());
  };
  EXPECT_EQ(euler(complex), 0);
  const Wrap ball = wrap(test::sphere_surface({0, 0, 0}, 1, 12).model(), 8);
  EXPECT_EQ(euler(*ball.lattice.complex), 1);
  // A ball in a ball, turned inside out: what lies between is inside, the middle is not.
  Surface inner = test::sphere_surface({0, 0, 0}, 0.5, 12);
  CompressedRows<std::int32_t> turned;
  for (std::size_t face = 0; face < inner.faces.n_rows(); ++face) {
    turned.push_back(
        std::vector<std::int32_t>(std::make_reverse_iterator(inner.faces[face].end()),
                                  std::make_reverse_iterator(inner.faces[face].begin())));
  }
  inner.faces = turned;
  const Model shell = test::sphere_surface({0, 0, 0}, 1, 12).with(inner).model();
  EXPECT_EQ(euler(*wrap(shell, 12).lattice.complex), 2);
}

TEST(Wrap, keeps_parts_apart_in_neighbouring_cells_and_lets_them_share_none) {
  // A plane of the grid lies in the middle of the gap, cells on both sides reach to it.
  const Surface bars = test::box_surface({0, 0, 0}, {0.7, 0.7, 8})
                           .with(test::box_surface({1.1, 0, 0}, {1.8, 0.7, 8}));
  const Model model = bars.model();
  const Wrap fine = wrap(model, 16);
  EXPECT_EQ(n_parts(*fine.lattice.complex), 2u);
  EXPECT_TRUE(fine.shared.empty());
  // Here a column of cells lies in the gap, and both bars are too near to it.
  const Surface others =
      test::box_surface({0, 0, 0}, {0.7, 0.7, 8}).with(test::box_surface({1.3, 0, 0}, {2, 0.7, 8}));
  EXPECT_EQ(wrap(others.model(), 16).shared.size(), 1u);
  expect_sound(fine, model, "bars");
}

TEST(Wrap, names_limbs_that_share_cells_though_they_do_not_touch) {
  const Wrap coarse = wrap(comb(0.9).model(), 5);
  ASSERT_FALSE(coarse.shared.empty());
  for (const SharedPlace& place : coarse.shared) {
    EXPECT_GT(place.center.y, 1);  // above the bar, beside a gap
    EXPECT_GT(place.n_cells, 0u);
  }
  ASSERT_GT(coarse.cells_to_part, 5);
  EXPECT_TRUE(wrap(comb(0.9).model(), coarse.cells_to_part).shared.empty());
  EXPECT_TRUE(wrap(test::box_surface({0, 0, 0}, {1, 1, 1}).model(), 5).shared.empty());
}

TEST(Wrap, takes_open_flat_and_scattered_models) {
  Surface open = test::box_surface({0, 0, 0}, {2, 1, 1});
  open.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}};
  Surface flat;
  flat.points = {{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}};
  flat.faces = {{0, 1, 2, 3}};
  Surface needle;
  needle.points = {{0, 0, 0}, {1, 1, 0}, {2, 2, 0}};
  needle.faces = {{0, 1, 2}};
  Surface dust;
  dust.points = {{0, 0, 0}, {1, 2, 3}, {-1, 0.5, 2}};
  Surface fan;  // three faces at an edge, one of them turned
  fan.points = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}};
  fan.faces = {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}};
  for (const Surface& surface : {open, flat, needle, dust, fan}) {
    const Model model = surface.model();
    expect_sound(wrap(model, 5), model, std::to_string(surface.faces.n_rows()) + " faces");
  }
}

TEST(Wrap, refuses_numbers_out_of_range_and_models_without_a_length) {
  const Model box = test::box_surface({0, 0, 0}, {1, 1, 1}).model();
  for (const int n : {-1, 0, 129}) {
    EXPECT_THROW((void)wrap(box, n), ParameterError);
  }
  Surface point;
  point.points = {{1, 2, 3}, {1, 2, 3}};
  EXPECT_THROW((void)wrap(point.model(), 4), ParameterError);
}

TEST(Wrap, can_be_cancelled) {
  const Model box = test::box_surface({0, 0, 0}, {1, 1, 1}).model();
  EXPECT_THROW((void)wrap(box, 4, Progress([](std::string_view, double) { return false; })),
               Cancelled);
}

}  // namespace
}  // namespace espalier
