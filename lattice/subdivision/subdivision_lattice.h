#pragma once

/// The control lattice of a Catmull-Clark volume.

#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lattice/topology/cell_complex.h"
#include "lattice/topology/sharpness.h"

namespace espalier {

/// The rule for vertices on extraordinary lines; see masks.h.
enum class Scheme {
  CatmullClark,  ///< extruded lattices are exactly Catmull-Clark across × cubic along
  MacCrackenJoy  ///< the rules of [MJ96], unchanged
};

/// Control points over a cell complex, at rest and posed, with creases. A value; copies share the
/// complex.
struct SubdivisionLattice {
  std::shared_ptr<const CellComplex> complex;
  std::vector<glm::dvec3> rest;  ///< #vertices, model units
  std::vector<glm::dvec3> pose;  ///< #vertices, or empty: at rest
  Sharpness sharpness;
  Scheme scheme = Scheme::CatmullClark;
  std::string extra_json;  ///< keys of its file that are not ours, a JSON object; empty: none

  /// The pose if there is one, else the rest points.
  [[nodiscard]] std::span<const glm::dvec3> posed_points() const {
    return pose.empty() ? rest : pose;
  }
};

}  // namespace espalier
