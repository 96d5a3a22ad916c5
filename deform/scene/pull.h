#pragma once

/// Pulling points of models in a scene: the operation `pull`, and what to tell about it.

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "deform/scene/operation.h"

namespace espalier {

/// How a pull went.
struct PullReport {
  struct Pick {
    std::string name;                  ///< "point 3"
    std::optional<std::size_t> index;  ///< of the model; none for a point of its surface
    bool is_image = false;             ///< the mirror image of the pick of that name
    glm::dvec3 place{0};               ///< at rest
    glm::dvec3 residual{0};            ///< goal − place, model units
  };
  struct Group {
    std::string name;           ///< "magnet head"
    std::size_t n_points = 0;   ///< that the lattice holds, mirror images too
    std::size_t n_outside = 0;  ///< that it does not: left out
    double largest_residual = 0;
  };

  std::vector<Pick> picks;  ///< in the order they were given, then the mirror images
  std::vector<Group> groups;
  double step = 1;                         ///< part of the way that was gone
  std::size_t n_added_control_points = 0;  ///< by refining
  bool has_misses = false;  ///< whether the lattice cannot take all points to their goals

  double gain = 0;  ///< how much farther control points move than any point is to

  /// What a person should know: where it stopped, that the lattice is too coarse, and that control
  /// points are thrown far away; empty if all is well.
  [[nodiscard]] std::string sentence() const;
};

struct PulledScene {
  Scene scene;
  PullReport report;
};

/// The scene with the lattice "lattice" posed so that points of the model "model" go where
/// pull_parameters() ask. What is bound to the lattice stays bound unless it was refined. Throws
/// ParameterError as pull_request() and pulled_pose(), and LatticeError beginning with the
/// lattice's name.
[[nodiscard]] PulledScene pull(const Scene& scene, const Arguments& arguments,
                               const Progress& progress = {});

}  // namespace espalier
