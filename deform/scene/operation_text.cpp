#include "deform/scene/operation_text.h"

#include <algorithm>
#include <utility>

#include "deform/scene/index_list.h"
#include "deform/scene/operations.h"
#include "lattice/core/error.h"
#include "lattice/core/text_scanner.h"
#include "lattice/io/number_text.h"

namespace espalier {
namespace {

bool needs_quotes(const std::string& text) {
  return text.empty() || text.find_first_of(" \t\n\r\"\\=#") != std::string::npos;
}

std::string word_of(const std::string& text) {
  if (!needs_quotes(text)) {
    return text;
  }
  std::string word = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      word += '\\';
    }
    word += c == '\n' ? "\\n" : std::string(1, c);
  }
  return word + '"';
}

template <class Number>
std::string list_of(const std::vector<Number>& numbers) {
  std::string list;
  for (const Number number : numbers) {
    list += list.empty() ? "" : ",";
    append_number(list, number);
  }
  return list;
}

/// " name=value", several times for a list of texts.
std::string argument_text(const std::string& name, const Value& value) {
  const std::string key = " " + name + "=";
  if (const auto* flag = std::get_if<bool>(&value)) {
    return key + (*flag ? "true" : "false");
  }
  if (const auto* integer = std::get_if<std::int64_t>(&value)) {
    return key + std::to_string(*integer);
  }
  if (const auto* number = std::get_if<double>(&value)) {
    return key + list_of(std::vector<double>{*number});
  }
  if (const auto* integers = std::get_if<std::vector<std::int64_t>>(&value)) {
    return key + list_of(*integers);
  }
  if (const auto* numbers = std::get_if<std::vector<double>>(&value)) {
    return key + list_of(*numbers);
  }
  if (const auto* text = std::get_if<std::string>(&value)) {
    return key + word_of(*text);
  }
  std::string all;
  for (const std::string& text : std::get<std::vector<std::string>>(value)) {
    all += key + word_of(text);
  }
  return all;
}

/// The next word of a line, unquoted; moves `line` past it.
std::string take_word(std::string_view& line) {
  std::string word;
  bool is_quoted = false;
  std::size_t i = 0;
  for (; i < line.size() && (is_quoted || (line[i] != ' ' && line[i] != '\t')); ++i) {
    if (line[i] == '"') {
      is_quoted = !is_quoted;
    } else if (is_quoted && line[i] == '\\' && i + 1 < line.size()) {
      ++i;
      word += line[i] == 'n' ? '\n' : line[i];
    } else {
      word += line[i];
    }
  }
  if (is_quoted) {
    throw ParameterError("a quoted text does not end: " + quoted(line));
  }
  line.remove_prefix(i);
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  return word;
}

template <class Number, class Parse>
std::vector<Number> parse_list(const std::string& name, const std::string& text,
                               const Parse& parse) {
  std::vector<Number> numbers;
  for (const std::string& word : words_between(text, ',')) {
    Number number{};
    if (!parse(word, number)) {
      throw ParameterError("'" + name + "' has " + quoted(word) +
                           ", which is no number of its kind");
    }
    numbers.push_back(number);
  }
  return numbers;
}

Value parse_value(const Parameter& parameter, const std::string& text) {
  const auto integers = [&] {
    return parse_list<std::int64_t>(parameter.name, text, parse_integer);
  };
  const auto numbers = [&] { return parse_list<double>(parameter.name, text, parse_number); };
  const auto single = [&](const auto& list) {
    if (list.size() != 1) {
      throw ParameterError("'" + parameter.name + "' must be one number");
    }
    return list.front();
  };
  switch (parameter.type) {
    case ParameterType::Flag:
      if (text != "true" && text != "false") {
        throw ParameterError("'" + parameter.name + "' must be true or false");
      }
      return text == "true";
    case ParameterType::Integer:
      return single(integers());
    case ParameterType::Number:
      return single(numbers());
    case ParameterType::Integers:
      return integers();
    case ParameterType::Numbers:
      return numbers();
    default:
      return text;
  }
}

const Parameter& parameter_named(const Operation& operation, const std::string& name) {
  for (const Parameter& parameter : operation.parameters) {
    if (parameter.name == name) {
      return parameter;
    }
  }
  throw ParameterError("'" + operation.name + "' has no parameter '" + name + "'");
}

/// Sets an argument, or adds one more to a list.
void add_argument(const Parameter& parameter, const std::string& text, Arguments& arguments) {
  if (!arguments.has(parameter.name)) {
    arguments.set(parameter.name, parse_value(parameter, text));
    return;
  }
  if (!parameter.is_list) {
    throw ParameterError("'" + parameter.name + "' is given twice");
  }
  std::vector<std::string> texts = arguments.texts(parameter.name);
  texts.push_back(text);
  arguments.set(parameter.name, std::move(texts));
}

}  // namespace

std::string text_of(const OperationCall& call) {
  const Operation& operation = operation_named(call.operation);
  std::string line = call.operation;
  for (const auto& [name, value] : call.arguments.values()) {
    static_cast<void>(parameter_named(operation, name));
  }
  for (const Parameter& parameter : operation.parameters) {
    if (call.arguments.has(parameter.name)) {
      line += argument_text(parameter.name, call.arguments.values().at(parameter.name));
    }
  }
  return line;
}

OperationCall parse_call(std::string_view line) {
  OperationCall call;
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  while (!line.empty() && line.substr(0, line.find_first_of(" \t")).find('=') == line.npos) {
    call.operation += (call.operation.empty() ? "" : " ") + take_word(line);
  }
  const Operation& operation = operation_named(call.operation);
  while (!line.empty()) {
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) {
      throw ParameterError("expected NAME=VALUE, not " + quoted(line));
    }
    const std::string name(line.substr(0, equals));
    line.remove_prefix(equals + 1);
    add_argument(parameter_named(operation, name), take_word(line), call.arguments);
  }
  return call;
}

Scene apply(const OperationCall& call, const Scene& scene, const Progress& progress) {
  return apply(operation_named(call.operation), scene, call.arguments, progress);
}

}  // namespace espalier
