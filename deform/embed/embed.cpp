#include "deform/embed/embed.h"

#include <algorithm>
#include <array>

namespace espalier {
namespace {

/// The held points, sorted by patch, then by point.
Binding sorted_by_patch(const std::vector<Location>& locations) {
  Binding binding;
  binding.status.reserve(locations.size());
  for (std::size_t i = 0; i < locations.size(); ++i) {
    binding.status.push_back(locations[i].status);
    if (locations[i].patch >= 0) {
      binding.points.push_back(static_cast<std::int32_t>(i));
    }
  }
  const auto location = [&](std::int32_t point) -> const Location& {
    return locations[static_cast<std::size_t>(point)];
  };
  std::stable_sort(
      binding.points.begin(), binding.points.end(),
      [&](std::int32_t a, std::int32_t b) { return location(a).patch < location(b).patch; });
  binding.patches.reserve(binding.points.size());
  binding.uvw.reserve(binding.points.size());
  for (const std::int32_t point : binding.points) {
    binding.patches.push_back(location(point).patch);
    binding.uvw.push_back(location(point).uvw);
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
  return sorted_by_patch(locator.locate(points, progress));
}

Binding embed(const Volume& volume, std::span<const glm::dvec3> points, const Progress& progress) {
  progress.update("embed", 0.0);
  return embed(PointLocator(volume), points, progress);
}

}  // namespace espalier
