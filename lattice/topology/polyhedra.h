#pragma once

/// Cells as a user, a file or a builder describes them: plain tables that may still be wrong.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lattice/core/compressed_rows.h"

namespace espalier {

/// Polyhedral cells by faces, each face shared by the cells on its two sides.
struct Polyhedra {
  std::int32_t n_vertices = 0;
  CompressedRows<std::int32_t> faces;  ///< a loop of vertices a row
  CompressedRows<std::int32_t> cells;  ///< half-faces a row: 2·face + side, see HalfFaceId
};

/// Polyhedral cells that each bring their own faces.
struct CellLoops {
  std::int32_t n_vertices = 0;
  CompressedRows<std::int32_t> loops;  ///< vertices, counter-clockwise seen from outside the cell
  std::vector<std::uint32_t> cells;    ///< #cells + 1 offsets into the loops
};

/// Loops of hexahedra; corners in the order of index_order.h.
[[nodiscard]] CellLoops hexahedron_loops(std::int32_t n_vertices,
                                         std::span<const std::array<std::int32_t, 8>> cells);

/// Turns loops with the same vertices into one face; faces are numbered by first appearance, and
/// cells keep their order. Indices must be in range. O(n), one bucket sort.
[[nodiscard]] Polyhedra match_faces(CellLoops loops);

/// Cells given as unsigned face indices, side 0 everywhere, for orient().
[[nodiscard]] Polyhedra polyhedra_from_faces(std::int32_t n_vertices,
                                             CompressedRows<std::int32_t> faces,
                                             const CompressedRows<std::int32_t>& cell_faces);

/// Chooses the side of every half-face so that shells are consistently oriented, neighbours lie on
/// opposite sides of their face, and every face-connected part has a positive volume. What cannot
/// be oriented is left for find_structural_defects() to name. Indices must be in range.
/// points: #vertices, model units.
void orient(Polyhedra& polyhedra, std::span<const glm::dvec3> points);

/// Volume enclosed by the half-faces of a cell, each face a fan around its centroid; model units³.
[[nodiscard]] double signed_volume(const Polyhedra& polyhedra, std::size_t cell,
                                   std::span<const glm::dvec3> points);

}  // namespace espalier
