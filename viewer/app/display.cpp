#include "viewer/app/display.h"

#include <algorithm>
#include <utility>

namespace espalier::viewer {
namespace {

constexpr glm::vec3 kSharpRed{0.90F, 0.28F, 0.24F};
constexpr glm::vec3 kBoundaryGreen{0.30F, 0.72F, 0.38F};
constexpr glm::vec3 kInnerBlue{0.36F, 0.55F, 0.95F};
constexpr glm::vec3 kSelected{1.00F, 0.72F, 0.16F};
constexpr glm::vec3 kPoint{0.10F, 0.11F, 0.13F};
constexpr glm::vec3 kInside{0.25F, 0.75F, 0.40F};
constexpr glm::vec3 kOutside{0.90F, 0.35F, 0.25F};
constexpr Background kDark{{0.26F, 0.28F, 0.31F}, {0.15F, 0.16F, 0.18F}};

std::vector<glm::vec3> in_frame(const DrawingFrame& frame, std::span<const glm::dvec3> points) {
  std::vector<glm::vec3> drawn;
  drawn.reserve(points.size());
  for (const glm::dvec3& point : points) {
    drawn.emplace_back(frame.to_drawing(point));
  }
  return drawn;
}

/// Both ends of every edge.
std::vector<glm::dvec3> segments(const LatticeElements& elements,
                                 std::span<const glm::dvec3> points) {
  std::vector<glm::dvec3> ends;
  for (const std::int32_t vertex : elements.edges.values()) {
    ends.push_back(points[static_cast<std::size_t>(vertex)]);
  }
  return ends;
}

std::vector<glm::vec3> edge_colors(const Session& session) {
  const SubdivisionLattice& lattice = lattice_in(session.scene(), session.lattice());
  const Selection chosen = session.selected_vertices();
  std::vector<glm::vec3> colors;
  for (const EdgeId edge : lattice.complex->edges()) {
    const auto& ends = lattice.complex->vertices(edge);
    const bool is_chosen = chosen.contains(ends[0].value) && chosen.contains(ends[1].value) &&
                           session.element_kind() != ElementKind::Vertex;
    colors.push_back(is_chosen                            ? kSelected
                     : lattice.sharpness.edges[edge] > 0  ? kSharpRed
                     : lattice.complex->is_boundary(edge) ? kBoundaryGreen
                                                          : kInnerBlue);
  }
  return colors;
}

std::vector<glm::vec3> vertex_colors(const Session& session) {
  std::vector<glm::vec3> colors(static_cast<std::size_t>(session.elements().n_vertices), kPoint);
  for (const std::int32_t vertex : session.selected_vertices()) {
    colors[static_cast<std::size_t>(vertex)] = kSelected;
  }
  return colors;
}

/// Uploads the values from the first to the last that differ.
template <class Upload>
void upload_difference(const std::vector<glm::vec3>& before, const std::vector<glm::vec3>& after,
                       const Upload& upload) {
  const auto first = std::mismatch(before.begin(), before.end(), after.begin()).first;
  if (first == before.end()) {
    return;
  }
  const auto last = std::mismatch(before.rbegin(), before.rend(), after.rbegin()).first.base();
  const auto begin = static_cast<std::size_t>(first - before.begin());
  const auto end = static_cast<std::size_t>(last - before.begin());
  upload(begin, std::span(after).subspan(begin, end - begin));
}

}  // namespace

Display::Display(Renderer& renderer) : renderer_(renderer) {
  renderer_.set_background(kDark);
}

void Display::update(const Session& session) {
  update_frame(session);
  update_models(session);
  update_lattice(session);
  update_marks(session);
}

/// In another frame everything is drawn anew.
void Display::update_frame(const Session& session) {
  const DrawingFrame& frame = session.view().frame;
  if (frame.origin == frame_.origin && frame.scale == frame_.scale) {
    return;
  }
  frame_ = frame;
  for (const auto& [name, shown] : std::exchange(models_, {})) {
    renderer_.remove(shown.item);
  }
  lattice_key_.clear();
  complex_ = nullptr;
  binding_ = nullptr;
  ghost_.clear();
}

void Display::update_models(const Session& session) {
  const auto& models = session.scene().models;
  std::erase_if(models_, [&](const auto& entry) {
    const auto found = models.find(entry.first);
    const bool is_gone =
        found == models.end() || found->second.bytes().data() != entry.second.model.bytes().data();
    if (is_gone) {
      renderer_.remove(entry.second.item);
    }
    return is_gone;
  });
  for (const auto& [name, model] : models) {
    auto found = models_.find(name);
    if (found == models_.end()) {
      MeshDrawing drawing(model.points(), model.faces(), {.frame = frame_});
      TriangleMesh mesh = drawing.triangle_mesh(model.points());
      const ItemId item = renderer_.add(mesh);
      found = models_
                  .emplace(name, ShownModel{model,
                                            std::move(drawing),
                                            item,
                                            {},
                                            std::move(mesh.positions),
                                            std::move(mesh.normals)})
                  .first;
    }
    update_model(session, name, found->second);
  }
}

void Display::update_model(const Session& session, const std::string& name, ShownModel& shown) {
  std::vector<Bend> bends = bends_of(session, name);
  if (bends == shown.bends) {
    return;
  }
  const std::vector<glm::dvec3> points = bent_points(shown.model.points(), bends);
  std::vector<glm::vec3> positions = shown.drawing.positions(points);
  std::vector<glm::vec3> normals = shown.drawing.normals(points);
  upload_difference(shown.positions, positions,
                    [&](std::size_t first, std::span<const glm::vec3> values) {
                      renderer_.update_positions(shown.item, first, values);
                    });
  upload_difference(shown.normals, normals,
                    [&](std::size_t first, std::span<const glm::vec3> values) {
                      renderer_.update_normals(shown.item, first, values);
                    });
  shown.bends = std::move(bends);
  shown.positions = std::move(positions);
  shown.normals = std::move(normals);
}

void Display::update_lattice(const Session& session) {
  std::string key = session.lattice();
  const bool has_lattice = !key.empty();
  const auto complex = has_lattice ? lattice_in(session.scene(), key).complex : nullptr;
  key += "/" + std::to_string(static_cast<int>(session.element_kind()));
  for (const std::int32_t element : session.selection()) {
    key += " " + std::to_string(element);
  }
  std::vector<glm::dvec3> points = session.shown_points();
  if (key == lattice_key_ && complex == complex_) {
    if (points != lattice_points_) {
      renderer_.update_positions(lattice_items_[0], 0,
                                 in_frame(frame_, segments(session.elements(), points)));
      renderer_.update_positions(lattice_items_[1], 0, in_frame(frame_, points));
      lattice_points_ = std::move(points);
    }
    return;
  }
  for (const ItemId item : std::exchange(lattice_items_, {})) {
    renderer_.remove(item);
  }
  lattice_key_ = std::move(key);
  complex_ = complex;
  if (has_lattice) {
    lattice_items_ = {
        renderer_.add(LineSet{in_frame(frame_, segments(session.elements(), points)),
                              edge_colors(session), 2.2F, 0.35F}),
        renderer_.add(PointSet{in_frame(frame_, points), vertex_colors(session), 9, 1.2F, 0.4F})};
  }
  lattice_points_ = std::move(points);
}

/// In Bind mode the model's points by what the lattice holds; while faces are extruded, the cells
/// to come.
void Display::update_marks(const Session& session) {
  std::shared_ptr<const Binding> binding;
  std::string model;
  for (const auto& [names, bound] : session.scene().bound) {
    if (session.mode() == Mode::Bind && names.second == session.lattice()) {
      binding = bound.binding;
      model = names.first;
    }
  }
  std::vector<glm::dvec3> ghost = session.ghost();
  if (binding == binding_ && ghost == ghost_) {
    return;
  }
  for (const ItemId item : std::exchange(mark_items_, {})) {
    renderer_.remove(item);
  }
  binding_ = binding;
  ghost_ = std::move(ghost);
  if (!ghost_.empty()) {
    mark_items_.push_back(renderer_.add(LineSet{
        in_frame(frame_, ghost_), std::vector<glm::vec3>(ghost_.size() / 2, kSelected), 2, 0.4F}));
  }
  if (binding) {
    PointSet dots{in_frame(frame_, model_in(session.scene(), model).points()), {}, 4, 0, 0};
    for (const PointStatus status : binding->status) {
      const bool is_held = status == PointStatus::Inside || status == PointStatus::Border;
      dots.colors.push_back(is_held ? kInside : kOutside);
    }
    mark_items_.push_back(renderer_.add(dots));
  }
}

}  // namespace espalier::viewer
