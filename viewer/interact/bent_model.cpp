#include "viewer/interact/bent_model.h"

#include <algorithm>
#include <glm/matrix.hpp>

#include "deform/evaluate/displace.h"
#include "lattice/core/parallel.h"
#include "viewer/interact/vertex_binding.h"

namespace espalier::viewer {
namespace {

/// Vertices that did not move but lie between such as did are uploaded with them, up to this many.
constexpr std::size_t kGap = 64;
/// A drag stops where a determinant has fallen to this part of what it was at mouse-down.
constexpr double kLeastVolume = 0.01;

std::vector<glm::dvec3> vertices_from(const glm::dvec3& origin, const Model& model,
                                      const MeshDrawing& drawing) {
  std::vector<glm::dvec3> vertices;
  vertices.reserve(drawing.n_vertices());
  for (const std::uint32_t point : drawing.vertex_points()) {
    vertices.push_back(model.points()[point] - origin);
  }
  return vertices;
}

template <class Value>
void reorder(std::span<const std::uint32_t> order, std::vector<Value>& values) {
  std::vector<Value> reordered;
  reordered.reserve(values.size());
  for (const std::uint32_t old : order) {
    reordered.push_back(values[old]);
  }
  values = std::move(reordered);
}

/// Ascending vertices as ranges.
template <class Vertices>
std::vector<VertexRange> ranges_of(const Vertices& vertices) {
  std::vector<VertexRange> ranges;
  for (const std::uint32_t vertex : vertices) {
    if (!ranges.empty() && vertex < ranges.back().first + ranges.back().count + kGap) {
      ranges.back().count = vertex - ranges.back().first + 1;
    } else {
      ranges.push_back({vertex, 1});
    }
  }
  return ranges;
}

}  // namespace

BentModel::BentModel(const Model& model, const DrawingFrame& frame, std::uint64_t revision)
    : BentModel(model, frame, revision, find_texture(model)) {}

BentModel::BentModel(const Model& model, const DrawingFrame& frame, std::uint64_t revision,
                     const std::optional<ModelTexture>& texture)
    : model_(model),
      drawing_(model.points(), model.faces(),
               {.frame = {frame.origin, 1},
                .corner_places = texture ? std::span<const glm::vec2>(texture->corner_places)
                                         : std::span<const glm::vec2>(),
                .face_groups = texture ? std::span<const std::int32_t>(texture->face_groups)
                                       : std::span<const std::int32_t>()}),
      textures_(texture ? texture_ranges(*texture, drawing_.group_sizes())
                        : std::vector<TextureRange>()),
      rest_(vertices_from(frame.origin, model, drawing_)),
      normals_(drawing_.normals(model.points())),
      revision_(revision),
      known_since_(revision) {
  rest_normals_.assign(normals_.begin(), normals_.end());
  positions_.assign(rest_.begin(), rest_.end());
}

/// Vertices that are held come first, in the order of the binding.
void BentModel::arrange_for(const Binding& binding) {
  const Binding of_vertices = binding_of_vertices(binding, drawing_.vertex_points());
  std::vector<char> is_held(rest_.size(), 0);
  std::vector<std::uint32_t> order(of_vertices.points.begin(), of_vertices.points.end());
  for (const std::uint32_t vertex : order) {
    is_held[vertex] = 1;
  }
  for (std::uint32_t vertex = 0; vertex < rest_.size(); ++vertex) {
    if (is_held[vertex] == 0) {
      order.push_back(vertex);
    }
  }
  drawing_ = drawing_.reordered(order);
  reorder(order, rest_);
  reorder(order, rest_normals_);
  reorder(order, positions_);
  reorder(order, normals_);
  find_vertex_influence();
  bound_.clear();
  ++arrangement_;
  note_change({{0, rest_.size()}});
}

void BentModel::set_influence(std::shared_ptr<const ModelInfluence> influence) {
  if (influence != influence_) {
    influence_ = std::move(influence);
    find_vertex_influence();
    is_dragged_ = true;  // bent otherwise than it should be
  }
}

void BentModel::find_vertex_influence() {
  vertex_influence_ = {influence_ ? influence_->influence.strength : 1, {}};
  if (influence_ && !influence_->influence.weights.empty()) {
    for (const std::uint32_t point : drawing_.vertex_points()) {
      vertex_influence_.weights.push_back(influence_->influence.weights[point]);
    }
  }
}

void BentModel::bind_vertices(const std::vector<Bend>& bends) {
  if (bends.size() == 1 && bends.front().binding != arranged_for_) {
    arranged_for_ = bends.front().binding;
    arrange_for(*arranged_for_);
  }
  std::vector<Bound> bound;
  for (const Bend& bend : bends) {
    const auto found = std::find_if(bound_.begin(), bound_.end(), [&](const Bound& known) {
      return known.first == bend.binding;
    });
    bound.push_back(found != bound_.end()
                        ? *found
                        : Bound{bend.binding, std::make_shared<const Binding>(binding_of_vertices(
                                                  *bend.binding, drawing_.vertex_points()))});
  }
  bound_ = std::move(bound);
}

std::vector<LatticeMotion> BentModel::motions(const std::vector<Bend>& bends) const {
  std::vector<LatticeMotion> motions;
  for (std::size_t i = 0; i < bends.size(); ++i) {
    const Bend& bend = bends[i];
    motions.push_back({bend.volume, bound_[i].second, bend.volume->displacements(bend.controls),
                       bend.pose_weights});
  }
  return motions;
}

void BentModel::bend(const std::vector<Bend>& bends) {
  drag_ = std::monostate();
  if (bends == bends_ && !is_dragged_) {
    return;
  }
  is_dragged_ = false;
  bind_vertices(bends);
  bends_ = bends;
  const std::vector<LatticeMotion> motions = this->motions(bends_);
  const std::vector<glm::dvec3> points = combined_points(rest_, motions, vertex_influence_);
  const std::vector<glm::dmat3> gradients =
      combined_gradients(rest_.size(), motions, vertex_influence_);
  folded_.assign(bends.empty() ? 0 : rest_.size(), 0);
  std::vector<std::uint8_t> has_moved(rest_.size());
  parallel_for(rest_.size(), [&](std::size_t i) {
    const glm::vec3 position(points[i]);
    const glm::vec3 normal(turned_normal(gradients[i], rest_normals_[i]));
    has_moved[i] = static_cast<std::uint8_t>(position != positions_[i] || normal != normals_[i]);
    positions_[i] = position;
    normals_[i] = normal;
    if (!folded_.empty()) {
      folded_[i] = static_cast<std::uint8_t>(glm::determinant(gradients[i]) <= 0);
    }
  });
  std::vector<std::uint32_t> moved;
  for (std::size_t i = 0; i < has_moved.size(); ++i) {
    if (has_moved[i] != 0) {
      moved.push_back(static_cast<std::uint32_t>(i));
    }
  }
  note_change(ranges_of(moved));
}

DragModel BentModel::drag_model(std::span<const LatticeMotion> motions) const {
  return {.rest_points = rest_,
          .motions = motions,
          .normals = rest_normals_,
          .influence = influence_ ? &vertex_influence_ : nullptr};
}

void BentModel::begin_drag(const DragPlan& plan) {
  const std::vector<LatticeMotion> motions = this->motions(bends_);
  DragModel model = drag_model(motions);
  model.dragged = plan.dragged;
  has_followed_ = false;
  if (plan.is_turned) {
    drag_.emplace<AffineDrag<float>>(model,
                                     AffineSelection{plan.weights, plan.controls, plan.pivot});
    reached_ = ranges_of(std::get<AffineDrag<float>>(drag_).reached());
  } else {
    drag_.emplace<Drag<float>>(model, plan.weights);
    reached_ = ranges_of(std::get<Drag<float>>(drag_).reached());
  }
}

double BentModel::safe_fraction(const DragMotion& motion) const {
  if (const auto* drag = std::get_if<Drag<float>>(&drag_)) {
    return drag->safe_fraction(motion.displacement, kLeastVolume);
  }
  const auto* affine = std::get_if<AffineDrag<float>>(&drag_);
  return affine != nullptr ? affine->safe_fraction(motion.map, kLeastVolume) : 1;
}

/// Every control point takes a vector of its own where the map doubles all that stands at its end.
double BentModel::safe_fraction(const std::vector<Bend>& start, std::size_t dragged,
                                std::span<const glm::dvec3> to) const {
  const std::vector<LatticeMotion> motions = this->motions(start);
  DragModel model = drag_model(motions);
  model.dragged = dragged;
  std::vector<glm::dvec3> vectors(to.begin(), to.end());
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    vectors[i] -= start[dragged].controls[i];
  }
  const std::vector<double> all(vectors.size(), 1.0);
  const AffineDrag<float> straight(model, {all, vectors, glm::dvec3(0)});
  return straight.safe_fraction(glm::dmat3(2), kLeastVolume);
}

void BentModel::follow(const DragMotion& motion, bool marks_folds) {
  const DraggedPoints<float> out = {positions_, normals_,
                                    marks_folds ? std::span(folded_) : std::span<std::uint8_t>()};
  if (const auto* drag = std::get_if<Drag<float>>(&drag_)) {
    drag->update(motion.displacement, {}, out);
  } else if (const auto* affine = std::get_if<AffineDrag<float>>(&drag_)) {
    affine->update(motion.map, {}, out);
  }
  note_dragged();
}

/// All that moves from mouse-down on is among what is reached.
void BentModel::note_dragged() {
  is_dragged_ = true;
  if (std::exchange(has_followed_, true)) {
    ++revision_;
  } else {
    note_change(reached_);
  }
}

void BentModel::begin_evaluation() {
  if (bends_.size() == 1 && !influence_ && bound_.front().second->fringe.points.empty()) {
    const auto& evaluation = drag_.emplace<FloatEvaluation>(
        bends_.front().volume, bound_.front().second, rest_, rest_normals_);
    reached_ = ranges_of(evaluation.held());
    has_followed_ = false;
  }
}

bool BentModel::evaluate(std::size_t dragged, std::span<const glm::dvec3> controls) {
  auto* evaluation = std::get_if<FloatEvaluation>(&drag_);
  if (evaluation != nullptr) {
    const std::size_t n_folded = evaluation->evaluate(controls, bends_[dragged].pose_weights,
                                                      {positions_, normals_, folded_});
    note_dragged();
    return n_folded > 0;
  }
  std::vector<Bend> bends = bends_;
  bends[dragged].controls.assign(controls.begin(), controls.end());
  bend(bends);
  return std::find(folded_.begin(), folded_.end(), 1) != folded_.end();
}

void BentModel::note_change(std::vector<VertexRange> ranges) {
  known_since_ = revision_;
  changed_ = std::move(ranges);
  ++revision_;
}

std::vector<VertexRange> BentModel::changed_since(std::uint64_t revision) const {
  if (revision == revision_) {
    return {};
  }
  return revision >= known_since_ ? changed_ : std::vector<VertexRange>{{0, positions_.size()}};
}

}  // namespace espalier::viewer
