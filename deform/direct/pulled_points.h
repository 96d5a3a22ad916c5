#pragma once

/// Points that are pulled, and what each is to do.

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "deform/model/surface_point.h"
#include "lattice/core/progress.h"
#include "lattice/volume/stencil_table.h"
#include "lattice/volume/volume.h"

namespace espalier {

/// What a pulled point is to do.
enum class Aim {
  Place,  ///< go to a place
  Shift,  ///< move by a vector from where it is
  Plane   ///< go to a plane, along its normal; it may slide
};

/// A point that is pulled.
struct PulledPoint {
  std::string option;  ///< that asks for it, for messages: "pick"
  std::string name;    ///< "point 3"
  SurfacePoint point;  ///< of the model
  Aim aim = Aim::Place;
  glm::dvec3 goal{0};        ///< the place or the vector, model units
  bool is_optional = false;  ///< left out where no lattice holds it, else refused
  bool is_image = false;     ///< its mirror image is pulled: a point of space
  std::size_t number = 0;    ///< the caller's, which an image shares
};

/// x, y or z = offset.
struct SymmetryPlane {
  int axis = 0;
  double offset = 0;

  [[nodiscard]] glm::dvec3 image_of_place(glm::dvec3 place) const {
    place[axis] = 2 * offset - place[axis];
    return place;
  }
  [[nodiscard]] glm::dvec3 image_of_vector(glm::dvec3 vector) const {
    vector[axis] = -vector[axis];
    return vector;
  }
};

/// Where a pulled point is at rest. model: the points of the model.
[[nodiscard]] glm::dvec3 rest_place(const PulledPoint& point, std::span<const glm::dvec3> model,
                                    const std::optional<SymmetryPlane>& symmetry);

/// The points and after them their mirror images; a point within `tolerance` of the plane is its
/// own. No point may aim for a plane. Throws ParameterError naming one of these that would leave
/// the plane of symmetry.
[[nodiscard]] std::vector<PulledPoint> with_images(std::vector<PulledPoint> points,
                                                   std::span<const glm::dvec3> model,
                                                   const SymmetryPlane& symmetry, double tolerance);

/// How pulled points depend on the control points: #points × #controls; no weights for a point that
/// no patch holds, and those of its corners that one does for a point of a face that is cut by the
/// lattice's boundary. Throws ParameterError naming a point that is not optional and has no
/// weights.
[[nodiscard]] StencilTable rows_of(const Volume& volume, std::span<const PulledPoint> points,
                                   std::span<const glm::dvec3> model,
                                   const std::optional<SymmetryPlane>& symmetry,
                                   const Progress& progress = {});

/// Throws ParameterError naming two points that are within `tolerance` of each other and are to
/// move differently. places: #points, at rest; wanted: #points, how they are to move; normal: of
/// the plane that points aim for.
void require_no_contradiction(std::span<const PulledPoint> points,
                              std::span<const glm::dvec3> places,
                              std::span<const glm::dvec3> wanted, const glm::dvec3& normal,
                              double tolerance);

}  // namespace espalier
