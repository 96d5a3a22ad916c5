#include "viewer/app/lattice_marks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace espalier::viewer {
namespace {

constexpr glm::vec3 kSharpRed{0.90F, 0.28F, 0.24F};
constexpr glm::vec3 kBoundaryGreen{0.30F, 0.72F, 0.38F};
constexpr glm::vec3 kInnerBlue{0.36F, 0.55F, 0.95F};
constexpr glm::vec3 kCornerYellow{0.98F, 0.86F, 0.25F};
constexpr glm::vec3 kLockedRed{0.80F, 0.10F, 0.12F};
constexpr glm::vec3 kSelected{1.00F, 0.72F, 0.16F};
constexpr glm::vec3 kChosenPoint{1.00F, 0.50F, 0.05F};
constexpr glm::vec3 kActive{1.00F, 0.95F, 0.70F};
constexpr glm::vec3 kPoint{0.10F, 0.11F, 0.13F};
constexpr glm::vec3 kRest{0.55F, 0.57F, 0.60F};
constexpr glm::vec3 kInside{0.25F, 0.75F, 0.40F};
constexpr glm::vec3 kOutside{0.90F, 0.35F, 0.25F};
constexpr glm::vec3 kCursorRed{0.95F, 0.20F, 0.20F};
constexpr glm::vec3 kFolded{1.00F, 0.15F, 0.60F};
constexpr std::array<glm::vec3, 4> kAxes = {glm::vec3{0.93F, 0.30F, 0.33F},
                                            {0.45F, 0.78F, 0.22F},
                                            {0.30F, 0.52F, 0.98F},
                                            {0.85F, 0.86F, 0.88F}};
constexpr std::array<glm::vec3, 6> kLevels = {
    glm::vec3{0.16F, 0.20F, 0.30F}, {0.85F, 0.42F, 0.85F}, {0.30F, 0.80F, 0.90F},
    {0.90F, 0.86F, 0.40F},          {0.26F, 0.76F, 0.62F}, {0.62F, 0.50F, 0.95F}};

std::vector<glm::vec3> in_frame(const DrawingFrame& frame, std::span<const glm::dvec3> points) {
  std::vector<glm::vec3> drawn;
  drawn.reserve(points.size());
  for (const glm::dvec3& point : points) {
    drawn.emplace_back(frame.to_drawing(point));
  }
  return drawn;
}

/// How much finer a lattice with many edges is drawn, or it would hide everything.
float pen_scale(std::size_t n_edges) {
  return std::clamp(std::sqrt(300.0F / static_cast<float>(n_edges + 1)), 0.45F, 1.0F);
}

/// The visible edges at these points.
LineSet edges_at(const Session& session, std::span<const glm::dvec3> points) {
  LineSet lines;
  const auto& edges = session.elements().edges;
  for (std::size_t edge = 0; edge < edges.n_rows(); ++edge) {
    if (session.visible().edges[edge]) {
      for (const std::int32_t vertex : edges[edge]) {
        lines.points.emplace_back(
            session.view().frame.to_drawing(points[static_cast<std::size_t>(vertex)]));
      }
    }
  }
  return lines;
}

LineSet cage_of(const Session& session) {
  const LatticeElements& elements = session.elements();
  LineSet lines = edges_at(session, session.shown_points());
  lines.width = 2.2F * pen_scale(elements.edges.n_rows());
  lines.hidden_opacity = 0.35F;
  const Selection chosen = session.selected_vertices();
  const std::vector<bool> is_outer = elements.outer_edges();
  for (std::size_t edge = 0; edge < elements.edges.n_rows(); ++edge) {
    if (!session.visible().edges[edge]) {
      continue;
    }
    const auto ends = elements.edges[edge];
    const bool is_chosen = session.element_kind() != ElementKind::Vertex &&
                           chosen.contains(ends[0]) && chosen.contains(ends[1]);
    const std::int32_t level = elements.levels[static_cast<std::size_t>(ends[0])];
    lines.colors.push_back(is_chosen                           ? kSelected
                           : level > 0                         ? level_color(level)
                           : elements.edge_sharpness[edge] > 0 ? kSharpRed
                           : is_outer[edge]                    ? kBoundaryGreen
                                                               : kInnerBlue);
  }
  return lines;
}

PointSet controls_of(const Session& session) {
  const LatticeElements& elements = session.elements();
  const float scale = 0.5F + 0.5F * pen_scale(elements.edges.n_rows());
  PointSet dots{{}, {}, 9 * scale, 1.2F, 0.4F};
  for (std::size_t i = 0; i < session.shown_points().size(); ++i) {
    if (!session.visible().vertices[i]) {
      continue;
    }
    dots.points.emplace_back(session.view().frame.to_drawing(session.shown_points()[i]));
    const bool is_locked = session.locked().contains(static_cast<std::int32_t>(i));
    dots.colors.push_back(is_locked                          ? kLockedRed
                          : elements.vertex_sharpness[i] > 0 ? kCornerYellow
                          : elements.n_levels > 1            ? level_color(elements.levels[i])
                                                             : kPoint);
  }
  return dots;
}

/// Larger, over the control points: another colour alone would look like that of corners.
PointSet chosen_of(const Session& session) {
  const float scale = 0.5F + 0.5F * pen_scale(session.elements().edges.n_rows());
  PointSet dots{{}, {}, 14 * scale, 1.5F, 0.4F};
  for (const std::int32_t vertex : session.selected_vertices()) {
    const auto i = static_cast<std::size_t>(vertex);
    if (session.visible().vertices[i]) {
      dots.points.emplace_back(session.view().frame.to_drawing(session.shown_points()[i]));
    }
  }
  dots.colors.assign(dots.points.size(), kChosenPoint);
  return dots;
}

LineSet rest_of(const Session& session) {
  const auto rest = points_of(session.scene(), session.lattice(), Shape::Rest);
  if (session.mode() != Mode::Pose || std::ranges::equal(rest, session.shown_points())) {
    return {};
  }
  LineSet lines = edges_at(session, rest);
  lines.width = 1;
  lines.hidden_opacity = 0.12F;
  lines.colors.assign(lines.points.size() / 2, kRest);
  return lines;
}

LineSet gizmo_of(const Session& session) {
  LineSet lines;
  lines.width = 2.6F;
  lines.hidden_opacity = 1;
  const auto gizmo = session.gizmo();
  if (!gizmo) {
    return lines;
  }
  const auto active = session.active_handle();
  for (const GizmoHandle& handle : gizmo_handles(*gizmo, session.view())) {
    const auto axis = static_cast<std::size_t>(handle.lock.axis < 0 ? 3 : handle.lock.axis);
    const glm::vec3 color = active && handle.is(*active) ? kActive : kAxes.at(axis);
    for (const glm::vec3& point : in_frame(session.view().frame, handle.segments)) {
      lines.points.push_back(point);
    }
    lines.colors.resize(lines.points.size() / 2, color);
  }
  return lines;
}

/// A ring of red and white that faces the eye, and a cross, of the same size in all views.
LineSet cursor_of(const Session& session) {
  LineSet lines;
  lines.width = 2;
  lines.hidden_opacity = 1;
  if (!session.cursor()) {
    return lines;
  }
  const View& view = session.view();
  const double pixel = view.pixel_size(*session.cursor());
  const auto at = [&](double radius, double turn) {
    const double angle = 2 * glm::pi<double>() * turn;
    return glm::vec3(
        view.frame.to_drawing(*session.cursor() + radius * pixel *
                                                      (std::cos(angle) * view.camera.right() +
                                                       std::sin(angle) * view.camera.upward())));
  };
  constexpr int kParts = 16;
  for (int i = 0; i < kParts; ++i) {
    lines.points.insert(lines.points.end(),
                        {at(10, double(i) / kParts), at(10, double(i + 1) / kParts)});
    lines.colors.push_back(i % 2 == 0 ? kCursorRed : glm::vec3(1));
  }
  for (int i = 0; i < 4; ++i) {
    lines.points.insert(lines.points.end(), {at(5, i / 4.0), at(17, i / 4.0)});
    lines.colors.push_back(glm::vec3(0.05F));
  }
  return lines;
}

void add_dots(const Session& session, const std::string& model, const Binding& binding,
              PointSet& dots) {
  const auto& points = model_in(session.scene(), model).points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PointStatus status = binding.status[i];
    const bool is_held = status == PointStatus::Inside || status == PointStatus::Border;
    dots.points.emplace_back(session.view().frame.to_drawing(points[i]));
    dots.colors.push_back(is_held ? kInside : kOutside);
  }
}

}  // namespace

glm::vec3 level_color(std::int32_t level) {
  return kLevels.at(static_cast<std::size_t>(level) % kLevels.size());
}

LatticeMarks lattice_marks(const Session& session) {
  LatticeMarks marks;
  if (!session.lattice().empty() && session.show().has_cage) {
    marks.cage = cage_of(session);
    marks.controls = controls_of(session);
    marks.chosen = chosen_of(session);
    marks.rest = rest_of(session);
  }
  std::vector<glm::dvec3> ghost = session.ghost();
  const std::vector<glm::dvec3>& preview = session.shown_preview().segments;
  ghost.insert(ghost.end(), preview.begin(), preview.end());
  marks.ghost.points = in_frame(session.view().frame, ghost);
  marks.ghost.colors.assign(marks.ghost.points.size() / 2, kSelected);
  marks.ghost.width = 1.6F;
  marks.ghost.hidden_opacity = 0.4F;
  marks.gizmo = gizmo_of(session);
  marks.cursor = cursor_of(session);
  return marks;
}

PointSet model_marks(const Session& session) {
  PointSet dots{{}, {}, 4, 0, 0};
  if (session.mode() == Mode::Bind) {
    for (const auto& [names, bound] : session.scene().bound) {
      if (names.second == session.lattice()) {
        add_dots(session, names.first, *bound.binding, dots);
      }
    }
    return dots;
  }
  const float scale = static_cast<float>(session.view().frame.scale);
  for (const auto& [name, model] : session.bent_models().all()) {
    for (std::size_t i = 0; i < model.folded().size(); ++i) {
      if (model.folded()[i] != 0) {
        dots.points.push_back(scale * model.positions()[i]);
        dots.colors.push_back(kFolded);
      }
    }
  }
  return dots;
}

void add_influence_marks(const Session& session, const std::string& model,
                         const InfluenceHeat& heat, PointSet& dots) {
  dots.diameter = 5;
  dots.outline = dots.hidden_opacity = 0;
  const BentModel& bent = session.bent_models().all().at(model);
  std::vector<double> weights = session.selection().empty()
                                    ? std::vector<double>(bent.model().points().size(), 1.0)
                                    : heat.of(session.selected_vertices());
  const auto influence = session.scene().influences.find(model);
  for (std::size_t i = 0; influence != session.scene().influences.end() && i < weights.size();
       ++i) {
    weights[i] *= influence->second->influence.at(i);
  }
  const auto scale = static_cast<float>(session.view().frame.scale);
  const auto& points = bent.drawing().vertex_points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (weights[points[i]] != 0) {
      dots.points.push_back(scale * bent.positions()[i]);
      dots.colors.push_back(heat_color(weights[points[i]]));
    }
  }
}

}  // namespace espalier::viewer
