/// An operation as a command: open the files it names, apply it, save its result, report.

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <map>
#include <utility>

#include "deform/model/model_file.h"
#include "deform/scene/operations.h"
#include "lattice/core/error.h"
#include "lattice/io/lattice_file.h"
#include "lattice/io/vtu_writer.h"
#include "tools/command.h"
#include "tools/pose_series.h"
#include "tools/report.h"

namespace espalier::tools {
namespace {

/// The kind to open a parameter's file as; empty for values that are no input files.
std::string kind_of(const Parameter& parameter, const std::string& path) {
  switch (parameter.type) {
    case ParameterType::Model:
      return "model";
    case ParameterType::Lattice:
      return "lattice";
    case ParameterType::Pose:
      return "pose";
    case ParameterType::ModelOrLattice:
      return is_lattice_path(path) ? "lattice" : "model";
    default:
      return "";
  }
}

Scene open_inputs(const Operation& operation, const Arguments& arguments,
                  const Progress& progress) {
  Scene scene;
  for (const Parameter& parameter : operation.parameters) {
    if (kind_of(parameter, "").empty()) {
      continue;
    }
    for (const std::string& path : arguments.texts(parameter.name)) {
      scene = apply(operation_named("open"), scene,
                    Arguments({{"path", path}, {"kind", kind_of(parameter, path)}}), progress);
    }
  }
  return scene;
}

/// Throws FileError unless a lattice can be saved to a file of this name.
void check_lattice_output(const std::string& path) {
  if (!is_vtu_path(path)) {
    require_lattice_path(path);
  }
}

/// Refuses an output file of a wrong kind before the work is done.
void check_output(const Scene& inputs, const std::string& path) {
  if (!inputs.models.empty()) {
    require_same_format(path, inputs.models.begin()->second);
  } else {
    check_lattice_output(path);
  }
}

/// A refined model is a new one of points and faces, whatever it was made from.
void require_obj_path(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (!extension.empty() && extension != ".obj" && extension != ".OBJ") {
    throw FileError(path, "a refined model is written as .obj; name the output *.obj");
  }
}

/// Whether the operation makes a lattice: `convert` and `new` do, of whatever they are given; the
/// others keep the kind of what is named first.
bool makes_lattice(const Operation& operation, const Arguments& arguments, const Scene& inputs) {
  if (operation.name == "convert" || operation.name.starts_with("new ")) {
    return true;
  }
  for (const Parameter& parameter : operation.parameters) {
    if (parameter.is_positional && arguments.has(parameter.name)) {
      return inputs.lattices.contains(arguments.texts(parameter.name).front());
    }
  }
  return inputs.models.empty();
}

/// The output's path; the result may replace its own source, so never the name of an input.
std::string result_name(const Scene& inputs, const std::string& path) {
  const bool is_input =
      inputs.models.contains(path) || inputs.lattices.contains(path) || inputs.poses.contains(path);
  return is_input ? "new " + path : path;
}

/// What a command that converts tells `save` besides what to save and where.
std::vector<Parameter> save_options(const Operation& operation) {
  if (operation.name != "convert") {
    return {};
  }
  std::vector<Parameter> options = operation_named("save").parameters;
  std::erase_if(options, [](const Parameter& p) { return p.name == "name" || p.name == "path"; });
  return options;
}

Arguments without(const Arguments& arguments, const std::vector<std::string>& names) {
  std::map<std::string, Value> values = arguments.values();
  for (const std::string& name : names) {
    values.erase(name);
  }
  return Arguments(std::move(values));
}

/// One pose of a series: `scene` keeps what the model is bound with. The result's report.
std::string run_pose(const Operation& operation, Arguments arguments, const PoseJob& job,
                     const Session& session, Scene& scene) {
  static const std::string kResult = "result of a pose";
  arguments.set("pose", std::vector<std::string>{job.pose});
  arguments.set("output", kResult);
  Scene posed = apply(operation_named("open"), scene,
                      Arguments({{"path", job.pose}, {"kind", std::string("pose")}}));
  posed = apply(operation, posed, arguments, session.progress);
  scene.bound = posed.bound;
  const std::string& model = arguments.text("model");
  scene.models.insert_or_assign(model, posed.models.at(model));  // it may have been made denser
  posed =
      apply(operation_named("save"), posed, Arguments({{"name", kResult}, {"path", job.output}}));
  return result_report(posed, kResult, job.output, session.is_json);
}

/// The model and its lattice are read and bound once. A pose that fails is told on standard error;
/// the others are done all the same.
ExitStatus run_poses(const Operation& operation, const Arguments& arguments,
                     const Session& session) {
  const std::vector<PoseJob> jobs =
      pose_jobs(arguments.texts("pose").front(), arguments.text("output"));
  Scene scene = open_inputs(operation, without(arguments, {"pose"}), session.progress);
  for (const PoseJob& job : jobs) {
    check_output(scene, job.output);
  }
  std::vector<std::string> reports;
  for (const PoseJob& job : jobs) {
    try {
      reports.push_back(run_pose(operation, arguments, job, session, scene));
    } catch (const ParameterError&) {
      throw;  // not this pose's fault
    } catch (const Error& error) {
      std::fprintf(stderr, "espalier: %s\n", error.what());
    }
  }
  if (!session.is_quiet) {
    std::fputs(series_report(reports, session.is_json).c_str(), stdout);
  }
  return reports.size() == jobs.size() ? ExitStatus::Done : ExitStatus::Failed;
}

/// `bind` writes its result itself; it must not replace what it was made from.
ExitStatus run_bind(const Operation& operation, const Arguments& arguments,
                    const Session& session) {
  const std::string& output = arguments.text("output");
  if (is_lattice_path(output) || output == arguments.text("model")) {
    throw ParameterError("'output' is " + output + ", must be a file of its own");
  }
  const Scene scene = apply(operation, open_inputs(operation, arguments, session.progress),
                            arguments, session.progress);
  if (!session.is_quiet) {
    std::fputs(binding_report(scene, output, session.is_json).c_str(), stdout);
  }
  return ExitStatus::Done;
}

ExitStatus run(const Operation& operation, const Arguments& arguments, const Session& session) {
  Arguments saving;
  std::vector<std::string> saving_names;
  for (const Parameter& option : save_options(operation)) {
    saving_names.push_back(option.name);
    if (arguments.has(option.name)) {
      saving.set(option.name, arguments.values().at(option.name));
    }
  }
  const Arguments complete = checked(operation.parameters, without(arguments, saving_names));
  if (operation.name == "bind") {
    return run_bind(operation, complete, session);
  }
  const std::string& output = complete.text("output");
  const std::vector<std::string> poses = complete.texts("pose");
  if (operation.name == "deform" && poses.size() == 1 && is_pose_series(poses.front(), output)) {
    return run_poses(operation, complete, session);
  }
  Scene scene = open_inputs(operation, complete, session.progress);
  if (makes_lattice(operation, complete, scene)) {
    check_lattice_output(output);
  } else if (operation.name == "refine") {
    require_obj_path(output);
  } else {
    check_output(scene, output);
  }
  const std::string result = result_name(scene, output);
  Arguments named = complete;
  named.set("output", result);
  scene = apply(operation, scene, named, session.progress);
  saving.set("name", result);
  saving.set("path", output);
  scene = apply(operation_named("save"), scene, saving, session.progress);
  if (!session.is_quiet && output != "/dev/stdout") {
    std::fputs(result_report(scene, result, output, session.is_json).c_str(), stdout);
  }
  return ExitStatus::Done;
}

}  // namespace

Command operation_command(const Operation& operation) {
  std::vector<Parameter> parameters = operation.parameters;
  for (Parameter& parameter : parameters) {
    parameter.is_required = parameter.is_required || parameter.name == "output";
  }
  for (Parameter& option : save_options(operation)) {
    parameters.push_back(std::move(option));
  }
  return {operation.name, operation.summary, std::move(parameters),
          [&operation](const Arguments& arguments, const Session& session) {
            return run(operation, arguments, session);
          }};
}

}  // namespace espalier::tools
