#include "tools/command_line.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <deque>

#include "lattice/core/error.h"
#include "lattice/core/parallel.h"
#include "lattice/core/text_scanner.h"
#include "tools/progress_bar.h"

namespace espalier::tools {
namespace {

constexpr const char* kVersion = "espalier " ESPALIER_VERSION;

/// What CLI11 writes into while it parses one command: words, which are converted here, since
/// CLI11 reads 010 as eight and has messages of its own.
struct Parsed {
  const Command* command = nullptr;
  CLI::App* app = nullptr;
  std::vector<Parameter> parameters;           // the command's and those of every command
  std::deque<std::vector<std::string>> words;  // one for each parameter
};

std::vector<Parameter> parameters_of(const Command& command) {
  std::vector<Parameter> parameters = command.parameters;
  if (command.has_json_report) {
    parameters.push_back(
        {.name = "json", .type = ParameterType::Flag, .help = "report as JSON on standard output"});
  }
  parameters.push_back(
      {.name = "quiet", .type = ParameterType::Flag, .help = "no report, no progress bar"});
  parameters.push_back({.name = "threads",
                        .type = ParameterType::Integer,
                        .help = "threads to use, 1 to 1024 (default: all)"});
  return parameters;
}

std::string option_name(const Parameter& parameter) {
  if (parameter.is_positional) {
    return parameter.name;
  }
  return parameter.name == "output" ? "-o,--output" : "--" + parameter.name;
}

std::string type_name(const Parameter& parameter) {
  switch (parameter.type) {
    case ParameterType::Integer:
      return "N";
    case ParameterType::Number:
      return "X";
    case ParameterType::Integers:
      return "N N N";
    case ParameterType::Numbers:
      return parameter.count == 6 ? "X Y Z X Y Z" : "X Y Z";
    case ParameterType::Choice: {
      std::string words;
      for (const std::string& choice : parameter.choices) {
        words += (words.empty() ? "" : "|") + choice;
      }
      return words;
    }
    case ParameterType::Text:
      return "WORD";
    default:
      return "FILE";
  }
}

/// A dash and what begins no number: not "-", "-5" or "-.5,30".
bool looks_like_option(const std::string& word) {
  return word.size() > 1 && word[0] == '-' && word[1] != '.' && (word[1] < '0' || word[1] > '9');
}

/// Why a word cannot be a value of a parameter; empty if it can.
std::string objection(const Parameter& parameter, const std::string& word) {
  std::int64_t integer = 0;
  double number = 0;
  switch (parameter.type) {
    case ParameterType::Integer:
    case ParameterType::Integers:
      return parse_integer(word, integer) ? "" : espalier::quoted(word) + " is no whole number";
    case ParameterType::Number:
    case ParameterType::Numbers:
      return parse_number(word, number) ? "" : espalier::quoted(word) + " is no number";
    default:
      return looks_like_option(word) ? "needs a value before " + espalier::quoted(word) : "";
  }
}

std::string option_text(const Parameter& parameter) {
  return type_name(parameter) + (parameter.is_list ? " ..." : "") +
         (parameter.is_required ? " (required)" : "");
}

/// An option takes exactly its values at each occurrence: CLI11's lists would swallow what follows.
void add_option(CLI::App& app, const Parameter& parameter, std::vector<std::string>& words) {
  const std::string name = option_name(parameter);
  if (parameter.type == ParameterType::Flag) {
    app.add_flag(name, parameter.help)->disable_flag_override();
    return;
  }
  CLI::Option* option = app.add_option(name, words, parameter.help);
  option->option_text(option_text(parameter))->required(parameter.is_required);
  option->check([&parameter](const std::string& word) { return objection(parameter, word); });
  if (parameter.is_list && parameter.is_positional) {
    option->expected(1, CLI::detail::expected_max_vector_size)->allow_extra_args(true);
  } else if (parameter.is_list) {
    option->expected(-1)->allow_extra_args(false);  // one value an occurrence, any number of them
  } else {
    option->expected(1, static_cast<int>(parameter.count))->allow_extra_args(false);
  }
}

/// The commands by their words: "new box" becomes box under new.
CLI::App* add_command(CLI::App& program, const Command& command) {
  const std::size_t space = command.name.find(' ');
  if (space == std::string::npos) {
    return program.add_subcommand(command.name, command.summary)->group("Commands");
  }
  const std::string group_name = command.name.substr(0, space);
  const auto found =
      program.get_subcommands([&](const CLI::App* app) { return app->get_name() == group_name; });
  CLI::App* group = found.empty() ? nullptr : found.front();
  if (group == nullptr) {
    const bool is_pose = group_name == "pose";
    group = program.add_subcommand(group_name, is_pose ? "Pose a lattice: pose HOW"
                                                       : "Make a lattice: " + group_name + " KIND");
    group->group("Commands");
    group->require_subcommand(1);
  }
  return group->add_subcommand(command.name.substr(space + 1), command.summary)->group("Kinds");
}

Value value_of(const Parameter& parameter, const std::vector<std::string>& words) {
  std::vector<std::int64_t> integers(words.size());
  std::vector<double> numbers(words.size());
  for (std::size_t i = 0; i < words.size(); ++i) {
    static_cast<void>(parse_integer(words[i], integers[i]));
    static_cast<void>(parse_number(words[i], numbers[i]));
  }
  switch (parameter.type) {
    case ParameterType::Flag:
      return true;
    case ParameterType::Integer:
      return integers.front();
    case ParameterType::Integers:
      return integers;
    case ParameterType::Number:
      return numbers.front();
    case ParameterType::Numbers:
      return numbers;
    default:
      return parameter.is_list ? Value(words) : Value(words.front());
  }
}

Arguments arguments_of(const Parsed& parsed) {
  Arguments arguments;
  for (std::size_t i = 0; i < parsed.parameters.size(); ++i) {
    const Parameter& parameter = parsed.parameters[i];
    if (parsed.app->count(parameter.is_positional ? parameter.name : "--" + parameter.name) > 0) {
      arguments.set(parameter.name, value_of(parameter, parsed.words[i]));
    }
  }
  return arguments;
}

/// "-.5" would be read as an option: give it its zero.
std::string with_leading_zero(std::string word) {
  if (word.size() > 2 && word[0] == '-' && word[1] == '.' && word[2] >= '0' && word[2] <= '9') {
    word.insert(1, "0");
  }
  return word;
}

ExitStatus usage_error(const std::string& what, const std::string& command) {
  std::fprintf(stderr, "espalier: %s\nTry 'espalier %s--help'.\n", what.c_str(),
               command.empty() ? "" : (command + " ").c_str());
  return ExitStatus::WrongUsage;
}

/// "'cells' must be …" as "--cells must be …".
std::string with_option_name(std::string what, const std::vector<Parameter>& parameters) {
  for (const Parameter& parameter : parameters) {
    const std::string name = "'" + parameter.name + "'";
    if (!parameter.is_positional && what.starts_with(name)) {
      return what.replace(0, name.size(), "--" + parameter.name);
    }
  }
  return what;
}

/// Splits what every command has from what is the command's own.
ExitStatus run(const Parsed& parsed) {
  try {
    const Arguments all = checked(parsed.parameters, arguments_of(parsed));
    const int threads = all.has("threads") ? all.integer("threads") : 0;
    if (all.has("threads") && (threads < 1 || threads > 1024)) {
      throw ParameterError("'threads' must be 1 to 1024");
    }
    if (all.has("output") && all.text("output") == "-") {
      throw ParameterError(
          "'output' is '-', must be the name of a file; /dev/stdout is standard output for models");
    }
    set_thread_count(threads);
    const bool is_quiet = all.flag("quiet");
    const Session session{is_quiet, all.flag("json"), is_quiet ? Progress() : progress_bar()};
    Arguments own;
    for (const Parameter& parameter : parsed.command->parameters) {
      if (all.has(parameter.name)) {
        own.set(parameter.name, all.values().at(parameter.name));
      }
    }
    return parsed.command->run(own, session);
  } catch (const ParameterError& error) {
    return usage_error(with_option_name(error.what(), parsed.parameters), parsed.command->name);
  }
}

void build(CLI::App& program, std::deque<Parsed>& all) {
  program.require_subcommand(1);
  program.set_version_flag("--version", kVersion);
  program.get_formatter()->label("SUBCOMMAND", "COMMAND");
  for (const Command& command : commands()) {
    Parsed& parsed = all.emplace_back();
    parsed.command = &command;
    parsed.app = add_command(program, command);
    parsed.parameters = parameters_of(command);
    for (const Parameter& parameter : parsed.parameters) {
      add_option(*parsed.app, parameter, parsed.words.emplace_back());
    }
  }
}

/// The names of the commands below `app`: "box, cylinder".
std::string names_of_commands(const CLI::App& app) {
  std::string names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names += (names.empty() ? "" : ", ") + command->get_name();
  }
  return names;
}

/// What is wrong with words that CLI11 refused because of the number of an option's values.
std::string complaint(const CLI::ArgumentMismatch& error) {
  const std::string_view what = error.what();
  const std::string option(what.substr(0, what.find(':')));
  return option + (what.find("At Most") != std::string_view::npos ? " is given too often"
                                                                  : " needs a value");
}

/// What is wrong with words of which some have no place or others are missing: the former first.
std::string complaint(const CLI::App& program, const CLI::ParseError& error) {
  const CLI::App* app = &program;
  while (app->remaining().empty() && !app->get_subcommands().empty()) {
    app = app->get_subcommands().front();
  }
  const std::string names = names_of_commands(*app);
  const std::vector<std::string> unexpected = app->remaining();
  if (unexpected.empty()) {
    return names.empty() ? error.what() : "a command is missing, one of: " + names;
  }
  if (!app->get_subcommands().empty()) {
    return espalier::quoted(unexpected.front()) + " must come after the command";
  }
  if (looks_like_option(unexpected.front())) {
    return "there is no option " + espalier::quoted(unexpected.front());
  }
  return names.empty()
             ? espalier::quoted(unexpected.front()) + " is not expected"
             : "there is no command " + espalier::quoted(unexpected.front()) + ", only: " + names;
}

}  // namespace

ExitStatus run_command_line(const std::vector<std::string>& words) {
  CLI::App program("Bends 3D models by bending the space around them.", "espalier");
  std::deque<Parsed> all;
  build(program, all);
  std::vector<std::string> reversed;  // as CLI11 wants them
  for (auto word = words.rbegin(); word != words.rend(); ++word) {
    reversed.push_back(with_leading_zero(*word));
  }
  try {
    program.parse(std::move(reversed));
  } catch (const CLI::Success& success) {
    program.exit(success);
    return ExitStatus::Done;
  } catch (const CLI::ParseError& error) {
    std::string command;
    for (const CLI::App* app = &program; !app->get_subcommands().empty();) {
      app = app->get_subcommands().front();
      command += (command.empty() ? "" : " ") + app->get_name();
    }
    const auto* mismatch = dynamic_cast<const CLI::ArgumentMismatch*>(&error);
    const bool is_bad_value = dynamic_cast<const CLI::ValidationError*>(&error) != nullptr;
    return usage_error(mismatch != nullptr ? complaint(*mismatch)
                       : is_bad_value      ? error.what()
                                           : complaint(program, error),
                       command);
  }
  for (const Parsed& parsed : all) {
    if (parsed.app->parsed()) {
      return run(parsed);
    }
  }
  return usage_error("a command is missing", "");
}

}  // namespace espalier::tools
