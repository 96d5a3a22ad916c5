#include "viewer/interact/float_evaluation.h"

#include <algorithm>

#include "lattice/core/parallel.h"

namespace espalier::viewer {
namespace {

/// Whether vertices are 0, 1, 2 …
bool is_in_order(std::span<const std::int32_t> vertices) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (static_cast<std::size_t>(vertices[i]) != i) {
      return false;
    }
  }
  return true;
}

}  // namespace

FloatEvaluation::FloatEvaluation(std::shared_ptr<const Volume> volume,
                                 std::shared_ptr<const Binding> binding,
                                 std::span<const glm::dvec3> rest,
                                 std::span<const glm::dvec3> normals)
    : volume_(std::move(volume)),
      binding_(std::move(binding)),
      motion_(volume_->n_points()),
      determinants_(binding_->points.size()) {
  if (!is_in_order(binding_->points)) {
    points_.resize(binding_->points.size());
    normals_.resize(binding_->points.size());
  }
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
  const std::size_t n = determinants_.size();
  const bool is_in_place = points_.empty();
  evaluator_->evaluate(motion_,
                       {.points = is_in_place ? out.positions.first(n) : std::span(points_),
                        .determinants = determinants_,
                        .normals = is_in_place ? out.normals.first(n) : std::span(normals_)});
  const bool is_any_folded = std::any_of(determinants_.begin(), determinants_.end(),
                                         [](float determinant) { return determinant <= 0; });
  if (!is_in_place) {
    parallel_for(
        n,
        [&](std::size_t i) {
          const auto vertex = static_cast<std::size_t>(binding_->points[i]);
          out.positions[vertex] = points_[i];
          out.normals[vertex] = normals_[i];
        },
        16384);
  }
  return is_any_folded || was_folded_ ? mark_folded(out.folded) : 0;
}

std::size_t FloatEvaluation::mark_folded(std::span<std::uint8_t> folded) {
  std::size_t n_folded = 0;
  for (std::size_t i = 0; i < determinants_.size(); ++i) {
    const bool is_folded = determinants_[i] <= 0;
    folded[static_cast<std::size_t>(binding_->points[i])] = static_cast<std::uint8_t>(is_folded);
    n_folded += is_folded ? 1 : 0;
  }
  was_folded_ = n_folded > 0;
  return n_folded;
}

std::vector<std::uint32_t> FloatEvaluation::held() const {
  std::vector<std::uint32_t> vertices(binding_->points.begin(), binding_->points.end());
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

}  // namespace espalier::viewer
