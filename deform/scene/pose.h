#pragma once

/// Poses: where a lattice's control points are to go.

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "deform/scene/scene.h"

namespace espalier {

/// The pose in a lattice file of any type, else its points. Cells of a subdivision lattice must be
/// a complex; where its points are does not matter. Throws FileError and LatticeError as reading a
/// lattice does.
[[nodiscard]] Pose read_pose(const std::string& path);

/// Where a lattice's control points are to go.
struct ControlPose {
  std::vector<glm::dvec3> points;  ///< #controls, model units
  std::vector<double> weights;     ///< #controls where a NURBS pose changes them, else empty
};

/// A lattice's own pose.
[[nodiscard]] ControlPose own_pose(const Lattice& lattice);

/// The control points of a lattice's own pose, for what follows control points only. name: begins
/// the LatticeError for a pose that changes weights too.
[[nodiscard]] std::vector<glm::dvec3> posed_controls(const std::string& name,
                                                     const Lattice& lattice);

/// What a pose in the scene has for a lattice. Throws LatticeError, saying what differs, unless the
/// pose is meant for such a lattice: of the same cells, or of the same type and axes, or of the
/// same hierarchy.
[[nodiscard]] ControlPose pose_for(const Scene& scene, const std::string& lattice,
                                   const std::string& pose);

}  // namespace espalier
