#pragma once

/// Vertices that one lattice bends, evaluated in float, frame after frame: for motions that no drag
/// can do.

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "deform/embed/embed.h"
#include "deform/evaluate/evaluator.h"

namespace espalier::viewer {

/// Where vertices go, #vertices each. What the binding does not hold is left as it is.
struct EvaluatedVertices {
  std::span<glm::vec3> positions;
  std::span<glm::vec3> normals;
  std::span<std::uint8_t> folded;  ///< 1 where det J ≤ 0
};

class FloatEvaluation {
 public:
  /// binding: of the vertices, without a fringe; rest, normals: #vertices. O(#vertices).
  FloatEvaluation(std::shared_ptr<const Volume> volume, std::shared_ptr<const Binding> binding,
                  std::span<const glm::dvec3> rest, std::span<const glm::dvec3> normals);

  /// One frame. controls: #controls; pose_weights: as displaced_points() takes them. Returns how
  /// many vertices are folded. O(#held · degree³).
  std::size_t evaluate(std::span<const glm::dvec3> controls, std::span<const double> pose_weights,
                       const EvaluatedVertices& out);

  /// The vertices that are written, ascending.
  [[nodiscard]] std::vector<std::uint32_t> held() const;

 private:
  std::size_t mark_folded(std::span<std::uint8_t> folded);

  std::shared_ptr<const Volume> volume_;
  std::shared_ptr<const Binding> binding_;
  std::unique_ptr<Evaluator<float>> evaluator_;
  VolumeMotion<float> motion_;
  std::vector<glm::vec3> points_, normals_;  // #held; empty: the first vertices are those held
  std::vector<float> determinants_;          // #held
  bool was_folded_ = true;                   // as far as is known
};

}  // namespace espalier::viewer
