#pragma once

/// A model with its points moved: its own file with the changed numbers replaced.

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>

#include "deform/model/model.h"
#include "deform/model/normals.h"

namespace espalier {

/// What deforming does to normals.
enum class NormalMode : std::uint8_t {
  Deform,  ///< each turns; one shared by points where it turns differently becomes several
  Keep,    ///< each turns to the mean of what its points ask for; none is added
};

/// The bytes of `model` with its points at `points` and its normals turned to `pair_normals`.
///
/// points: #P × 3. A point whose bits are those of model.points() keeps its bytes, and so does a
/// coordinate that is the same number at the file's precision (NumberEncoding); other
/// coordinates are written as the shortest text that reads back as the same float or double.
///
/// pair_normals: #pairs × 3, unit, parallel to model.pairs(); or empty: all normals stay. One that
/// stays within 1e-6 of its old direction, or has none, keeps its bytes. In mode Deform pairs that
/// share a normal share the new one where theirs differ by no more than 1e-6; further ones
/// follow it on lines of their own, and references whose numbers change are rewritten.
///
/// Normals that a file writes facet by facet become those of the moved triangles.
///
/// If nothing moved the bytes are the model's own.
/// Throws ParameterError for a wrong number of points or normals, for a point that is not finite or
/// beyond kLargestCoordinate. O(bytes).
[[nodiscard]] std::string deformed_bytes(const Model& model, std::span<const glm::dvec3> points,
                                         std::span<const glm::dvec3> pair_normals,
                                         NormalMode mode = NormalMode::Deform);

/// The same of a file whose corners have no normals, with these added if a point moved: in OBJ
/// files before the first face, and named in all; in others as bytes_with_point_normals() does.
/// Throws ParameterError too for an STL file, for one that has normals, or for another number of
/// corners.
[[nodiscard]] std::string deformed_bytes_with_normals(const Model& model,
                                                      std::span<const glm::dvec3> points,
                                                      const CornerNormals& added);

/// The model that a file of deformed_bytes() holds: its points are rounded as written.
[[nodiscard]] Model deformed(const Model& model, std::span<const glm::dvec3> points,
                             std::span<const glm::dvec3> pair_normals,
                             NormalMode mode = NormalMode::Deform);
[[nodiscard]] Model deformed_with_normals(const Model& model, std::span<const glm::dvec3> points,
                                          const CornerNormals& added);

}  // namespace espalier
