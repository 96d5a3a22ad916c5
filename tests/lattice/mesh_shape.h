#pragma once

/// Meshes compared by the places of their elements, whatever their numbers.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include "lattice/build/cell_mesh.h"

namespace espalier::test {

using Place = std::array<double, 3>;
using Places = std::vector<Place>;

struct ShapeByPlace {
  std::multiset<Places> faces;            // each face by its sorted points
  std::multiset<std::set<Places>> cells;  // each cell by its faces
  bool operator==(const ShapeByPlace&) const = default;
};

[[nodiscard]] inline ShapeByPlace shape_by_place(const CellMesh& mesh) {
  const auto places_of = [&](std::size_t face) {
    Places places;
    for (const std::int32_t vertex : mesh.cells.faces[face]) {
      const glm::dvec3& p = mesh.points[static_cast<std::size_t>(vertex)];
      places.push_back({p.x, p.y, p.z});
    }
    std::sort(places.begin(), places.end());
    return places;
  };
  ShapeByPlace shape;
  for (std::size_t face = 0; face < mesh.cells.faces.n_rows(); ++face) {
    shape.faces.insert(places_of(face));
  }
  for (std::size_t cell = 0; cell < mesh.cells.cells.n_rows(); ++cell) {
    std::set<Places> faces;
    for (const std::int32_t half_face : mesh.cells.cells[cell]) {
      faces.insert(places_of(static_cast<std::size_t>(half_face >> 1)));
    }
    shape.cells.insert(faces);
  }
  return shape;
}

/// The sum of the cells' volumes, all of which must be positive; model units³.
[[nodiscard]] inline double volume_of(const CellMesh& mesh) {
  double sum = 0;
  for (std::size_t cell = 0; cell < mesh.cells.cells.n_rows(); ++cell) {
    const double volume = signed_volume(mesh.cells, cell, mesh.points);
    EXPECT_GT(volume, 0);
    sum += volume;
  }
  return sum;
}

}  // namespace espalier::test
