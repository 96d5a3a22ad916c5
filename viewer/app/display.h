#pragma once

/// Keeps what a renderer draws in step with a session.

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "viewer/app/lattice_shapes.h"
#include "viewer/app/shown_item.h"
#include "viewer/interact/influence_heat.h"
#include "viewer/interact/session.h"
#include "viewer/render/renderer.h"

namespace espalier::viewer {

/// Uploads only what changed since the last update: points that moved, a selection that is another.
class Display {
 public:
  /// The renderer must outlive the display.
  explicit Display(Renderer& renderer);
  void update(const Session& session);

 private:
  struct ShownModel {
    Model model;
    DrawingFrame frame;
    ItemId item;
    std::uint64_t revision;
    int arrangement;
    bool has_wireframe;
  };
  void update_models(const Session& session);
  void add_model(const Session& session, const std::string& name, const BentModel& bent);
  void update_lattice(const Session& session);
  void update_shapes(const Session& session);
  void update_influence(const Session& session);

  Renderer& renderer_;
  std::map<std::string, ShownModel> models_;
  ShownMarks<LineSet> cage_, rest_, ghost_, gizmo_, cursor_, refined_lines_;
  ShownMarks<PointSet> chosen_, controls_, model_marks_, influence_marks_;
  std::map<std::string, InfluenceHeat> heat_;  // by model that the chosen lattice bends
  ShownMesh surface_mesh_, cell_mesh_, selected_cell_mesh_;
  std::optional<FollowingSurface> surface_;
  std::optional<RefinedNet> refined_;
};

}  // namespace espalier::viewer
