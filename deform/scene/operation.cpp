#include "deform/scene/operation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lattice/core/error.h"

namespace espalier {
namespace {

template <class T>
const T& get(const std::map<std::string, Value>& values, const std::string& name) {
  const auto found = values.find(name);
  if (found == values.end()) {
    throw ParameterError("'" + name + "' is missing");
  }
  const T* value = std::get_if<T>(&found->second);
  if (value == nullptr) {
    throw ParameterError("'" + name + "' has a value of another type");
  }
  return *value;
}

std::string counted(const Parameter& parameter) {
  return parameter.count == 0 ? "one or more " : std::to_string(parameter.count) + " ";
}

bool is_right_count(const Parameter& parameter, std::size_t n) {
  return parameter.count == 0 ? n > 0 : n == parameter.count;
}

/// What a parameter's value must be.
std::string expectation(const Parameter& parameter) {
  switch (parameter.type) {
    case ParameterType::Flag:
      return "true or false";
    case ParameterType::Integer:
      return "a whole number";
    case ParameterType::Number:
      return "a finite number";
    case ParameterType::Integers:
      return counted(parameter) + "whole numbers";
    case ParameterType::Numbers:
      return counted(parameter) + "finite numbers";
    case ParameterType::Choice: {
      std::string words;
      for (const std::string& choice : parameter.choices) {
        words += (words.empty() ? "" : ", ") + choice;
      }
      return "one of: " + words;
    }
    default:
      return parameter.is_list ? "one or more texts that are not empty"
                               : "a text that is not empty";
  }
}

bool is_finite(double x) {
  return std::isfinite(x);
}

bool fits(const Parameter& parameter, const Value& value) {
  switch (parameter.type) {
    case ParameterType::Flag:
      return std::holds_alternative<bool>(value);
    case ParameterType::Integer: {
      const auto* integer = std::get_if<std::int64_t>(&value);
      return integer != nullptr && std::in_range<int>(*integer);
    }
    case ParameterType::Number: {
      const auto* number = std::get_if<double>(&value);
      return number != nullptr && is_finite(*number);
    }
    case ParameterType::Integers: {
      const auto* integers = std::get_if<std::vector<std::int64_t>>(&value);
      return integers != nullptr && is_right_count(parameter, integers->size());
    }
    case ParameterType::Numbers: {
      const auto* numbers = std::get_if<std::vector<double>>(&value);
      return numbers != nullptr && is_right_count(parameter, numbers->size()) &&
             std::all_of(numbers->begin(), numbers->end(), is_finite);
    }
    case ParameterType::Choice: {
      const auto* word = std::get_if<std::string>(&value);
      return word != nullptr && std::find(parameter.choices.begin(), parameter.choices.end(),
                                          *word) != parameter.choices.end();
    }
    default: {
      const auto* texts = std::get_if<std::vector<std::string>>(&value);
      if (texts != nullptr) {
        return parameter.is_list && !texts->empty() &&
               std::none_of(texts->begin(), texts->end(),
                            [](const std::string& text) { return text.empty(); });
      }
      const auto* text = std::get_if<std::string>(&value);
      return text != nullptr && !text->empty();
    }
  }
}

}  // namespace

bool Arguments::flag(const std::string& name) const {
  const auto found = values_.find(name);
  return found != values_.end() && get<bool>(values_, name);
}

int Arguments::integer(const std::string& name) const {
  constexpr std::int64_t kLargest = std::numeric_limits<int>::max();
  return static_cast<int>(std::clamp(get<std::int64_t>(values_, name), -kLargest, kLargest));
}

double Arguments::number(const std::string& name) const {
  return get<double>(values_, name);
}

std::vector<std::int64_t> Arguments::integers(const std::string& name) const {
  return get<std::vector<std::int64_t>>(values_, name);
}

std::vector<double> Arguments::numbers(const std::string& name) const {
  return get<std::vector<double>>(values_, name);
}

glm::dvec3 Arguments::vector(const std::string& name) const {
  const std::vector<double> xyz = numbers(name);
  if (xyz.size() != 3) {
    throw ParameterError("'" + name + "' needs three numbers");
  }
  return {xyz[0], xyz[1], xyz[2]};
}

const std::string& Arguments::text(const std::string& name) const {
  return get<std::string>(values_, name);
}

std::vector<std::string> Arguments::texts(const std::string& name) const {
  const auto found = values_.find(name);
  if (found == values_.end()) {
    return {};
  }
  if (const auto* text = std::get_if<std::string>(&found->second)) {
    return {*text};
  }
  return get<std::vector<std::string>>(values_, name);
}

Arguments checked(const std::vector<Parameter>& parameters, Arguments arguments) {
  for (const auto& [name, value] : arguments.values()) {
    const bool is_known = std::any_of(parameters.begin(), parameters.end(),
                                      [&](const Parameter& p) { return p.name == name; });
    if (!is_known) {
      throw ParameterError("there is no parameter '" + name + "'");
    }
  }
  for (const Parameter& parameter : parameters) {
    if (!arguments.has(parameter.name)) {
      if (parameter.fallback) {
        arguments.set(parameter.name, *parameter.fallback);
      } else if (parameter.is_required) {
        throw ParameterError("'" + parameter.name + "' is missing: " + parameter.help);
      }
      continue;
    }
    if (!fits(parameter, arguments.values().at(parameter.name))) {
      throw ParameterError("'" + parameter.name + "' must be " + expectation(parameter));
    }
  }
  return arguments;
}

Scene apply(const Operation& operation, const Scene& scene, const Arguments& arguments,
            const Progress& progress) {
  return operation.run(scene, checked(operation.parameters, arguments), progress);
}

}  // namespace espalier
