#include "deform/evaluate/volume_boundary.h"

#include <array>

#include "deform/evaluate/weights.h"

namespace espalier {
namespace {

/// Adds the grid of places and loops of one face.
void add_face(const Volume& volume, std::size_t patch, int face, Binding& places,
              BoundarySurface& surface) {
  const int across = face / 2;
  const int side = face % 2;
  // The axes along the face, such that loops in their order turn counter-clockwise from outside.
  const int s = (across + (side == 1 ? 1 : 2)) % 3;
  const int t = (across + (side == 1 ? 2 : 1)) % 3;
  const std::array<int, 3> degree = volume.degree(patch);
  const int n_s = degree[static_cast<std::size_t>(s)] + 1;
  const int n_t = degree[static_cast<std::size_t>(t)] + 1;
  const auto first = static_cast<std::int32_t>(places.points.size());
  for (int j = 0; j <= n_t; ++j) {
    for (int i = 0; i <= n_s; ++i) {
      glm::dvec3 uvw(side);
      uvw[s] = static_cast<double>(i) / n_s;
      uvw[t] = static_cast<double>(j) / n_t;
      places.points.push_back(static_cast<std::int32_t>(places.points.size()));
      places.patches.push_back(static_cast<std::int32_t>(patch));
      places.uvw.push_back(uvw);
    }
  }
  for (int j = 0; j < n_t; ++j) {
    for (int i = 0; i < n_s; ++i) {
      const std::int32_t corner = first + i + (n_s + 1) * j;
      const std::int32_t above = corner + n_s + 1;
      surface.quads.push_back(std::array{corner, corner + 1, above + 1, above});
      surface.faces.push_back(static_cast<std::int32_t>(6 * patch) + face);
    }
  }
}

}  // namespace

BoundarySurface boundary_surface(const Volume& volume) {
  Binding places;
  BoundarySurface surface;
  for (std::size_t patch = 0; patch < volume.n_patches(); ++patch) {
    for (int face = 0; face < 6; ++face) {
      if (volume.patch(patch).is_on_boundary(face)) {
        add_face(volume, patch, face, places, surface);
      }
    }
  }
  places.status.assign(places.points.size(), PointStatus::Border);
  surface.points = control_weights(volume, places);
  return surface;
}

}  // namespace espalier
