#pragma once

/// Keeps what a renderer draws in step with a session.

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "viewer/interact/bent_models.h"
#include "viewer/interact/session.h"
#include "viewer/render/mesh_drawing.h"
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
    MeshDrawing drawing;
    ItemId item;
    std::vector<Bend> bends;           // what the item shows
    std::vector<glm::vec3> positions;  // as uploaded
    std::vector<glm::vec3> normals;
  };
  void update_frame(const Session& session);
  void update_models(const Session& session);
  void update_model(const Session& session, const std::string& name, ShownModel& shown);
  void update_lattice(const Session& session);
  void update_marks(const Session& session);

  Renderer& renderer_;
  DrawingFrame frame_;
  std::map<std::string, ShownModel> models_;
  std::vector<ItemId> lattice_items_;  // lines, then points
  std::vector<ItemId> mark_items_;     // what is bound, and what is to come
  std::string lattice_key_;            // what lattice_items_ show, but for where the points are
  std::shared_ptr<const CellComplex> complex_;
  std::vector<glm::dvec3> lattice_points_;
  std::vector<glm::dvec3> ghost_;
  std::shared_ptr<const Binding> binding_;
};

}  // namespace espalier::viewer
