#pragma once

/// Lattices from surface meshes: the extrusion tool of [MJ96] section 5, for sections and shells.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lattice/build/cell_mesh.h"
#include "lattice/core/compressed_rows.h"

namespace espalier {

/// Sweeps an open surface mesh along `direction` in `layers` equal steps: every face becomes a
/// stack of prisms, faces between neighbours shared. Points no face uses are left out; vertex i of
/// step l is vertex i + l·n of the result. points: model units; faces: rows of points, any sizes
/// and windings. Throws ParameterError if there are no faces, the mesh is closed, one has fewer
/// than three points or names a point that does not exist, layers is not in 1…10,000, the direction
/// is zero or not finite, or the result has more than 200 million faces; LatticeError naming a face
/// that uses a point twice. Whether it is a valid lattice is for validate() to say.
[[nodiscard]] CellMesh extrude(std::span<const glm::dvec3> points,
                               const CompressedRows<std::int32_t>& faces,
                               const glm::dvec3& direction, int layers);

/// Grows a surface mesh along its normals in `layers` equal steps of `thickness` together, see
/// offsets_along_normals(); numbering as in extrude(). The normals are those of faces that run
/// counter-clockwise; a negative thickness grows to the other side. Throws as extrude(), and
/// LatticeError if two faces run along one edge in the same direction, more than two meet there, or
/// the normals at a point cancel.
[[nodiscard]] CellMesh thicken(std::span<const glm::dvec3> points,
                               const CompressedRows<std::int32_t>& faces, double thickness,
                               int layers);

/// Most faces of the one cell that solid() makes: all its control points move all of its inside,
/// and freezing it takes the square of their number.
inline constexpr std::size_t kMostSolidFaces = 500;

/// The inside of a closed surface mesh as one cell. Points no face uses are left out. Throws
/// ParameterError as extrude() and for more than kMostSolidFaces, LatticeError naming an edge
/// without exactly two faces.
[[nodiscard]] CellMesh solid(std::span<const glm::dvec3> points,
                             const CompressedRows<std::int32_t>& faces);

/// Stacks of prisms between given places of a section's points. faces: of one step, rows of its n
/// points; points: #steps · n, model units, vertex i of step l at i + l·n, every one used. Closed:
/// the last step is joined to the first.
[[nodiscard]] CellMesh stack(std::vector<glm::dvec3> points,
                             const CompressedRows<std::int32_t>& faces, std::size_t n_steps,
                             bool is_closed = false);

/// Throws ParameterError unless layers is in 1…10,000 and the cells that stacks over `n_values`
/// face corners make can be counted.
void check_layers(int layers, std::size_t n_values);
/// Throws ParameterError for a direction that is zero or not finite.
void check_direction(const glm::dvec3& direction);

}  // namespace espalier
