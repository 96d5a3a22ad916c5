#include "viewer/interact/operation_form.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <sstream>

#include "lattice/core/error.h"
#include "lattice/io/number_text.h"

namespace espalier::viewer {
namespace {

/// A value as the line of a journal has it, unquoted.
std::string text_of_value(const Operation& operation, const Parameter& parameter,
                          const Value& value) {
  if (const auto* text = std::get_if<std::string>(&value)) {
    return *text;
  }
  const std::string line =
      espalier::text_of({operation.name, Arguments({{parameter.name, value}})});
  return line.substr(line.find('=') + 1);
}

bool is_reference(ParameterType type) {
  return type == ParameterType::Model || type == ParameterType::Lattice ||
         type == ParameterType::ModelOrLattice;
}

std::string joined(const Selection& numbers) {
  std::string text;
  for (const std::int32_t number : numbers) {
    text += (text.empty() ? "" : ",") + std::to_string(number);
  }
  return text;
}

/// Edges by their ends: "0-1,4-5".
std::string edge_names(const FormContext& context) {
  std::string text;
  for (const std::int32_t edge : context.selection) {
    const auto ends = context.elements->edges[static_cast<std::size_t>(edge)];
    text += (text.empty() ? "" : ",") + std::to_string(ends[0]) + "-" + std::to_string(ends[1]);
  }
  return text;
}

/// What is selected, for a parameter that asks for such elements.
std::string selected_text(const std::string& name, const FormContext& context) {
  if (context.elements == nullptr || context.selection.empty()) {
    return "";
  }
  switch (context.kind) {
    case ElementKind::Vertex:
      return name == "vertices" || name == "points" ? joined(context.selection) : "";
    case ElementKind::Edge:
      return name == "edges" || (name == "edge" && context.selection.size() == 1)
                 ? edge_names(context)
                 : "";
    case ElementKind::Face:
      return name == "faces" ? joined(context.selection) : "";
    default:
      return name == "cells" ? joined(context.selection) : "";
  }
}

/// FOLDER/NAME.json that no lattice has yet.
std::string new_name(const Operation& operation, const FormContext& context) {
  std::string stem = operation.name.starts_with("new ") ? operation.name.substr(4) : "lattice";
  std::replace(stem.begin(), stem.end(), ' ', '_');
  for (int i = 1;; ++i) {
    const std::string name = stem + (i == 1 ? "" : std::to_string(i)) + ".json";
    std::string path = (std::filesystem::path(context.folder) / name).string();
    if (std::find(context.lattices.begin(), context.lattices.end(), path) ==
        context.lattices.end()) {
      return path;
    }
  }
}

std::vector<std::string> choices_of(const Parameter& parameter, const FormContext& context) {
  switch (parameter.type) {
    case ParameterType::Flag:
      return {"false", "true"};
    case ParameterType::Choice:
      return parameter.choices;
    case ParameterType::Model:
      return context.models;
    case ParameterType::Lattice:
      return context.lattices;
    case ParameterType::Pose:
      return context.poses;
    case ParameterType::ModelOrLattice: {
      std::vector<std::string> all = context.lattices;
      all.insert(all.end(), context.models.begin(), context.models.end());
      return all;
    }
    default:
      return {};
  }
}

/// The one that the work is about, where a parameter needs a name of the scene; and what a new
/// lattice goes round.
std::string reference_text(const Parameter& parameter, const FormContext& context) {
  const std::string model = context.models.empty() ? "" : context.models.front();
  if (parameter.name == "fit") {
    return model;
  }
  if (!parameter.is_required) {
    return "";
  }
  const bool is_model =
      parameter.type == ParameterType::Model || parameter.name == "mesh" ||
      (parameter.type == ParameterType::ModelOrLattice && context.lattice.empty());
  return is_model && !model.empty()               ? model
         : parameter.type == ParameterType::Model ? ""
                                                  : context.lattice;
}

bool is_place_type(const Parameter& parameter) {
  return parameter.type == ParameterType::Numbers && parameter.count == 3;
}

/// To seven digits: more cannot be placed by hand.
std::string text_of_place(const glm::dvec3& place) {
  std::string text;
  for (int axis = 0; axis < 3; ++axis) {
    text += axis > 0 ? "," : "";
    append_number(text, static_cast<float>(place[axis]));
  }
  return text;
}

std::string first_text(const Operation& operation, const Parameter& parameter,
                       const FormContext& context) {
  if (is_reference(parameter.type)) {
    return reference_text(parameter, context);
  }
  if (parameter.type == ParameterType::Result) {
    const bool changes_lattice = std::any_of(
        operation.parameters.begin(), operation.parameters.end(), [](const Parameter& other) {
          return other.is_required && other.name != "mesh" &&
                 (other.type == ParameterType::Lattice ||
                  other.type == ParameterType::ModelOrLattice);
        });
    return changes_lattice && !context.lattice.empty() ? context.lattice
                                                       : new_name(operation, context);
  }
  constexpr std::array<const char*, 4> kCenters = {"about", "point", "center", "from"};
  const bool is_center =
      std::find(kCenters.begin(), kCenters.end(), parameter.name) != kCenters.end();
  if (context.cursor && is_center && is_place_type(parameter)) {
    return text_of_place(*context.cursor);
  }
  const std::string selected = selected_text(parameter.name, context);
  return !selected.empty()    ? selected
         : parameter.fallback ? text_of_value(operation, parameter, *parameter.fallback)
         : parameter.type == ParameterType::Flag ? "false"
                                                 : "";
}

std::string quoted_word(const std::string& text) {
  std::string word = "\"";
  for (const char c : text) {
    word += (c == '"' || c == '\\') ? std::string("\\") + c : std::string(1, c);
  }
  return word + '"';
}

/// Numbers may also stand apart by blanks.
std::string with_commas(const std::string& text) {
  std::istringstream words(text);
  std::string result;
  for (std::string word; words >> word;) {
    result += (result.empty() || result.back() == ',' || word.front() == ',' ? "" : ",") + word;
  }
  return result;
}

bool has_numbers(ParameterType type) {
  return type == ParameterType::Integer || type == ParameterType::Number ||
         type == ParameterType::Integers || type == ParameterType::Numbers;
}

}  // namespace

bool FormField::is_place() const {
  constexpr std::array<const char*, 7> kPlaces = {"about", "point", "center", "from",
                                                  "to",    "min",   "max"};
  return parameter->name == "joint" ||
         (is_place_type(*parameter) &&
          std::find(kPlaces.begin(), kPlaces.end(), parameter->name) != kPlaces.end());
}

void FormField::put(const glm::dvec3& place) {
  const bool adds = parameter->is_list && !text.empty();
  text = (adds ? text + (text.ends_with('\n') ? "" : "\n") : "") + text_of_place(place);
}

OperationCall OperationForm::call() const {
  std::string line = operation->name;
  for (const FormField& field : fields) {
    std::istringstream lines(field.text);
    bool is_given = false;
    for (std::string text; std::getline(lines, text);) {
      text = has_numbers(field.parameter->type) ? with_commas(text) : text;
      if (!text.empty()) {
        line += " " + field.parameter->name + "=" + quoted_word(text);
        is_given = true;
      }
    }
    if (!is_given && field.parameter->is_required) {
      throw ParameterError("'" + field.parameter->name +
                           "' must be given: " + field.parameter->help);
    }
  }
  return parse_call(line);
}

OperationForm form_for(const Operation& operation, const FormContext& context) {
  OperationForm form{&operation, {}};
  for (const Parameter& parameter : operation.parameters) {
    form.fields.push_back(
        {&parameter, first_text(operation, parameter, context), choices_of(parameter, context)});
  }
  return form;
}

}  // namespace espalier::viewer
