#pragma once

/// How far a locked motion is from joining what stays, in value and derivatives.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "deform/evaluate/displace.h"
#include "deform/model/model_file.h"
#include "deform/scene/bind.h"
#include "deform/scene/lock.h"

namespace espalier::test {

/// Places along z of the line that crosses the border z = 0 of a lattice; the last two are outside.
inline constexpr std::array<double, 6> kHeights = {0, 0.25, 0.5, 0.75, -0.25, -0.5};

/// A model with a strip of faces over (x, y, kHeights) for some (x, y), and a lattice, bound.
inline Scene crossing_scene(const Lattice& lattice, const std::vector<glm::dvec2>& lines) {
  std::string obj;
  for (const glm::dvec2& at : lines) {
    for (const double z : kHeights) {
      obj += fmt::format("v {} {} {}\n", at.x, at.y, z);
    }
    obj += "f -6 -5 -1\nf -4 -3 -2\n";
  }
  Scene scene = with_model({}, "m", parse_model(ModelFormat::Obj, "m.obj", obj));
  return with_bound(with_lattice(std::move(scene), "rest", lattice), "m", "rest",
                    {"adaptive:1e-2", "keep"});
}

/// Jumps across the border: of the motion, and of its first three derivatives along z.
using Jumps = std::array<double, 4>;

/// The motion beyond the border is zero. In the first cells it is a cubic along z, which four
/// values determine.
inline Jumps largest_jumps(const Scene& scene, const std::vector<glm::dvec3>& pose) {
  const BoundModel& bound = scene.bound.at({"m", "rest"});
  const auto rest = bound.volume->rest_controls();
  const auto displacements = bound.volume->displacements(locked_pose(pose, rest, bound.lock));
  const auto moves = point_displacements(*bound.volume, *bound.binding, displacements);
  constexpr double h = 0.25;
  Jumps jumps{};
  for (std::size_t i = 0; i < moves.size(); i += kHeights.size()) {
    const glm::dvec3* f = &moves[i];
    EXPECT_EQ(f[4], glm::dvec3(0));
    const std::array<glm::dvec3, 4> jets = {
        f[0], (-11.0 * f[0] + 18.0 * f[1] - 9.0 * f[2] + 2.0 * f[3]) / (6 * h),
        (2.0 * f[0] - 5.0 * f[1] + 4.0 * f[2] - f[3]) / (h * h),
        (f[3] - 3.0 * f[2] + 3.0 * f[1] - f[0]) / (h * h * h)};
    for (std::size_t k = 0; k < jets.size(); ++k) {
      jumps[k] = std::max(jumps[k], glm::length(jets[k]));
    }
  }
  return jumps;
}

}  // namespace espalier::test
