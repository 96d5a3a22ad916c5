#include "deform/fit/wrap.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "deform/fit/cell_set.h"
#include "deform/fit/element_grid.h"
#include "deform/fit/enclose.h"
#include "deform/fit/surface_triangles.h"
#include "deform/model/volume_change.h"
#include "lattice/build/offsets.h"
#include "lattice/core/box.h"
#include "lattice/core/error.h"
#include "lattice/core/text_scanner.h"

namespace espalier {
namespace {

// Lengths in steps of the grid.
constexpr double kTouch = 0.125;  // cells so near to the surface belong to it
constexpr double kInside = 0.05;  // by which the model must be inside
constexpr double kGap = 0.03;  // by which split vertices are drawn back; with kInside below kTouch

/// A grid round a box with `n` cells along its longest side, and one more all round.
GridFrame frame_round(const Box& box, int n) {
  const glm::dvec3 size = box.max - box.min;
  GridFrame frame;
  // A little more than kTouch, lest rounding touch the cells beyond.
  const double slack = 2 * kTouch + 0.01;
  frame.step = std::max({size.x, size.y, size.z}) / (n - slack);
  for (int axis = 0; axis < 3; ++axis) {
    const double cells = std::ceil(size[axis] / frame.step + slack - 1e-9);
    frame.cells[static_cast<std::size_t>(axis)] = static_cast<int>(cells) + 2;
    frame.origin[axis] = box.center()[axis] - (cells / 2 + 1) * frame.step;
  }
  return frame;
}

/// Unit normals by area; zero where there is none.
std::vector<glm::dvec3> point_normals(const Model& model) {
  std::vector<glm::dvec3> normals(model.points().size(), glm::dvec3(0));
  for (std::size_t face = 0; face < model.faces().n_rows(); ++face) {
    const glm::dvec3 area = area_vector(model.points(), model.faces()[face]);
    for (const std::int32_t point : model.faces()[face]) {
      normals[static_cast<std::size_t>(point)] += area;
    }
  }
  for (glm::dvec3& normal : normals) {
    normal = unit_vector(normal);
  }
  return normals;
}

/// The model's points, and points beside them on both sides of the surface.
std::vector<glm::dvec3> probes_of(const Model& model, double margin) {
  std::vector<glm::dvec3> probes(model.points().begin(), model.points().end());
  const std::vector<glm::dvec3> normals = point_normals(model);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (normals[i] != glm::dvec3(0)) {
      probes.push_back(probes[i] + normals[i] * margin);
      probes.push_back(probes[i] - normals[i] * margin);
    }
  }
  return probes;
}

Box checked_box(const Model& model, int n) {
  if (n < 1 || n > kMostWrapCells) {
    throw ParameterError(fmt::format(
        "wrap: the cells along the longest side are {}, must be 1 to {}", n, kMostWrapCells));
  }
  const Box box = box_of(model.points());
  const glm::dvec3 size = box.max - box.min;
  const double largest = std::max(glm::length(box.min / kLargestCoordinate),
                                  glm::length(box.max / kLargestCoordinate));
  if (!(largest <= 1)) {
    throw ParameterError(
        fmt::format("{}: wrap: a coordinate is beyond {:g}", model.path(), kLargestCoordinate));
  }
  if (!(std::max({size.x, size.y, size.z}) > 1e-9 * kLargestCoordinate * largest)) {
    throw ParameterError(fmt::format(
        "{}: wrap: the model is a single point, or as good as one so far from the origin",
        model.path()));
  }
  return box;
}

/// Where a gap is too narrow to be told, four times as many cells are worth trying.
int cells_to_part(const std::vector<SharedPlace>& shared, const GridFrame& frame, int n) {
  double most = 0;
  for (const SharedPlace& place : shared) {
    most = std::max(most, place.gap > 0 ? n * frame.step * (1 + 2 * kTouch) / place.gap : 4.0 * n);
  }
  return most > kMostWrapCells ? 0 : static_cast<int>(std::ceil(most));
}

}  // namespace

Wrap wrap(const Model& model, int n, const Progress& progress) {
  const GridFrame frame = frame_round(checked_box(model, n), n);
  const std::vector<Triangle> triangles = surface_triangles(model.points(), model.faces());
  const bool has_inside = is_closed(model.points(), model.faces());
  CellSet cells(classify_elements(frame, triangles, has_inside, kTouch, progress));
  const std::vector<glm::dvec3> probes = probes_of(model, kInside * frame.step);
  Wrap result;
  result.step = frame.step;
  result.shared = find_shared_places(cells, triangles, has_inside);
  result.cells_to_part = cells_to_part(result.shared, frame, n);
  for (;;) {
    Enclosure enclosure = enclose(cells.make_cells(kGap), frame, probes, progress);
    if (enclosure.lacking.empty()) {
      result.lattice = std::move(enclosure.lattice);
      progress.update("wrap", 1.0);
      return result;
    }
    bool has_changed = false;
    for (const std::size_t node : enclosure.lacking) {
      has_changed = cells.fill_around(frame.place(node)) || has_changed;
    }
    if (!has_changed) {
      throw LatticeError(
          fmt::format("{}: wrap: no valid lattice with {} cells along the longest "
                      "side holds the model; try another number",
                      model.path(), n));
    }
  }
}

}  // namespace espalier
