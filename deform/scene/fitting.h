#pragma once

/// What operations that fit lattices to models have in common.

#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "deform/fit/fitted_shapes.h"
#include "deform/scene/operation.h"
#include "lattice/build/cell_mesh.h"

namespace espalier {

/// What an operation's --fit can be told.
struct FitKind {
  std::vector<std::string> places;  ///< parameters that --fit stands for
  bool has_axes = false;
  bool has_along = false;
  bool is_principal = false;  ///< the axes unless --axes says otherwise
};

/// "fit" with what belongs to it.
[[nodiscard]] std::vector<Parameter> fit_parameters(const FitKind& kind);

/// The points of the model "fit" that "only" selects, or all of them. Throws ParameterError for a
/// name that does not exist.
[[nodiscard]] std::vector<glm::dvec3> points_to_fit(const Scene& scene, const Arguments& arguments);

/// Points that a lattice has to hold.
struct FitRequest {
  std::vector<glm::dvec3> points;  ///< model units
  double padding = 0;              ///< room on all sides, model units
  FitOptions options;
};

/// What the arguments ask for. Throws ParameterError for a place given with --fit, options that
/// exclude each other, a padding that is no number from 0 to 100, or points without an extent.
[[nodiscard]] FitRequest fit_request(const Scene& scene, const Arguments& arguments,
                                     const FitKind& kind);

/// The same for a limb along joints: of the whole model only the part that runs round them, see
/// limb_points(). Throws ParameterError also for fewer than two joints or coinciding ones, if no
/// point of it is there, or if points that "only" selects lie beyond its ends.
[[nodiscard]] FitRequest limb_fit_request(const Scene& scene, const Arguments& arguments,
                                          const FitKind& kind,
                                          const std::vector<glm::dvec3>& joints);

/// Throws ParameterError for what belongs to "fit" where there is none.
void require_no_fit_options(const Arguments& arguments);

/// A lattice to be made round points.
struct Fitting {
  std::vector<glm::dvec3> points;  ///< that its frozen volume has to hold
  double clearance = 0;            ///< from its boundary, model units
  double margin = 0;               ///< to begin with
  std::function<CellMesh(double margin)> mesh;
};

/// The scene with the lattice, as add_lattice(), made with the margin or, where the frozen volume
/// does not hold all points with the clearance, with as much more as that takes. Throws
/// ParameterError if no margin does.
[[nodiscard]] Scene add_fitted_lattice(const Scene& scene, const Arguments& arguments,
                                       const Fitting& fitting, const Progress& progress);

}  // namespace espalier
