#pragma once

/// Flat outlines that lattices are swept from.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "lattice/build/cell_mesh.h"
#include "lattice/core/compressed_rows.h"

namespace espalier {

/// A flat mesh of the plane z = 0, faces counter-clockwise. Where a boundary curve has a given
/// radius, its control points lie farther out.
struct Section {
  std::vector<glm::dvec3> points;      ///< model units
  CompressedRows<std::int32_t> faces;  ///< loops of points
};

/// The distances from the centre of the closed uniform cubic B-spline whose control points are the
/// corners of a regular n-gon of radius 1: smallest and largest.
struct RingRadii {
  double inner = 1;
  double outer = 1;
};
[[nodiscard]] RingRadii radii_of_ring(int n);

/// `sectors` triangles round a centre. The boundary curve has the radius.
[[nodiscard]] Section wheel_section(double radius, int sectors);
/// A square of `core` × `core` quadrilaterals, then `rings` round it: an O-grid.
[[nodiscard]] Section o_grid_section(double radius, int core, int rings);
/// `rings` rings of quadrilaterals round a hole. Both boundary curves have their radii.
[[nodiscard]] Section ring_section(double inner_radius, double radius, int sectors, int rings);
/// `n` kites round a centre: tips at `radius`, valleys at `inner_radius`.
[[nodiscard]] Section star_section(double radius, double inner_radius, int n);
/// Two O-grid disks at x = ±length/2, joined by a bar of `cells` quadrilaterals in two rows.
[[nodiscard]] Section barbell_section(double length, double radius, double bar_radius, int cells);

/// Two unit vectors that span the plane across `axis`, a unit vector, right-handed with it.
[[nodiscard]] std::array<glm::dvec3, 2> plane_across(const glm::dvec3& axis);

/// The section moved from one point to another in `layers` steps, across the way, scaled by
/// `scales[0]` at its begin and `scales[1]` at its end. Section point i of step l is vertex
/// i + l·n. from, to: different.
[[nodiscard]] CellMesh sweep_straight(const Section& section, const glm::dvec3& from,
                                      const glm::dvec3& to, const std::array<double, 2>& scales,
                                      int layers);

}  // namespace espalier
