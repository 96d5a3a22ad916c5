#pragma once

/// How a model that leaves its lattice is joined to the part that stays, or torn from it.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "deform/evaluate/combine.h"
#include "deform/scene/scene.h"

namespace espalier {

/// The scene with a lock for the model's binding to the lattice, which must exist. option: "none";
/// "C0", "C1" or "C2": the boundary faces that the model's edges cross; "C1:0,5,7": these faces, of
/// a subdivision lattice its own, else 6 · patch + side; "C1:u0,w1": of any other lattice all faces
/// of these sides, where u is least and w is most. A lock acts on poses, not on the binding. Throws
/// ParameterError for another option, or faces that are not on the boundary.
[[nodiscard]] Scene with_lock(const Scene& scene, const std::string& model,
                              const std::string& lattice, const std::string& option);

/// The scene with the places known where the bound model leaves the lattice.
[[nodiscard]] Scene with_crossings(const Scene& scene, const std::string& model,
                                   const std::string& lattice);

/// The pose with the control points at rest that a lock keeps still. pose, rest: #controls.
[[nodiscard]] std::vector<glm::dvec3> locked_pose(std::vector<glm::dvec3> pose,
                                                  std::span<const glm::dvec3> rest,
                                                  const Lock& lock);

/// The weights of control points at rest, of a lattice that has them.
[[nodiscard]] std::span<const double> rest_weights(const Lattice& lattice);

/// The same as locked_pose() of the weights of a pose: those that a lock keeps are those at rest.
/// weights: #controls, or empty: then so is the result; rest: as many.
[[nodiscard]] std::vector<double> locked_weights(std::vector<double> weights,
                                                 std::span<const double> rest, const Lock& lock);

/// The model's faces that tear because the lattice moves where they leave it, by more than
/// `tolerance`, model units: ascending, each once. rest, pose: #controls.
[[nodiscard]] std::vector<std::int32_t> torn_faces(const Crossings& crossings,
                                                   std::span<const glm::dvec3> rest,
                                                   std::span<const glm::dvec3> pose,
                                                   const Influence& influence, double tolerance);

}  // namespace espalier
