#pragma once

/// Subdivision surfaces with all that their points and corners carry, refined by OpenSubdiv.

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "lattice/core/compressed_rows.h"

namespace espalier::osd {

enum class SurfaceScheme : std::uint8_t {
  CatmullClark,  ///< of polygons
  Loop           ///< of triangles
};

/// Values that corners of faces refer to: where two faces refer to different ones there is a seam.
struct CornerValues {
  std::vector<glm::dvec3> values;
  std::vector<std::int32_t> of_corners;  ///< #corners, parallel to the values of faces; -1: none
};

/// A polygon mesh and what it carries.
struct SurfaceValues {
  std::vector<glm::dvec3> points;
  std::size_t n_extras = 0;    ///< further numbers of a point
  std::vector<double> extras;  ///< #points × #extras
  CompressedRows<std::int32_t> faces;
  std::vector<CornerValues> channels;
  std::vector<std::int32_t> parents;  ///< of a refined one: the face that each lies in, ascending
};

/// The surface refined once, in double. Points go where the scheme says, with sharp borders that
/// keep the points of single faces, and sharp edges where more than two faces meet or two do that
/// are wound against each other; a point that joins surfaces only there stays. All else is
/// interpolated linearly, and a corner between ones without a value has none. Old points and values
/// keep their numbers, new ones follow; points that no face uses stay. Throws ParameterError if
/// OpenSubdiv cannot order the faces. No face may have a point twice, nor Loop's scheme one with
/// another number of corners than three.
[[nodiscard]] SurfaceValues refine_values(const SurfaceValues& surface, SurfaceScheme scheme);

}  // namespace espalier::osd
