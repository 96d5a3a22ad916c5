#include "viewer/interact/float_evaluation.h"

#include <algorithm>

#include "lattice/core/parallel.h"

namespace espalier::viewer {

FloatEvaluation::FloatEvaluation(std::shared_ptr<const Volume> volume,
                                 std::shared_ptr<const Binding> binding,
                                 std::span<const glm::dvec3> rest,
                                 std::span<const glm::dvec3> normals)
    : volume_(std::move(volume)),
      binding_(std::move(binding)),
      motion_(volume_->n_points()),
      points_(binding_->points.size()),
      normals_(binding_->points.size()),
      determinants_(binding_->points.size()) {
  std::vector<glm::dvec3> held_rest;
  std::vector<glm::dvec3> held_normals;
  for (const std::int32_t vertex : binding_->points) {
    held_rest.push_back(rest[static_cast<std::size_t>(vertex)]);
    held_normals.push_back(normals[static_cast<std::size_t>(vertex)]);
  }
  evaluator_ = std::make_unique<Evaluator<float>>(
      *volume_, BoundPoints{binding_->patches, binding_->uvw, held_rest, held_normals});
}

std::size_t FloatEvaluation::evaluate(std::span<const glm::dvec3> controls,
                                      std::span<const double> pose_weights,
                                      const EvaluatedVertices& out) {
  const WeightChange weights =
      pose_weights.empty() ? WeightChange() : WeightChange{volume_->weights(), pose_weights};
  motion_.set(volume_->displacements(controls), weights);
  evaluator_->evaluate(motion_,
                       {.points = points_, .determinants = determinants_, .normals = normals_});
  parallel_for(
      points_.size(),
      [&](std::size_t i) {
        const auto vertex = static_cast<std::size_t>(binding_->points[i]);
        out.positions[vertex] = points_[i];
        out.normals[vertex] = normals_[i];
        out.folded[vertex] = static_cast<std::uint8_t>(determinants_[i] <= 0);
      },
      16384);
  return static_cast<std::size_t>(
      std::count_if(determinants_.begin(), determinants_.end(), [](float d) { return d <= 0; }));
}

std::vector<std::uint32_t> FloatEvaluation::held() const {
  std::vector<std::uint32_t> vertices(binding_->points.begin(), binding_->points.end());
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

}  // namespace espalier::viewer
