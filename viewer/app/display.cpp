#include "viewer/app/display.h"

#include <algorithm>
#include <utility>

#include "viewer/app/lattice_marks.h"

namespace espalier::viewer {
namespace {

constexpr Background kDark{{0.26F, 0.28F, 0.31F}, {0.15F, 0.16F, 0.18F}};

}  // namespace

Display::Display(Renderer& renderer) : renderer_(renderer) {
  renderer_.set_background(kDark);
}

void Display::update(const Session& session) {
  renderer_.set_shading(session.handling().shading);
  update_models(session);
  update_lattice(session);
  update_shapes(session);
  update_influence(session);
}

void Display::add_model(const Session& session, const std::string& name, const BentModel& bent) {
  TriangleMesh mesh;
  mesh.positions.assign(bent.positions().begin(), bent.positions().end());
  mesh.normals.assign(bent.normals().begin(), bent.normals().end());
  mesh.indices = bent.drawing().triangles();
  mesh.places = bent.drawing().vertex_places();
  mesh.textures = bent.textures();
  mesh.unit = static_cast<float>(session.view().frame.scale);
  models_.emplace(name, ShownModel{bent.model(), session.view().frame, renderer_.add(mesh),
                                   bent.revision(), bent.arrangement(), false});
}

void Display::update_models(const Session& session) {
  const auto& models = session.bent_models().all();
  const DrawingFrame& frame = session.view().frame;
  std::erase_if(models_, [&](const auto& entry) {
    const auto found = models.find(entry.first);
    const bool is_gone =
        found == models.end() ||
        found->second.model().bytes().data() != entry.second.model.bytes().data() ||
        found->second.arrangement() != entry.second.arrangement ||
        entry.second.frame.origin != frame.origin || entry.second.frame.scale != frame.scale;
    if (is_gone) {
      renderer_.remove(entry.second.item);
    }
    return is_gone;
  });
  for (const auto& [name, bent] : models) {
    if (!models_.contains(name)) {
      add_model(session, name, bent);
    }
    ShownModel& shown = models_.at(name);
    if (shown.has_wireframe != session.handling().has_wireframe) {
      shown.has_wireframe = session.handling().has_wireframe;
      renderer_.set_wireframe(shown.item, shown.has_wireframe);
    }
    for (const VertexRange& range : bent.changed_since(shown.revision)) {
      renderer_.update_positions(shown.item, range.first,
                                 bent.positions().subspan(range.first, range.count));
      renderer_.update_normals(shown.item, range.first,
                               bent.normals().subspan(range.first, range.count));
    }
    shown.revision = bent.revision();
  }
}

void Display::update_lattice(const Session& session) {
  LatticeMarks marks = lattice_marks(session);
  rest_.show(renderer_, std::move(marks.rest));
  cage_.show(renderer_, std::move(marks.cage));
  chosen_.show(renderer_, std::move(marks.chosen));
  controls_.show(renderer_, std::move(marks.controls));
  ghost_.show(renderer_, std::move(marks.ghost));
  gizmo_.show(renderer_, std::move(marks.gizmo));
  cursor_.show(renderer_, std::move(marks.cursor));
  model_marks_.show(renderer_, model_marks(session));
}

/// Found anew where the lattice is another one, at its points as they are.
void Display::update_shapes(const Session& session) {
  const Show& show = session.show();
  const bool has_lattice = !session.lattice().empty();
  TriangleMesh surface;
  LineSet refined;
  ShrunkCells cells;
  if (has_lattice) {
    const Lattice& lattice = lattice_in(session.scene(), session.lattice());
    if (show.has_surface) {
      if (!surface_ || !surface_->is_for(lattice)) {
        surface_.emplace(lattice);
      }
      surface = surface_->at(session);
    }
    if (show.refined_levels > 0) {
      if (!refined_ || !refined_->is_for(lattice, show.refined_levels)) {
        refined_.emplace(lattice, show.refined_levels);
      }
      refined = refined_->at(session);
    }
    if (show.has_shrunk_cells) {
      cells = shrunk_cells(session);
    }
  }
  surface_mesh_.show(renderer_, std::move(surface));
  refined_lines_.show(renderer_, std::move(refined));
  cell_mesh_.show(renderer_, std::move(cells.cells));
  selected_cell_mesh_.show(renderer_, std::move(cells.selected));
}

/// Of every model that the chosen lattice bends.
void Display::update_influence(const Session& session) {
  PointSet dots;
  if (!session.show().has_influence) {
    heat_.clear();
  }
  for (const auto& [names, bound] : session.scene().bound) {
    const auto& [model, lattice] = names;
    if (!session.show().has_influence || lattice != session.lattice()) {
      continue;
    }
    auto heat = heat_.find(model);
    if (heat == heat_.end() || !heat->second.is_for(bound.binding)) {
      heat_.erase(model);
      heat = heat_.emplace(model, InfluenceHeat(*bound.volume, bound.binding)).first;
    }
    add_influence_marks(session, model, heat->second, dots);
  }
  influence_marks_.show(renderer_, std::move(dots));
}

}  // namespace espalier::viewer
