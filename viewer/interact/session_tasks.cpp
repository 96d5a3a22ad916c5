/// What a session does to its scene as a whole.

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "deform/scene/operations.h"
#include "lattice/io/number_text.h"
#include "viewer/interact/session.h"

namespace espalier::viewer {
namespace {

std::string bent_path(const std::string& name) {
  const std::filesystem::path path(name);
  return (path.parent_path() / (path.stem().string() + "_bent" + path.extension().string()))
      .string();
}

}  // namespace

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
    if (!bind_model(name)) {
      return;
    }
  }
}

bool Session::bind_model(const std::string& model) {
  Arguments arguments({{"model", model}, {"lattice", lattice_}});
  const auto known = habits_.find({model, lattice_});
  const BindingHabit habit = known != habits_.end() ? known->second : BindingHabit();
  if (!habit.freeze.empty()) {
    arguments.set("freeze", habit.freeze);
  }
  if (!habit.outside.empty()) {
    arguments.set("outside", habit.outside);
  }
  if (!apply({"bind", arguments})) {
    return false;
  }
  if (habit.lock.empty() || habit.lock == scene().bound.at({model, lattice_}).lock.option) {
    return true;
  }
  return apply(
      {"set lock", Arguments({{"model", model}, {"lattice", lattice_}, {"lock", habit.lock}})});
}

void Session::rest() {
  if (!lattice_.empty()) {
    apply({"set pose", Arguments({{"lattice", lattice_}})});
  }
}

double Session::sharpness() const {
  float most = 0;
  for (const std::int32_t element : selection_) {
    const auto i = static_cast<std::size_t>(element);
    most = std::max(most, kind_ == ElementKind::Edge     ? elements_.edge_sharpness[i]
                          : kind_ == ElementKind::Vertex ? elements_.vertex_sharpness[i]
                                                         : 0.0F);
  }
  return most;
}

void Session::set_sharpness(double sharpness) {
  FormContext context = form_context();
  OperationForm form = form_for(operation_named("crease"), context);
  for (FormField& field : form.fields) {
    if (field.parameter->name == "sharpness") {
      field.text.clear();
      append_number(field.text, sharpness);
    }
  }
  apply(form.call());
}

FormContext Session::form_context() const {
  FormContext context;
  for (const auto& [name, model] : scene().models) {
    context.models.push_back(name);
  }
  for (const auto& [name, lattice] : scene().lattices) {
    context.lattices.push_back(name);
  }
  for (const auto& [name, pose] : scene().poses) {
    context.poses.push_back(name);
  }
  context.lattice = lattice_;
  const std::string beside = !context.models.empty()     ? context.models.front()
                             : !context.lattices.empty() ? context.lattices.front()
                                                         : "";
  context.folder = std::filesystem::path(beside).parent_path().string();
  context.kind = kind_;
  context.selection = selection_;
  context.elements = &elements_;
  context.cursor = cursor_;
  return context;
}

void Session::run_form(const OperationCall& call) {
  if (!apply(call)) {
    return;
  }
  for (const Parameter& parameter : operation_named(call.operation).parameters) {
    if (parameter.type == ParameterType::Result && call.arguments.has(parameter.name)) {
      choose_lattice(call.arguments.text(parameter.name));
    }
  }
}

void Session::save() {
  std::set<std::string> models;
  std::set<std::string> lattices;
  for (const auto& [key, bound] : scene().bound) {
    models.insert(key.first);
    lattices.insert(key.second);
  }
  if (!lattice_.empty()) {
    lattices.insert(lattice_);
  }
  bool is_saved = true;
  for (const std::string& model : models) {
    is_saved &= apply({"save deformed", Arguments({{"model", model}, {"path", bent_path(model)}})});
  }
  for (const std::string& lattice : lattices) {
    is_saved &= apply({"save", Arguments({{"name", lattice}, {"path", bent_path(lattice)}})});
  }
  if (is_saved) {
    journal_.mark_saved();
    say("Saved beside the files that were opened, as NAME_bent.");
  }
}

void Session::save_as(const std::string& name, const std::string& path) {
  if (path.empty()) {
    say("Type the name of the file to write first.");
    return;
  }
  std::error_code failure;
  for (const auto& [model, content] : scene().models) {
    if (std::filesystem::equivalent(model, path, failure)) {
      say(path + " is the model as it was opened: write what is bent elsewhere, such as to " +
          bent_path(model) + ".");
      return;
    }
  }
  if (std::filesystem::exists(path, failure) && path != replaced_) {
    replaced_ = path;
    say(path + " is there already: save once more to replace it.");
    return;
  }
  const std::string operation = scene().models.contains(name) ? "save deformed" : "save";
  const std::string parameter = scene().models.contains(name) ? "model" : "name";
  if (apply({operation, Arguments({{parameter, name}, {"path", path}})})) {
    replaced_ = path;
    say("Saved " + path + ".");
  }
}

}  // namespace espalier::viewer
