#include "deform/evaluate/volume_boundary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>

#include "deform/evaluate/weights.h"
#include "lattice/core/error.h"

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

/// Weights of an extraction below this are none.
constexpr double kRoundOff = 1e-14;

/// Which coefficients along its axis the Bézier points of a patch depend on that are at most
/// `n_behind` behind one of its faces.
std::vector<bool> first_layers(const Extraction& extraction, bool is_end, int n_behind) {
  std::vector<bool> is_layer(static_cast<std::size_t>(extraction.n_coefficients), false);
  for (int i = 0; i <= std::min(n_behind, extraction.degree); ++i) {
    for (int k = 0; k < extraction.n_coefficients; ++k) {
      if (std::abs(extraction.row(is_end ? extraction.degree - i : i, k)) > kRoundOff) {
        is_layer[static_cast<std::size_t>(k)] = true;
      }
    }
  }
  return is_layer;
}

void require_boundary_face(const Volume& volume, std::int32_t face) {
  if (face < 0 || static_cast<std::size_t>(face) / 6 >= volume.n_patches()) {
    throw ParameterError("face " + std::to_string(face) +
                         " does not exist: faces are 6 times a patch, of which there are " +
                         std::to_string(volume.n_patches()) + ", plus a side from 0 to 5");
  }
  if (!volume.patch(static_cast<std::size_t>(face / 6)).is_on_boundary(face % 6)) {
    throw ParameterError("face " + std::to_string(face) +
                         " lies between two patches: only boundary faces can be locked");
  }
}

}  // namespace

std::vector<std::int32_t> unmoved_controls(const Volume& volume,
                                           std::span<const std::int32_t> faces,
                                           Continuity continuity) {
  std::set<std::int32_t> controls;
  for (const std::int32_t face : faces) {
    require_boundary_face(volume, face);
    const auto patch = static_cast<std::size_t>(face / 6);
    const auto axis = static_cast<std::size_t>(face % 6 / 2);
    const auto extraction = [&](std::size_t a) -> const Extraction& {
      return volume.extractions()[volume.patch(patch).extractions[a]];
    };
    const std::vector<bool> is_layer =
        first_layers(extraction(axis), face % 2 == 1, static_cast<int>(continuity));
    std::size_t stride = 1;
    for (std::size_t a = 0; a < axis; ++a) {
      stride *= static_cast<std::size_t>(extraction(a).n_coefficients);
    }
    const std::span<const std::int32_t> block = volume.block(patch);
    for (std::size_t i = 0; i < block.size(); ++i) {
      if (is_layer[i / stride % is_layer.size()]) {
        const auto row = volume.stencils()[static_cast<std::size_t>(block[i])];
        controls.insert(row.indices.begin(), row.indices.end());
      }
    }
  }
  return {controls.begin(), controls.end()};
}

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
