#pragma once

/// What a lattice of any type freezes into: points that follow its control points, and patches over
/// them that map the unit cube into space. Everything downstream sees only this.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lattice/core/box.h"
#include "lattice/core/compressed_rows.h"
#include "lattice/volume/bezier_patch.h"
#include "lattice/volume/extraction.h"
#include "lattice/volume/stencil_table.h"

namespace espalier {

/// How far beyond its unit cube a leaf patch may hold points, as a fraction of the cube.
inline constexpr double kLeafReach = 0.05;

/// How a patch's block of points becomes a Bézier hexahedron.
struct Patch {
  std::array<std::uint16_t, 3> extractions{};  ///< of Volume::extractions(), one an axis
  std::uint8_t boundary_faces =
      0;                    ///< bit f: face f of index_order.h lies on the volume's boundary
  bool is_pyramid = false;  ///< the points at w = 1 are one, the apex
  bool is_leaf = false;  ///< meets its neighbours only nearly: holds what is left between them too

  [[nodiscard]] bool is_on_boundary(int face) const { return (boundary_faces >> face & 1) != 0; }
  /// The parameters at which the patch may hold points: the unit cube, or for a leaf kLeafReach
  /// more, but not across the volume's boundary, nor beyond an apex.
  [[nodiscard]] Box reach() const;
};

/// The tables of a volume.
struct VolumeTables {
  StencilTable stencils;                ///< points over control points
  std::vector<Extraction> extractions;  ///< shared by the patches
  std::vector<Patch> patches;
  CompressedRows<std::int32_t> blocks;  ///< a row a patch: points, u fastest, as many as the
                                        ///< extractions have coefficients
  /// Of the points, positive: every patch is rational. Empty: none is.
  std::vector<double> weights = {};
  /// Of the points from what their stencils make of the control points at rest or posed: they give
  /// a volume to control points that lie in a plane or on a line. Empty: none.
  std::vector<glm::dvec3> offsets = {};
  double freeze_error = 0;    ///< see Volume::freeze_error()
  double gradient_error = 0;  ///< see Volume::gradient_error()
};

/// Patches over points, and the points as stencils over control points. Immutable.
class Volume {
 public:
  Volume() = default;
  Volume(VolumeTables tables, std::vector<glm::dvec3> rest_controls);

  [[nodiscard]] std::size_t n_controls() const { return rest_controls_.size(); }
  [[nodiscard]] std::size_t n_points() const { return rest_points_.size(); }
  [[nodiscard]] std::size_t n_patches() const { return tables_.patches.size(); }
  [[nodiscard]] const Patch& patch(std::size_t i) const { return tables_.patches[i]; }
  [[nodiscard]] std::span<const std::int32_t> block(std::size_t i) const {
    return tables_.blocks[i];
  }
  /// Degrees of patch i's Bézier form.
  [[nodiscard]] std::array<int, 3> degree(std::size_t i) const;
  [[nodiscard]] const std::vector<Extraction>& extractions() const { return tables_.extractions; }
  [[nodiscard]] const StencilTable& stencils() const { return tables_.stencils; }
  [[nodiscard]] std::span<const glm::dvec3> rest_controls() const { return rest_controls_; }
  [[nodiscard]] std::span<const glm::dvec3> rest_points() const { return rest_points_; }
  /// Of the points; empty unless the patches are rational.
  [[nodiscard]] std::span<const double> weights() const { return tables_.weights; }
  [[nodiscard]] bool is_rational() const { return !tables_.weights.empty(); }

  /// The points for control points. controls: #controls; result: #points. O(#weights).
  [[nodiscard]] std::vector<glm::dvec3> points(std::span<const glm::dvec3> controls) const;

  /// Displacements of the points for a pose; they depend on those of the control points linearly.
  /// Points that only see zero displacements get exactly zero. Throws ParameterError unless pose:
  /// #controls.
  [[nodiscard]] std::vector<glm::dvec3> displacements(std::span<const glm::dvec3> pose) const;

  /// Patch i in Bézier form, of the rest points or of any other values. values: #points; a rational
  /// patch's numerators are values times weights. `out` keeps its memory from call to call.
  void bezier(std::size_t i, std::span<const glm::dvec3> values, BezierPatch& out) const;
  [[nodiscard]] BezierPatch bezier(std::size_t i, std::span<const glm::dvec3> values) const;
  /// The same with weights other than those at rest: #points, positive; or empty: a polynomial.
  void bezier(std::size_t i, std::span<const glm::dvec3> values, std::span<const double> weights,
              BezierPatch& out) const;

  /// A box for each patch that holds all of it at rest, and a leaf's reach beyond (kLeafReach).
  [[nodiscard]] std::vector<Box> patch_boxes() const;

  /// Length of the diagonal of the control points' box at rest, of the points' box where they have
  /// offsets: the scale of tolerances.
  [[nodiscard]] double diagonal() const { return diagonal_; }

  /// Where freezing could not be as exact as was asked: about how far it puts points from the
  /// lattice's true volume, relative to the diagonal, for moves of about a cell. 0: as asked.
  [[nodiscard]] double freeze_error() const { return tables_.freeze_error; }
  /// The same of ∂x'/∂x, inside: about how far it is from the true derivative.
  [[nodiscard]] double gradient_error() const { return tables_.gradient_error; }

  /// Heap memory in use.
  [[nodiscard]] std::size_t bytes() const;

 private:
  /// Coefficients into Bézier points, in place. T: glm::dvec3, or double.
  template <class T>
  void extract_block(const Patch& patch, std::vector<T>& values) const;

  VolumeTables tables_;
  std::vector<char> is_identity_;  // of each extraction: its coefficients are the Bézier points
  std::vector<glm::dvec3> rest_controls_;
  std::vector<glm::dvec3> rest_points_;
  double diagonal_ = 0;
};

}  // namespace espalier
