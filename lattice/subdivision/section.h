#pragma once

/// The cross-section of a line cell: a Catmull-Clark surface over one quadrilateral, cut into
/// bicubic patches by isolating its extraordinary corners.

#include <array>
#include <cstdint>
#include <vector>

#include "lattice/core/compressed_rows.h"
#include "lattice/volume/extraction.h"
#include "lattice/volume/stencil_table.h"

namespace espalier {

/// Patches of a surface over the vertices of a small quadrilateral mesh.
struct Section {
  struct Patch {
    std::array<double, 2> low{};          ///< of its part of the face's unit square
    double size = 1;                      ///< the side of that part
    std::array<bool, 2> natural_begin{};  ///< by axis
    std::array<bool, 2> natural_end{};
    bool is_leaf = false;           ///< bilinear between its corners' limit positions
    std::array<int, 2> n_points{};  ///< along u and v
  };
  StencilTable points;  ///< over the mesh's vertices
  std::vector<Patch> patches;
  CompressedRows<std::int32_t> blocks;  ///< a row a patch: points, u fastest
};

/// The surface over face 0 of a mesh that holds every face touching it. faces: quadrilaterals,
/// counter-clockwise; face 0 runs (0,0), (1,0), (1,1), (0,1) in (u, v). Edges with one face are
/// sharp, vertices of one face corners. levels: how often each corner of face 0, in the order of
/// its loop, is isolated if it is extraordinary; at least 1.
[[nodiscard]] Section isolate_section(std::int32_t n_vertices,
                                      const CompressedRows<std::int32_t>& faces,
                                      const std::array<int, 4>& levels);

}  // namespace espalier
