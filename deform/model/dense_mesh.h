#pragma once

/// Polygon meshes made denser until their edges are short.

#include <cstdint>
#include <glm/vec3.hpp>
#include <string_view>
#include <vector>

#include "lattice/core/compressed_rows.h"
#include "lattice/core/progress.h"

namespace espalier {

/// How the points of a denser mesh are found.
enum class DensifyMethod {
  Midpoint,     ///< on the edges and faces that are there: the shape stays
  Loop,         ///< [L87], of triangles
  CatmullClark  ///< [CC78], of any polygons
};

/// What a corner of a face names, -1: nothing.
struct DenseCorner {
  std::int32_t point = -1;
  std::int32_t texture = -1;
  std::int32_t normal = -1;
  bool operator==(const DenseCorner&) const = default;
};

/// A mesh with all that is attached to it; making it denser appends to every array, and moves old
/// points only by smooth methods.
struct DenseMesh {
  std::vector<glm::dvec3> points;    ///< #P × 3, model units
  std::size_t n_extras = 0;          ///< further numbers of a point, such as colours
  std::vector<double> extras;        ///< #P × #extras
  std::vector<glm::dvec3> textures;  ///< #T × 3
  std::vector<glm::dvec3> normals;   ///< #N × 3; new ones are of unit length, or 0 by smooth
                                     ///< methods between opposite ones
  CompressedRows<DenseCorner> faces;
  std::vector<std::int32_t> parents;  ///< #faces: the face of the original, ascending
};

/// Faces that a mesh may be made to have.
inline constexpr double kMostDenseFaces = 50e6;

/// The mesh with edges of at most `longest`. Midpoint halves only edges that are longer: a polygon
/// whose edges are all cut becomes quadrilaterals, one with some cut becomes two quadrilaterals or
/// triangles, and a concave one is cut into triangles first. The smooth methods refine everywhere,
/// as osd::refine_values(); texture coordinates and normals are interpolated. The result holds the
/// same bits for any number of threads. Throws ParameterError, with the numbers, if more than
/// kMostDenseFaces faces would be needed; naming a face if Loop meets one that is no triangle, a
/// smooth method one that has a point twice, or any a face of more than 2000 corners; and if
/// `longest` is not positive. Tells `progress` "densify".
[[nodiscard]] DenseMesh densified(DenseMesh mesh, DensifyMethod method, double longest,
                                  const Progress& progress = {});

}  // namespace espalier
