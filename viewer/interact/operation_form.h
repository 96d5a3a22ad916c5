#pragma once

/// A form for any operation of the table: its parameters as text to fill in.

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "deform/scene/operation.h"
#include "deform/scene/operation_text.h"
#include "viewer/interact/lattice_elements.h"

namespace espalier::viewer {

/// What a form is filled in with to begin with.
struct FormContext {
  std::vector<std::string> models, lattices, poses;  ///< names in the scene
  std::string lattice;                               ///< the chosen one; "": none
  std::string folder;                                ///< where results are put
  ElementKind kind = ElementKind::Vertex;
  Selection selection{};  ///< of the chosen lattice's elements
  const LatticeElements* elements = nullptr;
  std::optional<glm::dvec3> cursor{};  ///< where joints and centres are, to begin with
};

/// One parameter.
struct FormField {
  const Parameter* parameter = nullptr;
  std::string text;                  ///< empty: left out; one line a value of a list
  std::vector<std::string> choices;  ///< to choose from; empty: anything may be typed

  /// Whether it is a place in space, or a list of such.
  [[nodiscard]] bool is_place() const;
  /// Takes a place, as the next one of a list.
  void put(const glm::dvec3& place);
};

/// A value.
struct OperationForm {
  const Operation* operation = nullptr;
  std::vector<FormField> fields;

  /// What the fields say. Throws ParameterError naming the first that cannot be read or is missing.
  [[nodiscard]] OperationCall call() const;
};

/// A form with fallbacks, the chosen lattice and what is selected filled in. The table must outlive
/// it. New lattices are named after the operation; others are changed in place.
[[nodiscard]] OperationForm form_for(const Operation& operation, const FormContext& context);

}  // namespace espalier::viewer
