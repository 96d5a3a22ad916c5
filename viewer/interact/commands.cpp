/// What every key means.

#include "viewer/interact/session.h"

namespace espalier::viewer {

const std::vector<Command>& commands() {
  const auto mode = [](Mode wanted) { return [=](Session& session) { session.set_mode(wanted); }; };
  const auto kind = [](ElementKind wanted) {
    return [=](Session& session) { session.set_element_kind(wanted); };
  };
  const auto transform = [](TransformKind wanted) {
    return [=](Session& session) { session.begin_transform(wanted); };
  };
  const auto look = [](const char* view) {
    return [=](Session& session) { session.look_from(view); };
  };
  const auto next_mode = [](Session& session) {
    session.set_mode(static_cast<Mode>((static_cast<int>(session.mode()) + 1) % 3));
  };
  static const std::vector<Command> kCommands = {
      {"Next mode: lattice, bind, pose", "tab", next_mode},
      {"Lattice mode: shape the lattice at rest", "ctrl+1", mode(Mode::Lattice)},
      {"Bind mode: see what the lattice holds", "ctrl+2", mode(Mode::Bind)},
      {"Pose mode: bend", "ctrl+3", mode(Mode::Pose)},
      {"New lattice: a box round the models", "n", &Session::new_box},
      {"Bind all models to the lattice", "b", &Session::bind},
      {"Move", "g", transform(TransformKind::Move)},
      {"Turn", "r", transform(TransformKind::Turn)},
      {"Scale", "s", transform(TransformKind::Scale)},
      {"Extrude faces", "e", &Session::begin_extrusion},
      {"Soft selection (wheel: radius)", "o", &Session::toggle_soft},
      {"Back to rest", "alt+g", &Session::rest},
      {"Select vertices", "1", kind(ElementKind::Vertex)},
      {"Select edges", "2", kind(ElementKind::Edge)},
      {"Select faces", "3", kind(ElementKind::Face)},
      {"Select cells", "4", kind(ElementKind::Cell)},
      {"Select all", "a", [](Session& session) { session.select_all(true); }},
      {"Select nothing", "alt+a", [](Session& session) { session.select_all(false); }},
      {"Select the rest instead", "ctrl+i", &Session::invert_selection},
      {"Select what is connected", "l", &Session::select_connected},
      {"Select through, or visible only", "alt+z", &Session::toggle_through},
      {"Undo", "ctrl+z", &Session::undo},
      {"Redo", "ctrl+shift+z ctrl+y", &Session::redo},
      {"Save bent models and the pose", "ctrl+s", &Session::save},
      {"See all", "home", &Session::frame_all},
      {"See what is selected", "kp. .", &Session::frame_selected},
      {"Look from the front", "kp1", look("front")},
      {"Look from the back", "ctrl+kp1", look("back")},
      {"Look from the right", "kp3", look("right")},
      {"Look from the left", "ctrl+kp3", look("left")},
      {"Look from above", "kp7", look("top")},
      {"Look from below", "ctrl+kp7", look("bottom")},
      {"With or without perspective", "kp5", &Session::toggle_projection},
  };
  return kCommands;
}

}  // namespace espalier::viewer
