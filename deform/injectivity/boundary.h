#pragma once

/// Whether the boundary of a posed volume meets itself. A pose that is locally injective, and whose
/// boundary does not meet itself, is injective [MO63].
///
/// Certified is: two places of the boundary lie at one point of the pose only if they do at rest.
/// Leaves meet their neighbours only nearly; along these seams, and where faces are as close as
/// 1e-9 of the volume's size along an edge, they count as joined (boundary_seams.h).

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lattice/core/progress.h"
#include "lattice/volume/volume.h"

namespace espalier {

enum class BoundaryVerdict { Simple, Intersecting, Undecided };

/// A place of the boundary.
struct BoundaryPlace {
  std::size_t patch = 0;
  glm::dvec3 uvw{0};
  glm::dvec3 rest{0};  ///< the place at rest, model units
};

/// Two places that a pose brings to one point, where the boundary passes through itself.
struct BoundaryCrossing {
  BoundaryPlace a;
  BoundaryPlace b;
  glm::dvec3 point{0};  ///< model units
};

/// Faces of patches that could not be told apart; of one face if both are the same.
struct UndecidedFaces {
  std::array<std::size_t, 2> patches{};
  std::array<int, 2> faces{};  ///< of index_order.h
};

struct BoundaryReport {
  BoundaryVerdict verdict = BoundaryVerdict::Simple;
  std::size_t n_faces = 0;                  ///< looked at
  std::size_t n_parts = 0;                  ///< that hang together
  std::vector<BoundaryCrossing> crossings;  ///< one a pair of faces, by patch
  std::vector<UndecidedFaces> undecided;    ///< by patch
  /// Whether, if the boundary is simple, no part of the volume lies inside another, and none is
  /// turned inside out: what [MO63] asks for beyond one connected boundary.
  bool is_unnested = true;
};

struct BoundaryOptions {
  std::size_t most_boxes = 4000;       ///< pairs of parts of two faces that may be looked at; once
                                       ///< the boundary is surely not certified, a sixteenth
  std::size_t most_crossings = 100;    ///< after which it stops
  std::size_t most_undecided = 20000;  ///< the same
};

/// Looks at all pairs of faces whose boxes overlap. pose: #controls; pose_weights: those of the
/// volume's points in the pose, or empty: as at rest. Throws ParameterError unless pose is
/// #controls finite points within 1e18, and weights are positive. Some microseconds a face, and
/// more where faces come near each other. The same result for any number of threads. Tells
/// `progress` "boundary".
[[nodiscard]] BoundaryReport check_boundary(const Volume& volume, std::span<const glm::dvec3> pose,
                                            std::span<const double> pose_weights = {},
                                            const BoundaryOptions& options = {},
                                            const Progress& progress = {});

}  // namespace espalier
