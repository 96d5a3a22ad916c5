#pragma once

/// Ready-made lattices round points.

#include <array>
#include <glm/vec3.hpp>
#include <span>

#include "lattice/build/inventory.h"
#include "lattice/build/junction.h"
#include "lattice/build/primitives.h"
#include "lattice/tensor/oriented_box.h"

namespace espalier {

/// How a shape is laid.
struct FitOptions {
  bool is_principal = false;  ///< along the points' principal axes instead of the coordinate axes
  int along = -1;  ///< coordinate axis of shapes that have one; -1: as each function says
};

// All give places and sizes such that the ideal shape (the true cylinder, ring, ball …) holds the
// points with `margin`, a length, to spare, and take the counts of cells from `options`. The frozen
// volume is that shape to a few per cent: grow the margin where it must hold all of them. They
// throw ParameterError as extent_of(), or where a shape cannot hold the points.

/// A box, and a grid in it. The box holds the points with exactly that margin.
[[nodiscard]] OrientedBox fitted_box_of(std::span<const glm::dvec3> points, const FitOptions& fit,
                                        double margin);
[[nodiscard]] CellMesh fitted_box_grid(const std::array<int, 3>& cells,
                                       std::span<const glm::dvec3> points, const FitOptions& fit,
                                       double margin);

/// Bars along the longest side.
[[nodiscard]] CylinderOptions fitted(CylinderOptions options, std::span<const glm::dvec3> points,
                                     const FitOptions& fit, double margin);
[[nodiscard]] OGridOptions fitted(OGridOptions options, std::span<const glm::dvec3> points,
                                  const FitOptions& fit, double margin);

/// Rings across the shortest side; the hole is as wide as the points leave it.
[[nodiscard]] AnnulusOptions fitted(AnnulusOptions options, std::span<const glm::dvec3> points,
                                    const FitOptions& fit, double margin);
[[nodiscard]] TorusOptions fitted(TorusOptions options, std::span<const glm::dvec3> points,
                                  const FitOptions& fit, double margin);

[[nodiscard]] SphereOptions fitted(SphereOptions options, std::span<const glm::dvec3> points,
                                   const FitOptions& fit, double margin);

/// Extruded along the shortest side; the valleys at half the radius of the tips.
[[nodiscard]] StarOptions fitted(StarOptions options, std::span<const glm::dvec3> points,
                                 const FitOptions& fit, double margin);
/// Disks at the ends of the longest side, extruded along the shortest.
[[nodiscard]] BarbellOptions fitted(BarbellOptions options, std::span<const glm::dvec3> points,
                                    const FitOptions& fit, double margin);

/// The arms keep their directions: of the places of the centre in the plane of the first two arms,
/// the one that lets them be thinnest.
[[nodiscard]] JunctionOptions fitted(JunctionOptions options, std::span<const glm::dvec3> points,
                                     const FitOptions& fit, double margin);

}  // namespace espalier
