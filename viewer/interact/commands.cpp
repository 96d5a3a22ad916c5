/// What every key means.

#include "viewer/interact/commands.h"

#include <algorithm>

namespace espalier::viewer {

namespace {

std::function<void(Session&)> switching(const std::function<void(Handling&)>& change) {
  return [change](Session& session) {
    Handling handling = session.handling();
    change(handling);
    session.set_handling(handling);
  };
}

std::function<void(Session&)> showing(const std::function<void(Show&)>& change) {
  return [change](Session& session) {
    Show show = session.show();
    change(show);
    session.set_show(show);
  };
}

/// Gizmo modes on keys, with `g` and others left for what they are in Blender.
std::vector<Command> transform_commands(Preset preset) {
  const auto transform = [](TransformKind wanted) {
    return [=](Session& session) { session.begin_transform(wanted); };
  };
  if (preset == Preset::Blender) {
    return {{"Move", "g", transform(TransformKind::Move)},
            {"Turn", "r", transform(TransformKind::Turn)},
            {"Scale", "s", transform(TransformKind::Scale)},
            {"Extrude faces", "e", &Session::begin_extrusion}};
  }
  const auto gizmo = [](TransformKind kind) {
    return switching([kind](Handling& handling) {
      handling.gizmo = kind;
      handling.has_gizmo = true;
    });
  };
  return {
      {"Handles that move", "w", gizmo(TransformKind::Move)},
      {"Handles that turn", "e", gizmo(TransformKind::Turn)},
      {"Handles that scale", "r", gizmo(TransformKind::Scale)},
      {"Without handles", "q", switching([](Handling& handling) { handling.has_gizmo = false; })},
      {"Move", "g", transform(TransformKind::Move)},
      {"Extrude faces", "ctrl+e", &Session::begin_extrusion}};
}

std::vector<Command> mode_commands() {
  const auto mode = [](Mode wanted) { return [=](Session& session) { session.set_mode(wanted); }; };
  const auto next_mode = [](Session& session) {
    session.set_mode(static_cast<Mode>((static_cast<int>(session.mode()) + 1) % 3));
  };
  return {{"Next mode: lattice, bind, pose", "tab", next_mode},
          {"Lattice mode: shape the lattice at rest", "ctrl+1", mode(Mode::Lattice)},
          {"Bind mode: see what the lattice holds", "ctrl+2", mode(Mode::Bind)},
          {"Pose mode: bend", "ctrl+3", mode(Mode::Pose)},
          {"New lattice: a box round the models", "n", &Session::new_box},
          {"Bind all models to the lattice", "b", &Session::bind}};
}

std::vector<Command> handling_commands() {
  const auto mirror = [](std::size_t axis) {
    return switching(
        [axis](Handling& handling) { handling.mirrors.at(axis) = !handling.mirrors.at(axis); });
  };
  return {{"Back to rest", "alt+g", &Session::rest},
          {"Soft selection (wheel: radius)", "o",
           switching([](Handling& handling) { handling.is_soft = !handling.is_soft; })},
          {"Stop drags before folds, or not", "shift+f", switching([](Handling& handling) {
             handling.stops_at_folds = !handling.stops_at_folds;
           })},
          {"Next pivot", "shift+.", switching([](Handling& handling) {
             handling.pivot = static_cast<Pivot>((static_cast<int>(handling.pivot) + 1) % 6);
           })},
          {"Mirror moves along x", "shift+x", mirror(0)},
          {"Mirror moves along y", "shift+y", mirror(1)},
          {"Mirror moves along z", "shift+z", mirror(2)},
          {"Keys as in Blender, or as in Maya", "f4", switching([](Handling& handling) {
             handling.preset = handling.preset == Preset::Blender ? Preset::Maya : Preset::Blender;
           })}};
}

Menu pivot_menu() {
  const auto pivot = [](Pivot wanted) {
    return switching([=](Handling& handling) { handling.pivot = wanted; });
  };
  return {"Turn and scale about",
          ".",
          {{"the middle of the selection's box", "", pivot(Pivot::Box)},
           {"the cursor", "", pivot(Pivot::Cursor)},
           {"its own middle, each part", "", pivot(Pivot::Individual)},
           {"the selection's median", "", pivot(Pivot::Median)},
           {"what was selected last", "", pivot(Pivot::Active)},
           {"the origin", "", pivot(Pivot::Origin)}}};
}

Menu snap_menu() {
  return {
      "Snap",
      "shift+s",
      {{"cursor to what is selected", "", &Session::cursor_to_selected},
       {"cursor to what was selected last", "", &Session::cursor_to_active},
       {"cursor to the origin", "", [](Session& session) { session.set_cursor(glm::dvec3(0.0)); }},
       {"no cursor", "", [](Session& session) { session.set_cursor(std::nullopt); }},
       {"selection to the cursor", "", &Session::selection_to_cursor}}};
}

/// Entries of menus under their menu's name.
std::vector<Command> menu_commands() {
  std::vector<Command> all;
  for (const Menu& menu : menus()) {
    for (const Command& entry : menu.entries) {
      all.push_back({menu.title + ": " + entry.name, "", entry.run});
    }
  }
  return all;
}

std::vector<Command> selection_commands(Preset preset) {
  const auto kind = [](ElementKind wanted) {
    return [=](Session& session) { session.set_element_kind(wanted); };
  };
  return {{"Select vertices", "1", kind(ElementKind::Vertex)},
          {"Select edges", "2", kind(ElementKind::Edge)},
          {"Select faces", "3", kind(ElementKind::Face)},
          {"Select cells", "4", kind(ElementKind::Cell)},
          {"Select all", preset == Preset::Blender ? "a" : "ctrl+shift+a",
           [](Session& session) { session.select_all(true); }},
          {"Select nothing", "alt+a", [](Session& session) { session.select_all(false); }},
          {"Select the rest instead", "ctrl+i", &Session::invert_selection},
          {"Select what is connected", "l", &Session::select_connected},
          {"Select through, or visible only", "alt+z",
           switching([](Handling& handling) { handling.is_through = !handling.is_through; })}};
}

std::vector<Command> view_commands(Preset preset) {
  const auto look = [](const char* view) {
    return [=](Session& session) { session.look_from(view); };
  };
  return {
      {"Hide what is selected", "h", &Session::hide_selected},
      {"Show what is hidden", "alt+h", &Session::reveal},
      {"Cut the lattice open, or not", "shift+c",
       showing([](Show& show) { show.cut = show.cut ? std::nullopt : std::optional<Cut>(Cut()); })},
      {"Outline the models' triangles, or not", "shift+w",
       switching([](Handling& handling) { handling.has_wireframe = !handling.has_wireframe; })},
      {"Light by lamps, or as a shiny ball (matcap)", "alt+m", switching([](Handling& handling) {
         handling.shading = handling.shading == Shading::Phong ? Shading::Matcap : Shading::Phong;
       })},
      {"Show the volume's boundary, or not", "shift+v",
       showing([](Show& show) { show.has_surface = !show.has_surface; })},
      {"Show the control points, or not", "",
       showing([](Show& show) { show.has_cage = !show.has_cage; })},
      {"Show the cells shrunk, or not", "",
       showing([](Show& show) { show.has_shrunk_cells = !show.has_shrunk_cells; })},
      {"Show the influence of the selection, or not", "",
       showing([](Show& show) { show.has_influence = !show.has_influence; })},
      {"Show the lattice refined once more, or not at all", "",
       showing([](Show& show) { show.refined_levels = (show.refined_levels + 1) % 4; })},
      {"See all", preset == Preset::Blender ? "home" : "home a", &Session::frame_all},
      {"See what is selected", preset == Preset::Blender ? "kp. shift+home" : "kp. shift+home f",
       &Session::frame_selected},
      {"Look from the front", "kp1 alt+1", look("front")},
      {"Look from the back", "ctrl+kp1 ctrl+alt+1", look("back")},
      {"Look from the right", "kp3 alt+3", look("right")},
      {"Look from the left", "ctrl+kp3 ctrl+alt+3", look("left")},
      {"Look from above", "kp7 alt+7", look("top")},
      {"Look from below", "ctrl+kp7 ctrl+alt+7", look("bottom")},
      {"With or without perspective", "kp5 alt+5", &Session::toggle_projection}};
}

std::vector<Command> all_commands(Preset preset) {
  std::vector<Command> all = mode_commands();
  const std::vector<Command> journal = {
      {"Undo", preset == Preset::Blender ? "ctrl+z" : "ctrl+z z", &Session::undo},
      {"Redo", "ctrl+shift+z ctrl+y", &Session::redo},
      {"Save bent models and the pose", "ctrl+s", &Session::save}};
  for (const std::vector<Command>& more :
       {transform_commands(preset), handling_commands(), selection_commands(preset), journal,
        view_commands(preset), menu_commands()}) {
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

}  // namespace

const std::vector<Command>& commands(Preset preset) {
  static const std::vector<Command> kBlender = all_commands(Preset::Blender);
  static const std::vector<Command> kMaya = all_commands(Preset::Maya);
  return preset == Preset::Blender ? kBlender : kMaya;
}

const std::vector<Menu>& menus() {
  static const std::vector<Menu> kMenus = {pivot_menu(), snap_menu()};
  return kMenus;
}

const Menu* menu_on(std::string_view chord) {
  const auto found = std::find_if(menus().begin(), menus().end(),
                                  [&](const Menu& menu) { return menu.key == chord; });
  return found == menus().end() ? nullptr : &*found;
}

}  // namespace espalier::viewer
