#pragma once

/// Finding the patch of a volume that holds a point.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "lattice/core/box_tree.h"
#include "lattice/core/progress.h"
#include "lattice/volume/patch_grid.h"
#include "lattice/volume/rest_patches.h"
#include "lattice/volume/volume.h"

namespace espalier {

/// How a point relates to the volume.
enum class PointStatus : std::uint8_t {
  Inside,
  Border,      ///< within 1e-9 of the lattice's diagonal of the volume's boundary, on either side
  Outside,     ///< stays where it is, or follows the boundary if it is in the fringe
  Unconverged  ///< a patch may hold it, but no parameters were found; stays where it is
};

/// "inside", "border", "outside" or "unconverged".
[[nodiscard]] std::string_view name_of(PointStatus status);

/// Where a volume holds a point.
struct Location {
  PointStatus status = PointStatus::Outside;
  std::int32_t patch = -1;  ///< -1: none holds it
  glm::dvec3 uvw{0};        ///< in [0,1]³, or within kLeafReach of it in a leaf
  int n_steps = 0;          ///< of Newton's method in that patch; 0 in an affine one
};

/// The points that patches hold, by patch, then by point: their numbers, patches, and places as in
/// Location.
struct HeldPoints {
  std::vector<PointStatus> status;    ///< #points: of all
  std::vector<std::int32_t> points;   ///< #held
  std::vector<std::int32_t> patches;  ///< #held, ascending
  std::vector<glm::dvec3> uvw;        ///< #held
};

/// How patches are searched; the answers are the same, bit for bit.
enum class PatchSearch {
  Quickest,  ///< by a grid where the patches stand in one (PatchGrid), else by a tree
  Tree       ///< by a tree only: to compare with
};

/// Finds points' places in one volume at rest, which must outlive it. Points that several patches
/// share go to the lowest patch; a point inside is never missed: where Newton's method fails the
/// patch is subdivided. A point that no patch holds goes to the leaf that it lies least beyond, if
/// that is within kLeafReach and not across the volume's boundary.
class PointLocator {
 public:
  /// O(#patches log #patches).
  explicit PointLocator(const Volume& volume, PatchSearch search = PatchSearch::Quickest);

  [[nodiscard]] const Volume& volume() const { return *volume_; }

  /// x: model units, finite. O(log #patches), or O(1) in a grid; does not allocate but where
  /// Newton's method fails.
  [[nodiscard]] Location locate(const glm::dvec3& x) const;

  /// The same for many points, in parallel; the same result for any number of threads. Tells
  /// `progress` "embed".
  [[nodiscard]] std::vector<Location> locate(std::span<const glm::dvec3> points,
                                             const Progress& progress = {}) const;

  /// The same, as a binding wants them.
  [[nodiscard]] HeldPoints hold(std::span<const glm::dvec3> points,
                                const Progress& progress = {}) const;

 private:
  class Query;
  class Holding;

  const Volume* volume_;
  double exact_;   // residual of an exact solution, a length
  double border_;  // within which a point is on the border, a length
  RestPatches patches_;
  PatchGrid grid_;
  BoxTree tree_;
};

}  // namespace espalier
