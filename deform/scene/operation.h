#pragma once

/// What an operation is: a name, typed parameters, and a function from scene to scene. Command
/// line, viewer and scripts all read the same table, operations().

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "deform/scene/scene.h"
#include "lattice/core/progress.h"

namespace espalier {

/// What a parameter holds.
enum class ParameterType {
  Flag,
  Integer,
  Number,
  Integers,  ///< `count` of them, or one or more if `count` is 0
  Numbers,   ///< the same
  Text,
  Choice,   ///< one of `choices`
  Path,     ///< of a file that is read or written
  Model,    ///< the name of a model in the scene; on the command line a file
  Lattice,  ///< the same of a lattice
  Pose,     ///< the same of a pose
  ModelOrLattice,
  Result  ///< the name the result gets in the scene; on the command line a file
};

using Value = std::variant<bool, std::int64_t, double, std::vector<std::int64_t>,
                           std::vector<double>, std::string, std::vector<std::string>>;

/// One parameter of an operation or a command.
struct Parameter {
  std::string name;
  ParameterType type = ParameterType::Text;
  std::string help;  ///< a phrase, with its unit and default
  bool is_required = false;
  bool is_positional = false;  ///< on the command line, without --name
  /// May occur more than once, if a text, a path or a name: its value is one text, or several.
  bool is_list = false;
  std::size_t count = 1;                  ///< of Integers and Numbers; 0: any number of them
  std::vector<std::string> choices = {};  ///< of a Choice
  std::optional<Value> fallback = {};     ///< the value when it is absent
};

/// The values of parameters by name.
class Arguments {
 public:
  Arguments() = default;
  explicit Arguments(std::map<std::string, Value> values) : values_(std::move(values)) {}

  void set(const std::string& name, Value value) {
    values_.insert_or_assign(name, std::move(value));
  }
  [[nodiscard]] bool has(const std::string& name) const { return values_.contains(name); }
  [[nodiscard]] const std::map<std::string, Value>& values() const { return values_; }

  /// The value of a type. Throw ParameterError if it is absent or of another type.
  [[nodiscard]] bool flag(const std::string& name) const;
  [[nodiscard]] int integer(const std::string& name) const;
  [[nodiscard]] double number(const std::string& name) const;
  [[nodiscard]] std::vector<std::int64_t> integers(const std::string& name) const;
  [[nodiscard]] std::vector<double> numbers(const std::string& name) const;
  [[nodiscard]] glm::dvec3 vector(const std::string& name) const;
  [[nodiscard]] const std::string& text(const std::string& name) const;
  /// Of a list: also those of a single text, and none if it is absent.
  [[nodiscard]] std::vector<std::string> texts(const std::string& name) const;

 private:
  std::map<std::string, Value> values_;
};

/// An entry of the table.
struct Operation {
  std::string name;     ///< one or two words, as typed: "new box"
  std::string summary;  ///< one line
  std::vector<Parameter> parameters;
  /// Gets checked arguments. Throws an Error and leaves the scene as it is if it cannot be done.
  std::function<Scene(const Scene&, const Arguments&, const Progress&)> run;
  bool changes_scene = true;  ///< false: it only writes files
};

/// The arguments with fallbacks filled in. Throws ParameterError naming a parameter that is
/// unknown, missing, of another type or size, not finite, or none of the choices.
[[nodiscard]] Arguments checked(const std::vector<Parameter>& parameters, Arguments arguments);

/// Runs an operation on a scene.
[[nodiscard]] Scene apply(const Operation& operation, const Scene& scene,
                          const Arguments& arguments, const Progress& progress = {});

}  // namespace espalier
