#pragma once

/// A user at work: mouse and keys in, operations of the scene out.

#include <array>
#include <glm/vec2.hpp>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "viewer/interact/bent_models.h"
#include "viewer/interact/event.h"
#include "viewer/interact/gizmo.h"
#include "viewer/interact/handling.h"
#include "viewer/interact/journal.h"
#include "viewer/interact/lattice_elements.h"
#include "viewer/interact/operation_form.h"
#include "viewer/interact/preview.h"
#include "viewer/interact/show.h"
#include "viewer/interact/transform.h"
#include "viewer/interact/view.h"

namespace espalier::viewer {

/// The job's three parts: shape the lattice at rest, tie models to it, move its control points.
enum class Mode { Lattice, Bind, Pose };

/// A rectangle being drawn, pixels.
struct Rubber {
  glm::dvec2 from{0.0};
  glm::dvec2 to{0.0};
};

/// How a model was tied to a lattice last.
struct BindingHabit {
  std::string freeze, outside, lock;
};

/// What a user sees and changes, without any window. Errors become messages.
class Session {
 public:
  /// progress: asked by every operation.
  explicit Session(Progress progress = {}) : progress_(std::move(progress)) {}

  void handle(const Event& event);
  /// Does an operation, as an entry of the journal. False if it failed: the last message says why.
  bool apply(const OperationCall& call);
  /// Opens a model or lattice; the first ones decide where the camera stands.
  bool open(const std::string& path);
  /// Does the operation that a line of a journal holds.
  bool run_line(const std::string& line);
  /// Replays a journal's text on top of what is there, as far as that can be done; false if not to
  /// its end.
  bool recover(const std::string& journal_text);

  // What a panel's buttons and keys do.
  void set_mode(Mode mode);
  void set_element_kind(ElementKind kind);
  void set_handling(const Handling& handling);
  void set_show(const Show& show);
  void choose_lattice(const std::string& name);
  void begin_transform(TransformKind kind);
  /// Grows cells from the selected faces, or from those all of whose vertices are selected.
  void begin_extrusion();
  void select_all(bool is_selected);
  void select_connected();
  void invert_selection();
  /// Hides what is selected; reveal() shows all that was hidden so.
  void hide_selected();
  void reveal();
  /// The cursor goes to the model under a pixel, or beside it as far away as it is.
  void place_cursor(const glm::dvec2& at);
  void set_cursor(const std::optional<glm::dvec3>& place) { cursor_ = place; }
  void cursor_to_selected();
  void cursor_to_active();
  /// Moves what is selected so that its middle is at the cursor.
  void selection_to_cursor();
  /// A lattice of one cell round all models, lattice.json beside the first one.
  void new_box();
  /// Ties every model to the chosen lattice, with the options and the lock that it had before.
  void bind();
  /// The chosen lattice back at rest.
  void rest();
  /// Makes the selected edges or vertices so sharp: 0 smooth, from 10 on infinitely.
  void set_sharpness(double sharpness);
  /// The greatest of the selected edges or vertices.
  [[nodiscard]] double sharpness() const;
  /// What an operation would make is shown until it is done or ended. waits: however long it takes.
  void preview(const OperationCall& call, bool waits = false);
  void end_preview();
  /// Does what a form says, and chooses the lattice that it makes.
  void run_form(const OperationCall& call);
  /// Writes every bound model, bent, and the lattices that bend them and the chosen one, with their
  /// poses, beside their files, as NAME_bent.EXTENSION.
  void save();
  /// Writes a model, bent, or a lattice; over the file of an open model never, over another one
  /// when asked twice.
  void save_as(const std::string& name, const std::string& path);
  void undo();
  void redo();
  void frame_all();
  void frame_selected();
  void look_from(const std::string& view_name);
  void toggle_projection();
  /// A message that is there already moves to the end.
  void say(const std::string& message);
  void forget_messages() { messages_.clear(); }

  [[nodiscard]] const Journal& journal() const { return journal_; }
  [[nodiscard]] const Scene& scene() const { return journal_.scene(); }
  [[nodiscard]] Mode mode() const { return mode_; }
  [[nodiscard]] ElementKind element_kind() const { return kind_; }
  [[nodiscard]] const View& view() const { return view_; }
  [[nodiscard]] const Handling& handling() const { return handling_; }
  [[nodiscard]] const Show& show() const { return show_; }
  [[nodiscard]] const std::string& lattice() const { return lattice_; }  ///< "": none
  [[nodiscard]] const LatticeElements& elements() const { return elements_; }
  [[nodiscard]] const Visible& visible() const { return visible_; }  ///< of the elements
  [[nodiscard]] const Selection& selection() const { return selection_; }
  [[nodiscard]] const std::optional<glm::dvec3>& cursor() const { return cursor_; }
  [[nodiscard]] Selection selected_vertices() const {
    return elements_.vertices(kind_, selection_);
  }
  [[nodiscard]] Shape shape() const { return mode_ == Mode::Pose ? Shape::Pose : Shape::Rest; }
  /// In Pose mode the control points that the locks of all bound models keep at rest.
  [[nodiscard]] const Selection& locked() const { return locked_; }
  /// The chosen lattice's points as they are on the screen, a transform in progress included.
  [[nodiscard]] std::span<const glm::dvec3> shown_points() const;
  /// The models as they are on the screen: bent in Pose mode only.
  [[nodiscard]] const BentModels& bent_models() const { return bent_; }
  [[nodiscard]] const std::optional<Transform>& transform() const { return transform_; }
  /// While a drag is stopped before a fold: how much of it is done; else 1.
  [[nodiscard]] double done_fraction() const { return transform_ ? fraction_ : 1; }
  /// The handles to draw, if there are any; and what that under the mouse, or in use, locks.
  [[nodiscard]] std::optional<Gizmo> gizmo() const;
  [[nodiscard]] std::optional<AxisLock> active_handle() const;
  /// While faces are extruded: the edges of the cells to come, two points each, model units.
  [[nodiscard]] std::vector<glm::dvec3> ghost() const;
  [[nodiscard]] const Preview& shown_preview() const { return preview_; }
  /// What a form begins with.
  [[nodiscard]] FormContext form_context() const;
  [[nodiscard]] const std::optional<Rubber>& rubber() const { return rubber_; }
  [[nodiscard]] const std::vector<std::string>& messages() const { return messages_; }
  /// What is going on, in one line.
  [[nodiscard]] std::string status() const;

 private:
  enum class Drag { None, Orbit, Pan, Zoom, Select, Cursor };

  void on(const KeyPress& key);
  void on(const MousePress& press);
  void on(const MouseRelease& release);
  void on(const MouseMove& move);
  void on(const Scroll& scroll);
  void on(const TextInput& /*text*/) {}
  void on(const Resize& size);
  bool on_transform_key(const std::string& chord);
  [[nodiscard]] Drag drag_of(const MousePress& press) const;
  [[nodiscard]] glm::dvec3 pivot() const;
  [[nodiscard]] bool may_move();
  [[nodiscard]] std::string shape_name() const { return mode_ == Mode::Pose ? "pose" : "rest"; }
  bool bind_model(const std::string& model);
  void begin_drag();
  void follow_transform();
  void mirror(std::vector<glm::dvec3>& to) const;
  void cancel_transform();
  void finish_transform();
  void finish_held(const glm::dvec2& at);
  void finish_extrusion();
  void click(const glm::dvec2& at);
  void click_loop(const glm::dvec2& at);
  void select_box(const Rubber& box);
  [[nodiscard]] std::optional<std::int32_t> picked(ElementKind kind, const glm::dvec2& at) const;
  void scene_changed();
  void refresh();
  void find_points();
  void bend_models();
  void note_bindings();

  Progress progress_;
  Journal journal_;
  Mode mode_ = Mode::Lattice;
  ElementKind kind_ = ElementKind::Vertex;
  View view_;
  Handling handling_;
  Show show_;
  std::string lattice_;
  std::string replaced_;  ///< the file that save_as() may write over
  LatticeElements elements_;
  std::optional<Lattice> elements_source_;
  Visible visible_;
  Selection selection_;
  Selection last_selected_;  // vertices of the element that was clicked last
  std::optional<glm::dvec3> cursor_;
  Selection locked_;
  std::vector<glm::dvec3> points_;  // #controls: on the screen, but for a transform
  std::map<std::pair<std::string, std::string>, BindingHabit> habits_;  // by (model, lattice)
  BentModels bent_;
  std::optional<Transform> transform_;
  std::vector<double> weights_;                      // #controls: how much each follows a transform
  std::array<std::vector<std::int32_t>, 3> images_;  // by axis that is mirrored
  std::vector<glm::dvec3> moved_;                    // #controls: where a transform has them
  double fraction_ = 1;
  std::optional<Rubber> rubber_;
  Drag drag_ = Drag::None;
  Modifiers held_;
  glm::dvec2 mouse_{0.0};
  Preview preview_;
  std::vector<std::string> messages_;
};

}  // namespace espalier::viewer
