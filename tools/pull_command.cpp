/// espalier pull: pose a lattice so that points of a model go where they are wanted.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "deform/scene/operations.h"
#include "deform/scene/pull.h"
#include "tools/command.h"

namespace espalier::tools {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

Json to_json(const PullReport::Pick& pick) {
  Json json = Json::object();
  if (pick.index) {
    json["index"] = *pick.index;
  }
  json["place"] = to_json(pick.place);
  json["mirrored"] = pick.is_image;
  json["residual"] = to_json(pick.residual);
  json["distance"] = glm::length(pick.residual);
  return json;
}

std::string json_of(const std::string& path, const PullReport& report) {
  Json json = {{"output", path},
               {"step", report.step},
               {"gain", report.gain},
               {"added_control_points", report.n_added_control_points},
               {"message", report.sentence()}};
  json["picks"] = Json::array();
  for (const PullReport::Pick& pick : report.picks) {
    json["picks"].push_back(to_json(pick));
  }
  json["groups"] = Json::array();
  for (const PullReport::Group& group : report.groups) {
    json["groups"].push_back({{"name", group.name},
                              {"points", group.n_points},
                              {"outside", group.n_outside},
                              {"largest_distance", group.largest_residual}});
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string text_of(const std::string& path, const PullReport& report) {
  std::string text = path + "\n";
  for (const PullReport::Pick& pick : report.picks) {
    text += fmt::format("  {}{}: {:.3g} from its target\n", pick.is_image ? "mirror image of " : "",
                        pick.name, glm::length(pick.residual));
  }
  for (const PullReport::Group& group : report.groups) {
    text += fmt::format("  {}: {} points, at most {:.3g} from their targets", group.name,
                        group.n_points, group.largest_residual);
    text += group.n_outside > 0
                ? fmt::format("; {} more are outside the lattice\n", group.n_outside)
                : "\n";
  }
  if (report.n_added_control_points > 0) {
    text += fmt::format("  {} control points added\n", report.n_added_control_points);
  }
  const std::string sentence = report.sentence();
  return sentence.empty() ? text : text + "  " + sentence + "\n";
}

Scene opened(const Scene& scene, const std::string& path, const char* kind,
             const Progress& progress) {
  return apply(operation_named("open"), scene,
               Arguments({{"path", path}, {"kind", std::string(kind)}}), progress);
}

ExitStatus run(const Arguments& arguments, const Session& session) {
  const std::string& output = arguments.text("output");
  require_lattice_path(output);
  const std::string& lattice = arguments.text("lattice");
  Scene scene = opened({}, lattice, "lattice", session.progress);
  scene = opened(scene, arguments.text("model"), "model", session.progress);
  const PulledScene pulled = pull(scene, arguments, session.progress);
  write_any_lattice(output, lattice_in(pulled.scene, lattice));
  if (!session.is_quiet) {
    const std::string text =
        session.is_json ? json_of(output, pulled.report) : text_of(output, pulled.report);
    std::fputs(text.c_str(), stdout);
  }
  return ExitStatus::Done;
}

}  // namespace

Command pull_command() {
  const Operation& operation = operation_named("pull");
  std::vector<Parameter> parameters = operation.parameters;
  parameters.push_back({.name = "output",
                        .type = ParameterType::Path,
                        .help = "the lattice with its new pose (.json, .ovm)",
                        .is_required = true});
  return {operation.name, operation.summary, std::move(parameters), run};
}

}  // namespace espalier::tools
