#pragma once

/// Pulling points of a model by a lattice of any type: its pose changes, and, if that is asked for,
/// a hierarchical one is refined until it can do what is wanted [HHK92].

#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "deform/direct/pulled_points.h"
#include "lattice/core/progress.h"
#include "lattice/io/lattice.h"
#include "lattice/volume/volume.h"

namespace espalier {

/// What is wanted of a lattice.
struct PullTask {
  std::vector<PulledPoint> points;  ///< those that aim for places are met first, see Pull
  std::optional<SymmetryPlane> symmetry = {};
  glm::dvec3 plane_point{0};            ///< of the plane that points aim for
  glm::dvec3 plane_normal{0, 0, 1};     ///< of unit length
  std::vector<double> mobilities = {};  ///< as smallest_motion() takes them
  bool is_smooth = false;               ///< by the smoothest motion instead of the smallest
  bool stops_at_fold = false;           ///< go only as far as is certified to fold nothing
  /// Levels to add under points that cannot be taken to their goals, or only by moving control
  /// points more than Pull::kMostGain times as far.
  int most_refinements = 0;
};

/// What came of it.
struct PulledPose {
  Lattice lattice;                    ///< posed; refined if that helps
  std::vector<PulledPoint> points;    ///< those of the task and their mirror images
  std::vector<glm::dvec3> places;     ///< #points, at rest
  std::vector<glm::dvec3> residuals;  ///< #points: what is missing to their goals
  std::vector<char> is_held;          ///< #points: 0 for an optional one outside the lattice
  double step = 1;                    ///< part of the way that was gone
  bool has_misses = false;            ///< the lattice cannot take all points to their goals
  double gain = 0;                    ///< how much farther control points move than any point is to
};

/// Starts from the lattice's pose. volume: what the lattice froze into. model: its points. Throws
/// ParameterError naming points that are outside, that contradict each other, or, for a lattice
/// that is not hierarchical, refinements; LatticeError for a lattice that is singular at rest, and
/// for a pose that is folded where the motion begins, if it is to stop at folds. Tells `progress`
/// "embed".
[[nodiscard]] PulledPose pulled_pose(const Lattice& lattice, std::shared_ptr<const Volume> volume,
                                     std::span<const glm::dvec3> model, PullTask task,
                                     const Progress& progress = {});

}  // namespace espalier
