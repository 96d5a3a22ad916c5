#include "viewer/interact/influence_heat.h"

#include <gtest/gtest.h>

#include "deform/evaluate/displace.h"
#include "deform/scene/operation_text.h"

namespace espalier::viewer {
namespace {

TEST(InfluenceHeat, is_how_far_points_go_when_the_selection_goes_by_one) {
  const Scene scene = apply(parse_call("new box output=a cells=3,2,2"), Scene());
  const Lattice lattice = lattice_in(scene, "a");
  const Volume volume = lattice.freeze();
  const std::vector<glm::dvec3> points = {
      {0.1, 0.2, 0.3}, {0.9, 0.5, 0.5}, {0.5, 0.5, 0}, {2, 2, 2}};
  const auto binding = std::make_shared<const Binding>(embed(volume, points));
  const InfluenceHeat heat(volume, binding);
  const Selection selection = {0, 5, 17};
  std::vector<glm::dvec3> pose(lattice.rest_points().begin(), lattice.rest_points().end());
  for (const std::int32_t control : selection) {
    pose[static_cast<std::size_t>(control)].z += 1;
  }
  const auto moves = point_displacements(volume, *binding, volume.displacements(pose));
  const std::vector<double> weights = heat.of(selection);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(weights[i], moves[i].z, 1e-14);
  }
  EXPECT_EQ(weights[3], 0);
  EXPECT_GT(weights[0], 0);
}

TEST(InfluenceHeat, colours_go_from_blue_to_red) {
  EXPECT_GT(heat_color(0).b, heat_color(0).r);
  EXPECT_GT(heat_color(1).r, heat_color(1).b);
  EXPECT_EQ(heat_color(-3), heat_color(0));
  EXPECT_EQ(heat_color(7), heat_color(1));
  EXPECT_GT(heat_color(0.5).g, heat_color(0.5).r);
}

}  // namespace
}  // namespace espalier::viewer
