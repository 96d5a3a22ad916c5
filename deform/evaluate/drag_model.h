#pragma once

/// What a drag begins with: the model as it is bent at mouse-down, and how its points follow the
/// selected control points [THB18].

#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "deform/evaluate/combine.h"

namespace espalier {

/// Determinants below count as folded at mouse-down: round-off in J could have made them.
inline constexpr double kLeastDeterminant = 1e-12;
/// How much of the largest safe step is left out, against round-off.
inline constexpr double kFoldGuard = 1e-7;

/// A model that lattices bend, as combined_points() takes it. All displacements are those at
/// mouse-down. Points of a fringe follow as they do in every evaluation.
struct DragModel {
  std::span<const glm::dvec3> rest_points;   ///< #points
  std::span<const LatticeMotion> motions;    ///< of all lattices that act
  std::size_t dragged = 0;                   ///< which of them has the selection
  std::span<const glm::dvec3> normals = {};  ///< #points at rest, of length 1; empty: none will be
                                             ///< asked for
  bool has_fold_check = true;                ///< determinants will be asked for
  const Influence* influence = nullptr;      ///< of all lattices; null: all of it

  [[nodiscard]] bool needs_gradients() const { return has_fold_check || !normals.empty(); }
  [[nodiscard]] const Volume& volume() const { return *motions[dragged].volume; }
};

/// The model at mouse-down, #points each.
struct DragStart {
  std::vector<glm::dvec3> points;
  std::vector<glm::dmat3> gradients;  ///< J; empty unless needed
};
[[nodiscard]] DragStart drag_start(const DragModel& model);

/// How the points move, and by how much from point to point, if the control points of the dragged
/// lattice move by a vector each; both are linear in the vectors. #points each.
struct DragField {
  std::vector<glm::dvec3> values;
  std::vector<glm::dmat3> slopes;  ///< ∂value/∂x; column b along axis b; empty unless needed
};
/// vectors: #controls of the dragged lattice.
[[nodiscard]] DragField drag_field(const DragModel& model, std::span<const glm::dvec3> vectors);

/// Throws ParameterError for a model without lattices or whose lattice to be dragged is none of
/// them, for normals of another number than points, and for a selection of another number than
/// control points or not in [0, 1]. Strengths and weights: as combined_points().
void require_valid(const DragModel& model, std::span<const double> selection);

/// Throws ParameterError unless 0 ≤ margin < 1.
void require_margin(double margin);

/// The cofactor matrix: the inverse transpose times the determinant.
[[nodiscard]] glm::dmat3 cofactors(const glm::dmat3& J);

/// What an update is to write, each #points or empty: not wanted. Only points that the selection
/// reaches are written.
template <class Real>
struct DraggedPoints {
  std::span<glm::vec<3, Real>> points = {};
  std::span<glm::vec<3, Real>> normals = {};  ///< cof(J) n, of length 1, or zero
  std::span<std::uint8_t> folded = {};        ///< 1 where det J ≤ 0, else 0
};

/// Throws ParameterError for spans of another length than n_points, and for what is not possible.
template <class Real>
void require_fits(const DraggedPoints<Real>& out, std::size_t n_points, bool has_normals,
                  bool has_folds);

}  // namespace espalier
