#include "lattice/build/primitives.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lattice/build/section.h"
#include "lattice/core/error.h"
#include "lattice/core/text_scanner.h"

namespace espalier {
namespace {

constexpr double kMostCells = 20e6;

bool is_coordinate(const glm::dvec3& point) {
  const auto is_good = [](double x) { return std::abs(x) <= kLargestCoordinate; };
  return is_good(point.x) && is_good(point.y) && is_good(point.z);
}

void check(const CylinderOptions& options) {
  if (!is_coordinate(options.from) || !is_coordinate(options.to) || options.from == options.to) {
    throw ParameterError("cylinder: 'from' and 'to' must be finite and differ");
  }
  if (!(options.radius > 0) || options.radius > kLargestCoordinate) {
    throw ParameterError("cylinder: the radius must be positive");
  }
  if (!(options.end_radius >= 0) || options.end_radius > kLargestCoordinate) {
    throw ParameterError("cylinder: the end radius must be positive, or 0 for the same");
  }
  if (options.sectors < 3 || options.sectors > 1000) {
    throw ParameterError("cylinder: sectors is " + std::to_string(options.sectors) +
                         ", must be 3 to 1000");
  }
  if (options.layers < 1 || options.layers > 10000) {
    throw ParameterError("cylinder: layers is " + std::to_string(options.layers) +
                         ", must be 1 to 10000");
  }
}

}  // namespace

CellMesh make_box(const std::array<int, 3>& cells, const glm::dvec3& min, const glm::dvec3& max) {
  static constexpr std::array<char, 3> kAxes = {'x', 'y', 'z'};
  double total = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const int n = cells[static_cast<std::size_t>(axis)];
    if (n < 1) {
      throw ParameterError("box: " + std::to_string(n) + " cells along " +
                           kAxes[static_cast<std::size_t>(axis)] + ", must be 1 or more");
    }
    if (!is_coordinate(min) || !is_coordinate(max) || !(min[axis] < max[axis])) {
      throw ParameterError(std::string("box: min must be below max along ") +
                           kAxes[static_cast<std::size_t>(axis)] + ", and both finite");
    }
    total *= n;
  }
  if (total > kMostCells) {
    throw ParameterError("box: more than 20 million cells");
  }
  const auto [nx, ny, nz] = cells;
  CellMesh mesh;
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) {
        const glm::dvec3 t(static_cast<double>(i) / nx, static_cast<double>(j) / ny,
                           static_cast<double>(k) / nz);
        mesh.points.push_back(min * (1.0 - t) + max * t);
      }
    }
  }
  const auto vertex = [nx = nx, ny = ny](int i, int j, int k) {
    return i + (nx + 1) * (j + (ny + 1) * k);
  };
  std::vector<std::array<std::int32_t, 8>> hexahedra;
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        std::array<std::int32_t, 8> corners{};
        for (int c = 0; c < 8; ++c) {
          corners[static_cast<std::size_t>(c)] = vertex(i + c % 2, j + c / 2 % 2, k + c / 4);
        }
        hexahedra.push_back(corners);
      }
    }
  }
  mesh.cells =
      match_faces(hexahedron_loops(static_cast<std::int32_t>(mesh.points.size()), hexahedra));
  return mesh;
}

CellMesh make_cylinder(const CylinderOptions& options) {
  check(options);
  const double end_radius = options.end_radius > 0 ? options.end_radius : options.radius;
  return sweep_straight(wheel_section(1, options.sectors), options.from, options.to,
                        {options.radius, end_radius}, options.layers);
}

}  // namespace espalier
