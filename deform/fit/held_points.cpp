#include "deform/fit/held_points.h"

#include <vector>

#include "deform/embed/embed.h"
#include "deform/embed/fringe.h"

namespace espalier {

std::size_t count_not_held(const Volume& volume, std::span<const glm::dvec3> points,
                           double clearance, const Progress& progress) {
  const StatusCounts counts = embed(volume, points, progress).counts();
  const std::size_t n_outside = counts.outside + counts.unconverged;
  if (n_outside > 0 || clearance <= 0) {
    return n_outside;
  }
  // Asked to follow the boundary from within, they do where it is near.
  const std::vector<PointStatus> as_if_outside(points.size(), PointStatus::Outside);
  return make_fringe(volume, points, as_if_outside, 0.999 * clearance, progress).points.size();
}

}  // namespace espalier
