#pragma once

/// Lattices along paths: a limb's axis, a hose, a ring.

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

#include "deform/model/model.h"
#include "lattice/build/cell_mesh.h"

namespace espalier {

/// Points of a path in order; of a closed one the first follows the last.
struct Polyline {
  std::vector<std::int32_t> points;  ///< two or more, three if closed
  bool is_closed = false;
};

/// The polylines that a model's lines make, joined where they share an end. Throws ParameterError,
/// naming the point, where three or more meet, and if there are no lines or a piece has no length.
[[nodiscard]] std::vector<Polyline> polylines_of(const Model& path);

struct SweepOptions {
  double radius = 0;      ///< of the volume round a straight path, model units; 0: by a model
  double padding = 0.05;  ///< added to the radius by a model, as a fraction of it, ≥ 0
  double reach = std::numeric_limits<double>::infinity();  ///< points of the model farther from the
                                                           ///< path count for nothing
  int core = 2;                                            ///< cells across the O-grid's square
  int rings = 1;                                           ///< cells from the square to the side
  int layers = 0;  ///< cells along each piece of the path; 0: about as long as they are wide
};

/// O-grid sections across a path, in the halving plane at its corners, carried along without
/// turning (see frames.h); along a closed path what turn is left is shared out evenly. By a model,
/// the radius at each section is that of the farthest of the points that are nearest to the path
/// round there, two sections to either side; points nearest to an open end from beyond it count for
/// nothing. path: from polylines_of(); several polylines make parts side by side. points: the
/// model's, or none.
///
/// Throws ParameterError for options out of range, a path that runs back on itself or bends too
/// sharply for its radius, or no points of the model beside it. Whether the result is a valid
/// lattice is for validate() to say. O(#points · #pieces).
[[nodiscard]] CellMesh sweep(std::span<const glm::dvec3> path, std::span<const Polyline> polylines,
                             std::span<const glm::dvec3> points, const SweepOptions& options);

}  // namespace espalier
