#pragma once

/// Catmull-Clark surfaces, refined by OpenSubdiv.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lattice/core/compressed_rows.h"
#include "lattice/volume/stencil_table.h"

namespace espalier::osd {

/// A refined polygon mesh.
struct RefinedSurface {
  std::vector<glm::dvec3> points;
  CompressedRows<std::int32_t> faces;  ///< quadrilaterals from the first level on
};

/// Refines a polygon mesh `levels` times in double; boundary edges are sharp, corners too. Points
/// that no face uses are left out. points: model units; faces: loops of any size. Throws
/// ParameterError if a face repeats a vertex, an edge has faces that OpenSubdiv cannot order, or
/// the result would have more than 50 million faces.
[[nodiscard]] RefinedSurface refine_surface(std::span<const glm::dvec3> points,
                                            const CompressedRows<std::int32_t>& faces, int levels);

/// Creases and corners of a mesh.
struct SurfaceTags {
  std::vector<std::array<std::int32_t, 2>> edges;  ///< by their ends
  std::vector<float> edge_sharpness;               ///< #edges
  std::vector<std::int32_t> vertices;
  std::vector<float> vertex_sharpness;  ///< #vertices
};

/// A refined polygon mesh without coordinates.
struct SurfaceRefinement {
  StencilTable points;                 ///< over the mesh's points
  CompressedRows<std::int32_t> faces;  ///< quadrilaterals
  std::vector<std::int32_t> parents;   ///< #faces: the face of the mesh that each lies in
};

/// Refines a closed polygon mesh with creases `levels` times, once or more. faces: loops of any
/// size over n_points points, of which some may be unused. Throws as refine_surface.
[[nodiscard]] SurfaceRefinement surface_refinement(std::size_t n_points,
                                                   const CompressedRows<std::int32_t>& faces,
                                                   const SurfaceTags& tags, int levels);

}  // namespace espalier::osd
