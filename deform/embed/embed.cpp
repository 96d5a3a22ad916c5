#include "deform/embed/embed.h"

#include <array>
#include <numeric>

namespace espalier {
namespace {

/// The held points, sorted by patch, then by point. n_patches: of the volume.
Binding sorted_by_patch(const std::vector<Location>& locations, std::size_t n_patches) {
  Binding binding;
  binding.status.reserve(locations.size());
  std::vector<std::size_t> next(n_patches + 1, 0);  // where a patch's next point goes
  for (const Location& location : locations) {
    binding.status.push_back(location.status);
    if (location.patch >= 0) {
      ++next[static_cast<std::size_t>(location.patch) + 1];
    }
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  binding.points.resize(next.back());
  binding.patches.resize(next.back());
  binding.uvw.resize(next.back());
  for (std::size_t i = 0; i < locations.size(); ++i) {
    if (const std::int32_t patch = locations[i].patch; patch >= 0) {
      const std::size_t at = next[static_cast<std::size_t>(patch)]++;
      binding.points[at] = static_cast<std::int32_t>(i);
      binding.patches[at] = patch;
      binding.uvw[at] = locations[i].uvw;
    }
  }
  return binding;
}

}  // namespace

StatusCounts Binding::counts() const {
  std::array<std::size_t, 4> n{};
  for (const PointStatus one : status) {
    ++n[static_cast<std::size_t>(one)];
  }
  return {n[0], n[1], n[2], n[3]};
}

Binding embed(const PointLocator& locator, std::span<const glm::dvec3> points,
              const Progress& progress) {
  progress.update("embed", 0.0);
  return sorted_by_patch(locator.locate(points, progress), locator.volume().n_patches());
}

Binding embed(const Volume& volume, std::span<const glm::dvec3> points, const Progress& progress) {
  progress.update("embed", 0.0);
  return embed(PointLocator(volume), points, progress);
}

}  // namespace espalier
