#pragma once

/// A model as it is drawn, bent by its lattices: whole, or as control points are dragged.

#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "deform/evaluate/affine_drag.h"
#include "deform/evaluate/drag.h"
#include "deform/scene/scene.h"
#include "viewer/interact/drag_motion.h"
#include "viewer/interact/float_evaluation.h"
#include "viewer/render/drawing_frame.h"
#include "viewer/render/mesh_drawing.h"
#include "viewer/render/model_texture.h"

namespace espalier::viewer {

/// A lattice that a model is bound to, and where its control points are.
struct Bend {
  std::shared_ptr<const Volume> volume;
  std::shared_ptr<const Binding> binding;  ///< of the model's points
  std::vector<glm::dvec3> controls;
  std::vector<double> pose_weights = {};  ///< of the volume's points, as LatticeMotion has them

  bool operator==(const Bend&) const = default;
};

/// Control points about to be moved together, as they are at mouse-down.
struct DragPlan {
  std::size_t dragged = 0;           ///< which of the bends has them
  std::vector<double> weights;       ///< #controls in [0, 1]: how much of the motion each takes
  std::vector<glm::dvec3> controls;  ///< #controls at mouse-down
  glm::dvec3 pivot{0};
  bool is_turned = false;  ///< by a linear map about the pivot, else by a displacement
};

/// Vertices that follow each other.
struct VertexRange {
  std::size_t first = 0;
  std::size_t count = 0;
  bool operator==(const VertexRange&) const = default;
};

/// The vertices that a model is drawn with, in float: what a drag writes is what is uploaded. A
/// model's own faces decide where its points become several vertices, with a normal each.
class BentModel {
 public:
  /// frame: positions are model units from its origin; revision: to begin with. O(corners).
  BentModel(const Model& model, const DrawingFrame& frame, std::uint64_t revision = 0);

  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] const MeshDrawing& drawing() const { return drawing_; }
  /// What its triangles wear; none for a model without pictures.
  [[nodiscard]] const std::vector<TextureRange>& textures() const { return textures_; }
  /// #vertices each.
  [[nodiscard]] std::span<const glm::vec3> positions() const { return positions_; }
  [[nodiscard]] std::span<const glm::vec3> normals() const { return normals_; }
  /// 1 where space is folded; empty while nothing bends the model.
  [[nodiscard]] std::span<const std::uint8_t> folded() const { return folded_; }

  /// How much of it the model follows from the next bend() on; null: all of it.
  void set_influence(std::shared_ptr<const ModelInfluence> influence);
  /// Bends the model anew, if it is not bent so already. O(#vertices · degree³).
  void bend(const std::vector<Bend>& bends);

  /// Mouse-down: from here on follow() moves what is bent. O(#vertices · degree³).
  void begin_drag(const DragPlan& plan);
  /// How much of a motion folds no vertex that is not folded yet, from 0 to 1.
  [[nodiscard]] double safe_fraction(const DragMotion& motion) const;
  /// The same where every control point of one of the bends goes straight to a place of its own;
  /// nothing has to be begun. start: with the bindings of bend(); to: #controls. O(#vertices ·
  /// degree³).
  [[nodiscard]] double safe_fraction(const std::vector<Bend>& start, std::size_t dragged,
                                     std::span<const glm::dvec3> to) const;
  /// Moves the vertices that the drag reaches, from where they were at mouse-down; marks those that
  /// fold if asked to. O(#reached).
  void follow(const DragMotion& motion, bool marks_folds);

  /// Mouse-down for motions that no drag knows, if one lattice bends the model: evaluate() is
  /// ready.
  void begin_evaluation();
  /// As bend() with one lattice's control points elsewhere, but in float where it can. Returns
  /// whether vertices are folded. controls: #controls. O(#vertices · degree³).
  bool evaluate(std::size_t dragged, std::span<const glm::dvec3> controls);

  /// Grows when the vertices get another order: that in which the lattice that bends the model
  /// alone evaluates them.
  [[nodiscard]] int arrangement() const { return arrangement_; }
  /// Grows whenever vertices move.
  [[nodiscard]] std::uint64_t revision() const { return revision_; }
  /// Ranges that hold all that moved since a revision, ascending.
  [[nodiscard]] std::vector<VertexRange> changed_since(std::uint64_t revision) const;

 private:
  using Bound = std::pair<std::shared_ptr<const Binding>, std::shared_ptr<const Binding>>;
  [[nodiscard]] std::vector<LatticeMotion> motions(const std::vector<Bend>& bends) const;
  [[nodiscard]] DragModel drag_model(std::span<const LatticeMotion> motions) const;
  void bind_vertices(const std::vector<Bend>& bends);
  void arrange_for(const Binding& binding);
  void find_vertex_influence();
  void note_change(std::vector<VertexRange> ranges);
  void note_dragged();

  BentModel(const Model& model, const DrawingFrame& frame, std::uint64_t revision,
            const std::optional<ModelTexture>& texture);

  Model model_;
  MeshDrawing drawing_;
  std::vector<TextureRange> textures_;
  std::vector<glm::dvec3> rest_;          // #vertices, from the frame's origin
  std::vector<glm::dvec3> rest_normals_;  // #vertices
  std::shared_ptr<const ModelInfluence> influence_;
  Influence vertex_influence_;  // of the vertices
  std::vector<Bend> bends_;
  std::vector<Bound> bound_;  // of the points, and the same of the vertices
  std::vector<glm::vec3> positions_;
  std::vector<glm::vec3> normals_;
  std::vector<std::uint8_t> folded_;
  std::variant<std::monostate, Drag<float>, AffineDrag<float>, FloatEvaluation> drag_;
  std::shared_ptr<const Binding> arranged_for_;
  int arrangement_ = 0;
  std::vector<VertexRange> reached_;  // by the drag
  bool is_dragged_ = false;           // since it was bent
  bool has_followed_ = false;         // since the drag began
  std::uint64_t revision_;
  std::uint64_t known_since_;  // revision from which on changed_ holds all changes
  std::vector<VertexRange> changed_;
};

}  // namespace espalier::viewer
