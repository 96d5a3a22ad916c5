#pragma once

/// Whether a complex makes sense at its rest points, one element at a time.

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lattice/topology/cell_complex.h"
#include "lattice/topology/defect.h"

namespace espalier {

/// Coordinates that are no number, infinite or beyond kLargestCoordinate.
[[nodiscard]] std::vector<Defect> find_bad_coordinates(std::span<const glm::dvec3> points);

/// The points moved and scaled so that their box has its centre at the origin and a diagonal of 1;
/// points that coincide exactly still do. points: finite.
[[nodiscard]] std::vector<glm::dvec3> normalized_points(std::span<const glm::dvec3> points);

/// The points of the functions below are normalized, and `tolerance` is a length at that scale.

/// Edges whose ends coincide.
[[nodiscard]] std::vector<Defect> find_zero_length_edges(const CellComplex& complex,
                                                         std::span<const glm::dvec3> points,
                                                         double tolerance);

/// Cells with two vertices in one place that no edge joins.
[[nodiscard]] std::vector<Defect> find_self_touching_cells(const CellComplex& complex,
                                                           std::span<const glm::dvec3> points,
                                                           double tolerance);

/// Cells whose volume is not positive, to rounding at the cell's own size.
[[nodiscard]] std::vector<Defect> find_inverted_cells(const CellComplex& complex,
                                                      std::span<const glm::dvec3> points);

/// Vertices inside edges and faces that do not contain them; coinciding with a corner is no defect.
/// O(n log n).
[[nodiscard]] std::vector<Defect> find_vertices_inside(const CellComplex& complex,
                                                       std::span<const glm::dvec3> points,
                                                       double tolerance);

}  // namespace espalier
