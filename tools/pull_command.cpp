/// espalier pull: pose a lattice so that points of a model go where they are wanted.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "deform/direct/pull.h"
#include "deform/evaluate/weights.h"
#include "deform/injectivity/injectivity.h"
#include "deform/model/model_file.h"
#include "deform/scene/bind.h"
#include "deform/scene/indexed_vector.h"
#include "deform/scene/pose.h"
#include "lattice/core/error.h"
#include "lattice/core/text_scanner.h"
#include "lattice/io/lattice.h"
#include "tools/command.h"

namespace espalier::tools {
namespace {

using Json = nlohmann::ordered_json;

/// Picks that miss by more than this part of the lattice's diagonal are told about.
constexpr double kMiss = 1e-9;
/// A certified step is one without a fold below it: stay below.
constexpr double kShortOfFold = 1 - 1e-6;

/// What was picked, and how it went.
struct PullReport {
  std::vector<IndexedVector> picks;
  std::vector<glm::dvec3> residuals;  // target − place
  double step = 1;                    // part of the way that was gone
  bool has_misses = false;

  [[nodiscard]] std::string sentence() const {
    if (step < 1) {
      return fmt::format("stopped at {} of the way, where the lattice begins to fold", step);
    }
    return has_misses ? "the lattice is too coarse to take all picks to their targets: refine it, "
                        "unpin control points or give fewer picks"
                      : "";
  }
};

std::vector<double> mobilities_of(const Arguments& arguments, std::size_t n_controls) {
  std::vector<double> mobilities(n_controls, 1.0);
  for (const std::string& word : arguments.texts("pin")) {
    std::int64_t index = 0;
    if (!parse_integer(word, index) || index < 0 || static_cast<std::size_t>(index) >= n_controls) {
      throw ParameterError("'pin' is '" + word + "', must be the index of one of " +
                           std::to_string(n_controls) + " control points, from 0");
    }
    mobilities[static_cast<std::size_t>(index)] = 0;
  }
  return mobilities;
}

/// The picked points at rest. Throws ParameterError naming one that no patch holds.
Binding bind_picks(const Volume& volume, const Model& model,
                   const std::vector<IndexedVector>& picks, std::vector<glm::dvec3>& points) {
  for (const IndexedVector& pick : picks) {
    points.push_back(model.points()[pick.index]);
  }
  Binding binding = embed(volume, points);
  for (std::size_t i = 0; i < picks.size(); ++i) {
    if (std::find(binding.points.begin(), binding.points.end(), static_cast<std::int32_t>(i)) ==
        binding.points.end()) {
      throw ParameterError(
          fmt::format("'pick' names point {} at ({}, {}, {}), which lies outside "
                      "the lattice: no control point moves it",
                      picks[i].index, points[i].x, points[i].y, points[i].z));
    }
  }
  return binding;
}

/// Moves the pose so that the picks reach their targets, as far as they can.
PullReport pull(const Arguments& arguments, const Session& session, Lattice& lattice) {
  const Model model = read_model(arguments.text("model"));
  PullReport report;
  report.picks = parse_indexed_vectors("pick", arguments.texts("pick"), model.points().size(),
                                       "points of the model");
  const auto volume =
      std::make_shared<const Volume>(freeze(lattice, arguments.text("freeze"), session.progress));
  std::vector<glm::dvec3> points;
  const Binding binding = bind_picks(*volume, model, report.picks, points);
  const StencilTable weights = control_weights(*volume, binding);
  const Pull solver(weights, mobilities_of(arguments, volume->n_controls()));

  std::vector<glm::dvec3> pose = posed_controls(arguments.text("lattice"), lattice);
  std::vector<glm::dvec3> moves = pose;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    moves[i] -= volume->rest_controls()[i];
  }
  std::vector<glm::dvec3> wanted = weights.apply(moves);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    wanted[i] = report.picks[i].vector - (points[i] + wanted[i]);
  }
  const PullMotion pulled = solver.motion(wanted);
  if (arguments.flag("stop-at-fold")) {
    const SafeStep safe =
        InjectivityCheck(volume).largest_step(pose, pulled.motion, {.most_step = 1});
    report.step = safe.step < 1 ? safe.step * kShortOfFold : 1;
  }
  for (std::size_t i = 0; i < pose.size(); ++i) {
    pose[i] += report.step * pulled.motion[i];
  }
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const glm::dvec3 done = wanted[i] - pulled.residuals[i];
    report.residuals.push_back(wanted[i] - report.step * done);
    report.has_misses |= glm::length(pulled.residuals[i]) > kMiss * volume->diagonal();
  }
  lattice = lattice.with_pose(std::move(pose));
  return report;
}

std::string text_of(const std::string& path, const PullReport& report, bool is_json) {
  if (is_json) {
    Json json = {{"output", path}, {"step", report.step}, {"message", report.sentence()}};
    json["picks"] = Json::array();
    for (std::size_t i = 0; i < report.picks.size(); ++i) {
      const glm::dvec3& r = report.residuals[i];
      json["picks"].push_back({{"index", report.picks[i].index},
                               {"residual", {r.x, r.y, r.z}},
                               {"distance", glm::length(r)}});
    }
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  }
  std::string text = path + "\n";
  for (std::size_t i = 0; i < report.picks.size(); ++i) {
    text += fmt::format("  point {}: {:.3g} from its target\n", report.picks[i].index,
                        glm::length(report.residuals[i]));
  }
  const std::string sentence = report.sentence();
  return sentence.empty() ? text : text + "  " + sentence + "\n";
}

ExitStatus run(const Arguments& arguments, const Session& session) {
  const std::string& output = arguments.text("output");
  require_lattice_path(output);
  Lattice lattice = read_any_lattice(arguments.text("lattice"), session.progress);
  const PullReport report = pull(arguments, session, lattice);
  write_any_lattice(output, lattice);
  if (!session.is_quiet) {
    std::fputs(text_of(output, report, session.is_json).c_str(), stdout);
  }
  return ExitStatus::Done;
}

}  // namespace

Command pull_command() {
  return {"pull",
          "Pose a lattice so that points of a model go where they are wanted",
          {{.name = "lattice",
            .type = ParameterType::Path,
            .help = "the lattice, its pose the start (.json, .ovm)",
            .is_required = true,
            .is_positional = true},
           {.name = "model",
            .type = ParameterType::Path,
            .help = "the model at rest (.obj)",
            .is_required = true},
           {.name = "pick",
            .type = ParameterType::Text,
            .help = "INDEX=x,y,z, a point of the model and where it is to go; may repeat: control "
                    "points move as little as they can, and share out what they cannot do",
            .is_required = true,
            .is_list = true},
           {.name = "pin",
            .type = ParameterType::Text,
            .help = "index of a control point that stays where it is; may repeat",
            .is_list = true},
           {.name = "stop-at-fold",
            .type = ParameterType::Flag,
            .help = "go only as far as is certified to fold nothing",
            .fallback = Value(false)},
           {.name = "freeze",
            .type = ParameterType::Text,
            .help = "adaptive[:TOLERANCE], or uniform:N, the lattice refined N times (default "
                    "adaptive, 1e-5 of the lattice's diagonal)",
            .fallback = Value(std::string("adaptive"))},
           {.name = "output",
            .type = ParameterType::Path,
            .help = "the lattice with its new pose (.json, .ovm)",
            .is_required = true}},
          run};
}

}  // namespace espalier::tools
