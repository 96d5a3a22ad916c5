#include "deform/scene/pull.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <memory>
#include <utility>

#include "deform/scene/bind.h"
#include "deform/scene/operations.h"
#include "deform/scene/pose.h"
#include "deform/scene/pull_request.h"
#include "lattice/core/error.h"

namespace espalier {
namespace {

/// Control points that move so many times as far as picks bend space more than anybody wants.
constexpr double kFarGain = 10;

/// Told of a step that is not all of the way.
constexpr double kNearlyAll = 0.9999;

/// That of a bound model, or a new one.
std::shared_ptr<const Volume> volume_of(const Scene& scene, const Arguments& arguments,
                                        const Progress& progress) {
  const std::string& lattice = arguments.text("lattice");
  const std::string& freezing = arguments.text("freeze");
  for (const auto& [names, bound] : scene.bound) {
    if (names.second == lattice && bound.freeze == freezing) {
      return bound.volume;
    }
  }
  return std::make_shared<const Volume>(freeze(lattice_in(scene, lattice), freezing, progress));
}

PullReport report_of(const PullRequest& request, const PulledPose& pulled) {
  PullReport report;
  report.step = pulled.step;
  report.has_misses = pulled.has_misses;
  report.gain = pulled.gain;
  for (const RequestedGroup& group : request.groups) {
    report.groups.push_back({group.name});
  }
  for (std::size_t i = 0; i < pulled.points.size(); ++i) {
    const std::size_t source = pulled.points[i].number;
    if (source < request.picks.size()) {
      const RequestedPick& pick = request.picks[source];
      report.picks.push_back({pick.name, pick.index, pulled.points[i].is_image, pulled.places[i],
                              pulled.residuals[i]});
      continue;
    }
    std::size_t number = 0;
    while (source >= request.groups[number].end) {
      ++number;
    }
    PullReport::Group& group = report.groups[number];
    ++(pulled.is_held[i] != 0 ? group.n_points : group.n_outside);
    group.largest_residual = std::max(group.largest_residual, glm::length(pulled.residuals[i]));
  }
  return report;
}

void require_held(const PullReport& report) {
  for (const PullReport::Group& group : report.groups) {
    if (group.n_points == 0) {
      throw ParameterError(fmt::format("'{}': all its points lie outside the lattice", group.name));
    }
  }
}

}  // namespace

std::string PullReport::sentence() const {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
  if (step < 1) {
    add(fmt::format("stopped at {:.4g} of the way, where the lattice begins to fold",
                    std::min(step, kNearlyAll)));
  }
  if (has_misses) {
    add("the lattice is too coarse to take all picks to their targets: refine it, unpin control "
        "points or give fewer picks");
  }
  if (gain > kFarGain) {
    add(
        fmt::format("control points would move {:.0f} times as far as picks: a finer lattice, or a "
                    "smooth motion, keeps them closer",
                    gain));
  }
  return text;
}

PulledScene pull(const Scene& scene, const Arguments& arguments, const Progress& progress) {
  const std::string& name = arguments.text("lattice");
  const Lattice& lattice = lattice_in(scene, name);
  const Model& model = model_in(scene, arguments.text("model"));
  const std::size_t n_controls = lattice.rest_points().size();
  PullRequest request = pull_request(arguments, model, n_controls);
  static_cast<void>(posed_controls(name, lattice));  // refuses a pose that changes weights
  try {
    const PulledPose pulled = pulled_pose(lattice, volume_of(scene, arguments, progress),
                                          model.points(), std::move(request.task), progress);
    PullReport report = report_of(request, pulled);
    require_held(report);
    const auto posed = pulled.lattice.posed_points();
    report.n_added_control_points = posed.size() - n_controls;
    Scene result =
        report.n_added_control_points > 0 ? with_lattice(scene, name, pulled.lattice) : scene;
    return {with_pose(std::move(result), name, {posed.begin(), posed.end()}), std::move(report)};
  } catch (const LatticeError& error) {
    throw LatticeError(name + ": " + error.what());
  }
}

std::vector<Operation> pull_operations() {
  std::vector<Parameter> parameters = {{.name = "lattice",
                                        .type = ParameterType::Lattice,
                                        .help = "the lattice, its pose the start (.json, .ovm)",
                                        .is_required = true,
                                        .is_positional = true},
                                       {.name = "model",
                                        .type = ParameterType::Model,
                                        .help = "the model at rest (.obj, .off, .ply, .stl)",
                                        .is_required = true}};
  for (Parameter& parameter : pull_parameters()) {
    parameters.push_back(std::move(parameter));
  }
  return {{"pull", "Pose a lattice so that points of a model go where they are wanted",
           std::move(parameters),
           [](const Scene& scene, const Arguments& arguments, const Progress& progress) {
             return pull(scene, arguments, progress).scene;
           }}};
}

}  // namespace espalier
