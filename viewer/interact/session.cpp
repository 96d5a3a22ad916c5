#include "viewer/interact/session.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <set>
#include <utility>

#include "lattice/core/error.h"
#include "viewer/interact/picking.h"

namespace espalier::viewer {
namespace {

/// A press and a release no farther apart than this are a click, pixels.
constexpr double kClick = 4;
constexpr double kZoomAPixel = 0.02;
constexpr double kSoftAStep = 1.15;

Box bounds_of(const Scene& scene) {
  Box box;
  for (const auto& [name, model] : scene.models) {
    box.add(model.points());
  }
  for (const auto& [name, lattice] : scene.lattices) {
    box.add(lattice->rest);
    box.add(lattice->posed_points());
  }
  return box;
}

std::string bent_path(const std::string& name) {
  const std::filesystem::path path(name);
  return (path.parent_path() / (path.stem().string() + "_bent" + path.extension().string()))
      .string();
}

}  // namespace

void Session::handle(const Event& event) {
  std::visit([this](const auto& what) { on(what); }, event);
}

bool Session::apply(const OperationCall& call) {
  transform_.reset();
  try {
    journal_.apply(call, progress_);
    scene_changed();
    return true;
  } catch (const Error& error) {
    say(call.operation + ": " + error.what());
    return false;
  }
}

bool Session::open(const std::string& path) {
  const bool is_first = scene().models.empty() && scene().lattices.empty();
  const bool is_open = apply({"open", Arguments({{"path", path}})});
  if (is_open && is_first) {
    frame_all();
  }
  return is_open;
}

bool Session::run_line(const std::string& line) {
  try {
    return apply(parse_call(line));
  } catch (const Error& error) {
    say(error.what());
    return false;
  }
}

bool Session::recover(const std::string& journal_text) {
  try {
    replay(journal_text, journal_, progress_);
  } catch (const Error& error) {
    say(error.what());
  }
  scene_changed();
  frame_all();
  return messages_.empty();
}

/// The chosen lattice may be gone or another one.
void Session::scene_changed() {
  if (!scene().lattices.contains(lattice_)) {
    lattice_ = scene().lattices.empty() ? "" : scene().lattices.begin()->first;
    selection_.clear();
  }
  const auto now = lattice_.empty() ? nullptr : scene().lattices.at(lattice_);
  if (now == elements_source_) {
    return;
  }
  if (now == nullptr || elements_source_ == nullptr || now->complex != elements_source_->complex) {
    elements_ = now == nullptr ? LatticeElements() : elements_of(scene(), lattice_);
    selection_.clear();
  }
  elements_source_ = now;
}

void Session::choose_lattice(const std::string& name) {
  if (scene().lattices.contains(name) && name != lattice_) {
    transform_.reset();
    lattice_ = name;
    elements_source_ = nullptr;
    scene_changed();
  }
}

void Session::set_mode(Mode mode) {
  transform_.reset();
  mode_ = mode;
}

/// What is selected stays so as far as the new kind can say it.
void Session::set_element_kind(ElementKind kind) {
  selection_ = elements_.within(kind, selected_vertices());
  kind_ = kind;
}

void Session::select_all(bool is_selected) {
  selection_.clear();
  for (std::size_t i = 0; is_selected && i < elements_.count(kind_); ++i) {
    selection_.insert(static_cast<std::int32_t>(i));
  }
}

void Session::select_connected() {
  selection_ = elements_.connected(kind_, selection_);
}

void Session::invert_selection() {
  const Selection before = std::exchange(selection_, {});
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(elements_.count(kind_)); ++i) {
    if (!before.contains(i)) {
      selection_.insert(i);
    }
  }
}

void Session::toggle_soft() {
  is_soft_ = !is_soft_;
  if (soft_radius_ == 0 && !lattice_.empty()) {
    soft_radius_ = 0.3 * box_of(shown_points()).radius();
  }
}

void Session::begin_transform(TransformKind kind) {
  if (lattice_.empty() || selection_.empty()) {
    say("Select control points first: click them, or press a for all.");
    return;
  }
  if (mode_ == Mode::Bind) {
    say("Bind mode moves nothing: press Tab for Pose mode.");
    return;
  }
  const std::vector<glm::dvec3> points = shown_points();
  Transform transform{kind, {}, {}, mouse_, mouse_, glm::dvec3(0.0)};
  const Selection vertices = selected_vertices();
  for (const std::int32_t vertex : vertices) {
    transform.pivot += points[static_cast<std::size_t>(vertex)] / double(vertices.size());
  }
  transform_ = transform;
}

std::vector<glm::dvec3> Session::shown_points() const {
  if (lattice_.empty()) {
    return {};
  }
  const auto points = points_of(scene(), lattice_, shape());
  if (!transform_ || transform_->kind == TransformKind::Extrude) {
    return {points.begin(), points.end()};
  }
  return transform_->apply(view_, points, soft_weights(points, selected_vertices(), soft_radius()));
}

void Session::finish_transform() {
  if (transform_->kind == TransformKind::Extrude) {
    finish_extrusion();
    return;
  }
  const auto before = points_of(scene(), lattice_, shape());
  const std::vector<glm::dvec3> after = shown_points();
  std::vector<std::int64_t> indices;
  std::vector<double> to;
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (after[i] != before[i]) {
      indices.push_back(static_cast<std::int64_t>(i));
      to.insert(to.end(), {after[i].x, after[i].y, after[i].z});
    }
  }
  transform_.reset();
  if (!indices.empty()) {
    apply({"move points",
           Arguments({{"lattice", lattice_},
                      {"points", std::move(indices)},
                      {"to", std::move(to)},
                      {"shape", std::string(shape() == Shape::Pose ? "pose" : "rest")}})});
  }
}

void Session::new_box() {
  Box box;
  for (const auto& [name, model] : scene().models) {
    box.add(model.points());
  }
  if (scene().models.empty() || !(box.radius() > 0)) {
    say("A box goes round a model: open one first.");
    return;
  }
  constexpr double kMargin = 0.05;
  box = box.grown(kMargin * box.radius());
  const std::filesystem::path beside(scene().models.begin()->first);
  std::string name;
  for (int i = 1; name.empty() || scene().lattices.contains(name); ++i) {
    name = (beside.parent_path() /
            ("lattice" + (i == 1 ? std::string() : std::to_string(i)) + ".json"))
               .string();
  }
  if (apply({"new box", Arguments({{"cells", std::vector<std::int64_t>{1, 1, 1}},
                                   {"min", std::vector<double>{box.min.x, box.min.y, box.min.z}},
                                   {"max", std::vector<double>{box.max.x, box.max.y, box.max.z}},
                                   {"output", name}})})) {
    choose_lattice(name);
    select_all(true);
  }
}

void Session::bind() {
  if (lattice_.empty() || scene().models.empty()) {
    say("Binding needs a model and a lattice: open them first.");
    return;
  }
  std::vector<std::string> names;
  for (const auto& [name, model] : scene().models) {
    names.push_back(name);
  }
  for (const std::string& name : names) {
    if (!apply({"bind", Arguments({{"model", name}, {"lattice", lattice_}})})) {
      return;
    }
  }
}

void Session::rest() {
  if (!lattice_.empty()) {
    apply({"set pose", Arguments({{"lattice", lattice_}})});
  }
}

void Session::save() {
  std::set<std::string> models;
  for (const auto& [key, bound] : scene().bound) {
    models.insert(key.first);
  }
  bool is_saved = true;
  for (const std::string& model : models) {
    is_saved &= apply({"save deformed", Arguments({{"model", model}, {"path", bent_path(model)}})});
  }
  if (!lattice_.empty()) {
    is_saved &= apply({"save", Arguments({{"name", lattice_}, {"path", bent_path(lattice_)}})});
  }
  if (is_saved) {
    journal_.mark_saved();
    say("Saved beside the files that were opened, as NAME_bent.");
  }
}

void Session::undo() {
  transform_.reset();
  journal_.undo();
  scene_changed();
}

void Session::redo() {
  transform_.reset();
  journal_.redo();
  scene_changed();
}

void Session::frame_all() {
  const Box box = bounds_of(scene());
  view_.frame = DrawingFrame::of(box);
  view_.camera = view_.camera.fitted_to(view_.frame.to_drawing(box), view_.aspect());
}

void Session::frame_selected() {
  Box box;
  const std::vector<glm::dvec3> points = shown_points();
  for (const std::int32_t vertex : selected_vertices()) {
    box.add(view_.frame.to_drawing(points[static_cast<std::size_t>(vertex)]));
  }
  if (box.radius() > 0) {
    const double radius = view_.camera.radius;
    view_.camera = view_.camera.fitted_to(box, view_.aspect(), 0.2);
    view_.camera.radius = 2 * radius + glm::length(view_.camera.target);
  }
}

void Session::look_from(const std::string& view_name) {
  view_.camera.angles = named_view(view_name);
}

void Session::toggle_projection() {
  view_.camera.projection = view_.camera.projection == Projection::Perspective
                                ? Projection::Orthographic
                                : Projection::Perspective;
}

std::string Session::status() const {
  if (transform_) {
    return transform_->text(view_) + "   Enter or click: done   Esc: cancel   x y z: axis";
  }
  if (lattice_.empty()) {
    return "Open a model and a lattice: drop their files here, or press F2.";
  }
  return std::to_string(selection_.size()) + " selected   g move   r turn   s scale   F1 help";
}

bool Session::on_transform_key(const std::string& chord) {
  if (chord == "enter" || chord == "kpenter") {
    finish_transform();
    return true;
  }
  if (chord == "escape") {
    transform_.reset();
    return true;
  }
  const bool is_plane = chord.starts_with("shift+");
  const std::string key = is_plane ? chord.substr(6) : chord;
  if (key == "x" || key == "y" || key == "z") {
    transform_->toggle({key[0] - 'x', is_plane});
    return true;
  }
  return transform_->type(key.starts_with("kp") ? key.substr(2) : key);
}

void Session::on(const KeyPress& key) {
  if (transform_ && on_transform_key(key.chord)) {
    return;
  }
  for (const Command& command : commands()) {
    if ((" " + command.keys + " ").find(" " + key.chord + " ") != std::string::npos) {
      command.run(*this);
      return;
    }
  }
}

void Session::on(const MousePress& press) {
  mouse_ = press.at;
  held_ = press.held;
  if (transform_) {
    if (press.button == MouseButton::Left) {
      transform_->at = press.at;
      finish_transform();
    } else if (press.button == MouseButton::Right) {
      transform_.reset();
    }
    return;
  }
  if (press.button == MouseButton::Left && !press.held.alt) {
    drag_ = Drag::Select;
    rubber_ = Rubber{press.at, press.at};
  } else if (press.button == MouseButton::Left) {
    drag_ = Drag::Orbit;
    rubber_ = Rubber{press.at, press.at};
  } else if (press.button == MouseButton::Middle) {
    drag_ = press.held.shift ? Drag::Pan : press.held.ctrl ? Drag::Zoom : Drag::Orbit;
  }
}

void Session::on(const MouseMove& move) {
  const glm::dvec2 by = move.at - mouse_;
  mouse_ = move.at;
  if (transform_) {
    transform_->at = move.at;
  }
  if (drag_ == Drag::Orbit) {
    view_.camera = orbited(view_.camera, by);
  } else if (drag_ == Drag::Pan) {
    view_.camera = panned(view_.camera, by, view_.height);
  } else if (drag_ == Drag::Zoom) {
    view_.camera = zoomed(view_.camera, -kZoomAPixel * by.y);
  }
  if (rubber_) {
    rubber_->to = move.at;
  }
}

void Session::on(const MouseRelease& release) {
  on(MouseMove{release.at});
  const Drag drag = std::exchange(drag_, Drag::None);
  const std::optional<Rubber> box = std::exchange(rubber_, std::nullopt);
  if (!box || lattice_.empty()) {
    return;
  }
  const bool is_click = glm::length(box->to - box->from) <= kClick;
  if (drag == Drag::Orbit && is_click) {
    click_loop(release.at);
  } else if (drag == Drag::Select && is_click) {
    click(release.at);
  } else if (drag == Drag::Select) {
    select_box(*box);
  }
}

void Session::on(const Scroll& scroll) {
  if (transform_ && is_soft_) {
    soft_radius_ *= std::pow(kSoftAStep, scroll.steps);
  } else {
    view_.camera = zoomed(view_.camera, scroll.steps);
  }
}

void Session::on(const Resize& size) {
  view_.width = std::max(size.width, 1);
  view_.height = std::max(size.height, 1);
}

void Session::click(const glm::dvec2& at) {
  const std::vector<glm::dvec3> points = shown_points();
  const auto found = pick(view_, {elements_, points, kind_, is_through_}, at);
  if (!held_.shift) {
    selection_.clear();
  }
  if (found && !selection_.erase(*found)) {
    selection_.insert(*found);
  }
}

/// The loop of the edge that was clicked: its vertices, its edges, or what lies between them.
void Session::click_loop(const glm::dvec2& at) {
  const std::vector<glm::dvec3> points = shown_points();
  const auto edge = pick(view_, {elements_, points, ElementKind::Edge, is_through_}, at);
  if (!held_.shift) {
    selection_.clear();
  }
  if (edge) {
    const Selection loop =
        elements_.within(kind_, elements_.vertices(ElementKind::Edge, elements_.loop(*edge)));
    selection_.insert(loop.begin(), loop.end());
  }
}

void Session::select_box(const Rubber& box) {
  const std::vector<glm::dvec3> points = shown_points();
  const Selection found =
      pick_box(view_, {elements_, points, kind_, is_through_}, box.from, box.to);
  if (!held_.shift) {
    selection_.clear();
  }
  selection_.insert(found.begin(), found.end());
}

}  // namespace espalier::viewer
