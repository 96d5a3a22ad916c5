/// Volumes along lines against OpenSubdiv's limit of the cross-section times a cubic B-spline.

#include <gtest/gtest.h>

#include <array>
#include <glm/geometric.hpp>

#include "lattice/subdivision/freeze.h"
#include "lattice/volume/point_locator.h"
#include "tests/support/bfr_oracle.h"
#include "tests/support/families.h"

namespace espalier {
namespace {

/// The uniform cubic B-spline with natural ends at t in [0, n], n intervals; points: n + 1.
glm::dvec3 natural_cubic(const std::vector<glm::dvec3>& points, double t) {
  const int n = static_cast<int>(points.size()) - 1;
  const int first = std::min(static_cast<int>(t), n - 1);
  const auto point = [&](int i) {
    const auto at = [&](int k) { return points[static_cast<std::size_t>(k)]; };
    return i < 0 ? 2.0 * at(0) - at(1) : i > n ? 2.0 * at(n) - at(n - 1) : at(i);
  };
  const double s = t - first;
  return ((1 - s) * (1 - s) * (1 - s) * point(first - 1) +
          (3 * s * s * s - 6 * s * s + 4) * point(first) +
          (-3 * s * s * s + 3 * s * s + 3 * s + 1) * point(first + 1) +
          s * s * s * point(first + 2)) /
         6.0;
}

/// What the volume over an extruded mesh should be: limits across, a cubic along.
class ExtrudedOracle {
 public:
  ExtrudedOracle(const test::Section& section, int layers)
      : n_section_(section.points.size()),
        layers_(layers),
        surface_(static_cast<int>(n_section_), section.faces) {}

  /// Values at the exact parameters of a face and heights 0, 0.3, … controls: layer after layer.
  [[nodiscard]] std::vector<glm::dvec3> values(int face,
                                               std::span<const glm::dvec3> controls) const {
    const std::vector<glm::dvec2> places = surface_.exact_parameters(face);
    std::vector<std::vector<glm::dvec3>> columns(places.size());
    for (std::size_t layer = 0; layer <= static_cast<std::size_t>(layers_); ++layer) {
      const auto limits =
          surface_.limits(face, places, controls.subspan(layer * n_section_, n_section_));
      for (std::size_t i = 0; i < places.size(); ++i) {
        columns[i].push_back(limits[i]);
      }
    }
    std::vector<glm::dvec3> result;
    for (const auto& column : columns) {
      for (const double t : {0.0, 0.3, 1.0, 1.6, 2.0}) {
        result.push_back(natural_cubic(column, t));
      }
    }
    return result;
  }

 private:
  std::size_t n_section_;
  int layers_;
  test::BfrOracle surface_;
};

TEST(FreezeAdaptive, is_along_a_line_the_limit_surface_across_times_a_cubic) {
  constexpr int kLayers = 2;
  for (const test::Section& section : test::irregular_sections()) {
    const SubdivisionLattice lattice = test::prism(section, kLayers);
    const std::vector<glm::dvec3> pose = test::jittered(lattice.rest, 0.5, 8);
    const Volume volume = freeze_adaptive(lattice, {.tolerance = 1e-6});
    const std::vector<glm::dvec3> posed = volume.points(pose);
    const PointLocator locator(volume);
    const ExtrudedOracle oracle(section, kLayers);
    double largest = 0;
    for (std::size_t face = 0; face < section.faces.n_rows(); ++face) {
      const auto rest_values = oracle.values(static_cast<int>(face), lattice.rest);
      const auto posed_values = oracle.values(static_cast<int>(face), pose);
      for (std::size_t i = 0; i < rest_values.size(); ++i) {
        const Location found = locator.locate(rest_values[i]);
        ASSERT_GE(found.patch, 0) << section.name << " face " << face << " sample " << i;
        const BezierPatch patch = volume.bezier(static_cast<std::size_t>(found.patch), posed);
        largest = std::max(largest, glm::distance(patch.value(found.uvw), posed_values[i]));
      }
    }
    EXPECT_LT(largest, 1e-12) << section.name;
  }
}

}  // namespace
}  // namespace espalier
