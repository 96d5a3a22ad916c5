#pragma once

/// Turning, scaling and shearing a selection of control points, frame after frame.

#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "deform/evaluate/drag.h"
#include "deform/evaluate/drag_model.h"

namespace espalier {

/// What is to be moved: control points, as they are at mouse-down, about a pivot.
struct AffineSelection {
  std::span<const double> weights;       ///< #controls in [0, 1]: how much of the map each takes
  std::span<const glm::dvec3> controls;  ///< #controls at mouse-down
  glm::dvec3 pivot{0};
};

/// How far an update went.
struct AffineStep {
  double fraction = 1;  ///< of the straight way to the map asked for
  glm::dmat3 map{1};    ///< of the selected control points about the pivot

  [[nodiscard]] bool is_stopped() const { return fraction < 1; }
};

/// As Drag, for a linear map M about a pivot c: a control point P goes to P + weight (M − I)(P −
/// c). With q = Σ w (P − c) over the selection and its slope Q, points go to x0 + (M − I) q and J
/// to J0 + (M − I) Q; on the straight way from rest to M a determinant is a cubic polynomial.
template <class Real>
class AffineDrag {
 public:
  /// Mouse-down. Throws as Drag, and for controls of another number or a pivot not finite.
  AffineDrag(const DragModel& model, const AffineSelection& selection);

  /// The model with the selection mapped from mouse-down. margin, spans: as in Drag::update();
  /// stops on the straight way to the map. Throws ParameterError for a map that is not finite or
  /// has entries beyond 1e12, else as Drag::update(). Allocates nothing. O(#reached).
  AffineStep update(const glm::dmat3& map, std::optional<double> margin,
                    const DraggedPoints<Real>& out) const;

  /// As Drag::safe_fraction(), of the straight way.
  [[nodiscard]] double safe_fraction(const glm::dmat3& map, double margin) const;

  [[nodiscard]] std::size_t n_points() const { return n_points_; }
  /// Points that the selection reaches, ascending.
  [[nodiscard]] std::span<const std::uint32_t> reached() const { return reached_; }

 private:
  void write(std::size_t i, const glm::dmat3& change, const DraggedPoints<Real>& out) const;
  void require_possible(const DraggedPoints<Real>& out) const;

  std::size_t n_points_ = 0;
  bool has_folds_ = false;
  std::vector<std::uint32_t> reached_;
  std::vector<glm::dvec3> points_, values_, normals_;  ///< x0, q, n: #reached, or not needed
  std::vector<glm::dmat3> gradients_, slopes_;         ///< J0, Q: #reached, or not needed
};

}  // namespace espalier
