#pragma once

/// Tensor and THB lattices as JSON:
///
///     { "format": "espalier/1", "type": "bezier", "bspline" or "nurbs",
///       "counts": [nu,nv,nw],                     control points an axis; 1: nothing varies there
///       "degree": [p,q,r],                        0 with one control point; a Bézier lattice may
///                                                 leave it out
///       "ends": "open", or one word an axis,      open, uniform, natural, tripled, periodic
///       "knots": [[…],[…],[…]],                   instead of ends where a list is not empty
///       "thickness": [[x,y,z] or null, …],        along axes with one control point
///       "rest": [[x,y,z], …], "pose": [[x,y,z], …],   u fastest; pose absent: at rest
///       "weights": [w, …], "pose_weights": [w, …] }   nurbs; pose_weights absent: as at rest
///
///     { "format": "espalier/1", "type": "thb", "counts": […], "degree": […],
///       "levels": [[[[u0,v0,w0],[u1,v1,w1]], …], …],  boxes in [0,1]³, a list for each level ≥ 1
///       "points": [[level,i,j,k, rx,ry,rz, px,py,pz], …] }  control points in any order; absent:
///                                                 the unit box, at rest
///
/// All other keys are kept and written back.

#include <string>
#include <string_view>
#include <variant>

#include "lattice/tensor/tensor_lattice.h"
#include "lattice/tensor/thb_lattice.h"

namespace espalier {

/// Whether a file says that it is of one of these types. Throws FileError if it is no JSON object.
[[nodiscard]] bool is_tensor_json(const std::string& path, std::string_view text);

/// Throws FileError naming the line of a syntax error, or the element by its JSON path. Memory is
/// asked for in proportion to the file. O(n).
[[nodiscard]] std::variant<TensorLattice, ThbLattice> parse_json_tensor(const std::string& path,
                                                                        std::string_view text);

/// One control point a line, numbers in their shortest exact form. Throw LatticeError as
/// require_valid(), and if extra_json is no JSON object.
[[nodiscard]] std::string json_text(const TensorLattice& lattice);
[[nodiscard]] std::string json_text(const ThbLattice& lattice);

}  // namespace espalier
