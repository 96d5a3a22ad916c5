#pragma once

/// Bézier [H97], B-spline and NURBS lattices: control points over a grid of knots.

#include <array>
#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lattice/tensor/knots.h"
#include "lattice/tensor/oriented_box.h"
#include "lattice/volume/volume.h"

namespace espalier {

/// What a tensor lattice is called.
enum class TensorKind { Bezier, BSpline, Nurbs };

/// "bezier", "bspline" or "nurbs", and back; nothing for a name of none.
[[nodiscard]] std::string_view name_of(TensorKind kind);
[[nodiscard]] std::optional<TensorKind> tensor_kind_named(std::string_view name);

/// Control points on a grid, u fastest, at rest and posed. A value.
///
/// An axis with one control point does nothing: a point keeps its place along it, and is moved by
/// the same wherever that is, so that a lattice of 4 × 4 × 1 points bends a model as a plane is
/// bent [H97]. How far the volume reaches along it is its `thickness`.
struct TensorLattice {
  TensorKind kind = TensorKind::BSpline;
  std::array<TensorAxis, 3> axes;
  std::vector<glm::dvec3> rest;      ///< #controls, model units
  std::vector<glm::dvec3> pose;      ///< #controls, or empty: at rest
  std::vector<double> weights;       ///< NURBS: #controls, positive; else empty
  std::vector<double> pose_weights;  ///< the same of the pose, or empty: those at rest
  /// Of an axis with one control point: from one side of the volume to the other, the control
  /// points in the middle; zero: perpendicular to the others, as long as their box's diagonal.
  std::array<glm::dvec3, 3> thickness{};
  std::string extra_json;  ///< keys of its file that are not ours, a JSON object; empty: none

  [[nodiscard]] std::array<int, 3> counts() const {
    return {axes[0].n_controls(), axes[1].n_controls(), axes[2].n_controls()};
  }
  [[nodiscard]] std::size_t n_controls() const;
  /// The pose if there is one, else the rest points.
  [[nodiscard]] std::span<const glm::dvec3> posed_points() const {
    return pose.empty() ? rest : pose;
  }
  /// The pose's weights if it has its own, else those at rest.
  [[nodiscard]] std::span<const double> posed_weights() const {
    return pose_weights.empty() ? weights : pose_weights;
  }
};

/// Control points that a lattice may have.
inline constexpr std::size_t kMostControls = std::size_t{1} << 27;

/// What fills a box.
enum class BoxFilling {
  ControlPoints,  ///< the outermost control points lie on its faces
  Volume          ///< the volume does, and with uniform ends the control points lie beyond
};

/// A lattice at rest on a box, where the map from knots to space is affine: its control points at
/// their Greville places; evenly spaced with tripled ends. One periodic axis makes a ring: it runs
/// round the third of the axes in cyclic order, with the next axis pointing outward from half the
/// box's radius to all of it. Weights are 1. Throws ParameterError for a Bézier lattice with knots
/// inside, for two periodic axes, or for too many control points.
[[nodiscard]] TensorLattice make_tensor_lattice(TensorKind kind,
                                                const std::array<TensorAxis, 3>& axes,
                                                const OrientedBox& box,
                                                BoxFilling filling = BoxFilling::ControlPoints);

/// Throws LatticeError naming what does not fit: arrays of other lengths than the axes ask for,
/// coordinates that are not finite, weights that are not positive, weights or knots of a kind that
/// has none.
void require_valid(const TensorLattice& lattice);

/// Each product of spans is one patch, exactly, u fastest; its points are the control points
/// themselves. Throws as require_valid(). O(#patches · block).
[[nodiscard]] Volume freeze(const TensorLattice& lattice);

/// Weights of control points as the points of the frozen volume have them. volume: what a tensor
/// lattice froze into; weights: #controls, or empty: then so is the result.
[[nodiscard]] std::vector<double> point_weights(const Volume& volume,
                                                std::span<const double> weights);

/// A place by patch.
struct PatchPlace {
  std::size_t patch = 0;
  glm::dvec3 uvw{0};    ///< in the patch, in [0,1]³
  glm::dvec3 scale{1};  ///< its derivative by the place in the whole
};

/// Where in the frozen volume a place of the whole lattice is. uvw: in [0,1]³, the range of each
/// axis's knots; clamped.
[[nodiscard]] PatchPlace place_of(const TensorLattice& lattice, const glm::dvec3& uvw);

/// The same volume, at rest and posed, with every span of every axis halved.
[[nodiscard]] TensorLattice refined(const TensorLattice& lattice);

/// The same with more knots on one axis. Throws as with_knots() of the axis.
[[nodiscard]] TensorLattice with_knots(const TensorLattice& lattice, int axis,
                                       std::span<const double> knots);

/// The same of one degree more on one axis. Throws as elevated() of the axis.
[[nodiscard]] TensorLattice elevated(const TensorLattice& lattice, int axis);

}  // namespace espalier
