#include "deform/embed/embed.h"

#include <array>

namespace espalier {

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
  HeldPoints held = locator.hold(points, progress);
  return {std::move(held.status),
          std::move(held.points),
          std::move(held.patches),
          std::move(held.uvw),
          {}};
}

Binding embed(const Volume& volume, std::span<const glm::dvec3> points, const Progress& progress) {
  progress.update("embed", 0.0);
  return embed(PointLocator(volume), points, progress);
}

}  // namespace espalier
