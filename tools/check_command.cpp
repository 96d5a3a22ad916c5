/// espalier check: whether a lattice is valid, whether its pose folds space or its boundary meets
/// itself, and how far a drag may go.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "deform/evaluate/displace.h"
#include "deform/injectivity/boundary.h"
#include "deform/injectivity/injectivity.h"
#include "deform/model/model_file.h"
#include "deform/model/volume_change.h"
#include "deform/scene/bind.h"
#include "deform/scene/indexed_vector.h"
#include "deform/scene/lattice_parameters.h"
#include "deform/scene/pose.h"
#include "lattice/core/error.h"
#include "lattice/io/lattice.h"
#include "lattice/topology/validate.h"
#include "tools/command.h"

namespace espalier::tools {
namespace {

using Json = nlohmann::ordered_json;

/// Steps that move a point farther than this many diagonals of the lattice count as unbounded.
constexpr double kFarthest = 1e6;

/// Pairs of faces that are listed.
constexpr std::size_t kMostShown = 100;
constexpr std::size_t kMostPlacesTold = 10;  // in the text; the JSON holds all

/// All that is found out.
struct CheckReport {
  std::vector<std::string> defects;
  LocalInjectivity local;
  Verdict elsewhere = Verdict::Certified;  // of patches that `local` does not look at
  BoundaryReport boundary;
  std::optional<SafeStep> step;  // of the drag
  bool is_bounded = true;
  bool has_model = false;
  std::optional<double> volume_change;  // of the model, in per cent; none if it is not closed
};

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::Certified:
      return "certified";
    case Verdict::Folded:
      return "folded";
    default:
      return "undecided";
  }
}

const char* name_of(BoundaryVerdict verdict) {
  switch (verdict) {
    case BoundaryVerdict::Simple:
      return "simple";
    case BoundaryVerdict::Intersecting:
      return "intersecting";
    default:
      return "undecided";
  }
}

/// Locally injective everywhere, and a boundary that does not meet itself.
Verdict injective_of(const CheckReport& report) {
  if (report.local.verdict == Verdict::Folded ||
      report.boundary.verdict == BoundaryVerdict::Intersecting) {
    return Verdict::Folded;
  }
  const bool is_certain =
      report.local.verdict == Verdict::Certified && report.elsewhere == Verdict::Certified &&
      report.boundary.verdict == BoundaryVerdict::Simple && report.boundary.is_unnested;
  return is_certain ? Verdict::Certified : Verdict::Undecided;
}

Json json_of(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

Json json_of(const BoundaryPlace& place) {
  return {{"patch", place.patch}, {"uvw", json_of(place.uvw)}, {"rest", json_of(place.rest)}};
}

void add_boundary(const BoundaryReport& report, Json& json) {
  json["boundary_faces"] = report.n_faces;
  json["crossings"] = Json::array();
  for (const BoundaryCrossing& crossing : report.crossings) {
    json["crossings"].push_back({{"point", json_of(crossing.point)},
                                 {"places", {json_of(crossing.a), json_of(crossing.b)}}});
  }
  json["undecided_pairs"] = report.undecided.size();
  json["undecided_faces"] = Json::array();
  const std::size_t n_shown = std::min(report.undecided.size(), kMostShown);
  for (const UndecidedFaces& pair : std::span(report.undecided).first(n_shown)) {
    json["undecided_faces"].push_back({{{"patch", pair.patches[0]}, {"face", pair.faces[0]}},
                                       {{"patch", pair.patches[1]}, {"face", pair.faces[1]}}});
  }
}

Json json_of(const CheckReport& report) {
  Json json = {{"valid", report.defects.empty()}, {"defects", report.defects}};
  if (!report.defects.empty()) {
    return json;
  }
  json["local"] = name_of(report.local.verdict);
  json["boundary"] = name_of(report.boundary.verdict);
  json["injective"] = name_of(injective_of(report));
  json["patches"] = report.local.n_patches;
  json["folds"] = Json::array();
  for (const Fold& fold : report.local.folds) {
    json["folds"].push_back({{"patch", fold.patch},
                             {"uvw", json_of(fold.uvw)},
                             {"rest", json_of(fold.rest)},
                             {"determinant", fold.determinant}});
  }
  json["undecided_boxes"] = Json::array();
  for (const UndecidedBox& box : report.local.undecided) {
    json["undecided_boxes"].push_back({{"patch", box.patch},
                                       {"low", json_of(box.box.low)},
                                       {"high", json_of(box.box.high)},
                                       {"rest", json_of(box.rest)}});
  }
  add_boundary(report.boundary, json);
  if (report.has_model) {
    json["volume_change"] = report.volume_change ? Json(*report.volume_change) : Json();
  }
  if (report.step) {
    json["largest_step"] = report.is_bounded ? Json(report.step->step) : Json();
    json["largest_step_is_tight"] = report.step->is_tight;
  }
  return json;
}

/// Each place once, though all patches that meet there fold, and not thousands of them.
std::string folds_text(std::span<const Fold> folds) {
  std::vector<glm::dvec3> told;
  std::string text;
  const auto is_near = [](const glm::dvec3& a, const glm::dvec3& b) {
    return glm::distance(a, b) <= 1e-9 * (glm::length(a) + glm::length(b));
  };
  for (std::size_t i = 0; i < folds.size(); ++i) {
    if (told.size() == kMostPlacesTold) {
      return text + fmt::format("  and in {} patches more\n", folds.size() - i);
    }
    const glm::dvec3& rest = folds[i].rest;
    if (std::none_of(told.begin(), told.end(), [&](const auto& p) { return is_near(p, rest); })) {
      told.push_back(rest);
      text += fmt::format("  folded at rest point ({}, {}, {}): determinant {}\n", rest.x, rest.y,
                          rest.z, folds[i].determinant);
    }
  }
  return text;
}

/// To six digits: a step that is less is as safe.
double rounded_down(double step) {
  if (!(step > 0)) {
    return step;
  }
  const double digits = std::pow(10.0, 5 - std::floor(std::log10(step)));
  return std::floor(step * digits) / digits;
}

std::string text_of(const std::string& path, const CheckReport& report) {
  if (!report.defects.empty()) {
    std::string text = fmt::format("{}: invalid\n", path);
    for (const std::string& defect : report.defects) {
      text += "  " + defect + "\n";
    }
    return text;
  }
  std::string text =
      fmt::format("{}: valid\n  local: {} ({} patch{})\n  boundary: {}\n  injective: {}\n", path,
                  name_of(report.local.verdict), report.local.n_patches,
                  report.local.n_patches == 1 ? "" : "es", name_of(report.boundary.verdict),
                  name_of(injective_of(report)));
  text += folds_text(report.local.folds);
  if (!report.local.undecided.empty()) {
    const glm::dvec3& first = report.local.undecided.front().rest;
    text += fmt::format("  undecided in {} boxes, the first at rest point ({}, {}, {})\n",
                        report.local.undecided.size(), first.x, first.y, first.z);
  }
  if (!report.boundary.crossings.empty()) {
    const BoundaryCrossing& first = report.boundary.crossings.front();
    text += fmt::format(
        "  the boundary crosses itself at ({}, {}, {}), the place of rest points ({}, {}, {}) and "
        "({}, {}, {})\n",
        first.point.x, first.point.y, first.point.z, first.a.rest.x, first.a.rest.y, first.a.rest.z,
        first.b.rest.x, first.b.rest.y, first.b.rest.z);
  }
  if (!report.boundary.undecided.empty()) {
    text += fmt::format("  undecided in {} pairs of boundary faces\n",
                        report.boundary.undecided.size());
  }
  if (report.has_model) {
    text += report.volume_change
                ? fmt::format("  volume of the model: {:+.2f} %\n", *report.volume_change)
                : "  volume of the model: none, it is not closed\n";
  }
  if (report.step) {
    text += report.is_bounded
                ? fmt::format("  largest step: {:.6g}\n", rounded_down(report.step->step))
                : "  largest step: unbounded\n";
  }
  return text;
}

/// The patches that hold a point of the model.
std::vector<std::int32_t> patches_of(const Binding& binding) {
  std::vector<std::int32_t> patches = binding.patches;
  patches.erase(std::unique(patches.begin(), patches.end()), patches.end());
  return patches;
}

void add_step(const InjectivityCheck& check, const PosedControls& pose,
              const std::vector<std::string>& words, CheckReport& report) {
  std::vector<glm::dvec3> motion(pose.points.size(), glm::dvec3(0));
  double largest = 0;
  for (const IndexedVector& drag :
       parse_indexed_vectors("drag", words, pose.points.size(), "control points")) {
    motion[drag.index] = drag.vector;
    largest = std::max(largest, glm::length(drag.vector));
  }
  if (largest == 0) {
    throw ParameterError("'drag' moves nothing: give a vector that is not zero");
  }
  if (report.local.verdict == Verdict::Folded) {
    report.step = SafeStep();  // no way is safe: the folds are listed
    return;
  }
  const double most = kFarthest * check.volume().diagonal() / largest;
  report.step = check.largest_step(pose, motion, {.most_step = most});
  report.is_bounded = report.step->step < most;
}

ExitStatus status_of(const CheckReport& report) {
  if (!report.defects.empty()) {
    return ExitStatus::Failed;
  }
  switch (injective_of(report)) {
    case Verdict::Certified:
      return ExitStatus::Done;
    case Verdict::Folded:
      return ExitStatus::Failed;
    default:
      return ExitStatus::Undecided;
  }
}

CheckReport check_lattice(const Arguments& arguments, const Session& session) {
  const std::string& path = arguments.text("lattice");
  CheckReport report;
  std::variant<RawLattice, Lattice> parts = read_lattice_parts(path);
  if (auto* raw = std::get_if<RawLattice>(&parts)) {
    for (const Defect& defect : validate(raw->polyhedra, raw->rest, session.progress)) {
      report.defects.push_back(defect.message);
    }
    if (!report.defects.empty()) {
      return report;
    }
    parts = Lattice(build_lattice(std::move(*raw), path, session.progress));
  }
  const auto& lattice = std::get<Lattice>(parts);
  const auto volume =
      std::make_shared<const Volume>(freeze(lattice, arguments.text("freeze"), session.progress));
  const InjectivityCheck check(volume);
  const ControlPose posed = own_pose(lattice);
  const std::vector<double> weights = point_weights(*volume, posed.weights);
  const PosedControls pose(posed.points, weights);
  if (arguments.has("model")) {
    const Model model = read_model(arguments.text("model"));
    const Binding binding = embed(*volume, model.points(), session.progress);
    report.local = check.local(pose, patches_of(binding));
    report.elsewhere = check.local(pose).verdict;
    report.has_model = true;
    report.volume_change =
        volume_change(model.points(),
                      displaced_points(*volume, binding, model.points(),
                                       volume->displacements(posed.points), weights),
                      model.faces());
  } else {
    report.local = check.local(pose);
  }
  report.boundary = check_boundary(*volume, posed.points, weights, {}, session.progress);
  if (arguments.has("drag")) {
    add_step(check, pose, arguments.texts("drag"), report);
  }
  return report;
}

ExitStatus run(const Arguments& arguments, const Session& session) {
  const CheckReport report = check_lattice(arguments, session);
  if (!session.is_quiet) {
    const std::string text =
        session.is_json ? json_of(report).dump(2, ' ', false, Json::error_handler_t::replace) + "\n"
                        : text_of(arguments.text("lattice"), report);
    std::fputs(text.c_str(), stdout);
  }
  return status_of(report);
}

}  // namespace

Command check_command() {
  return {"check",
          "Tell whether a lattice's pose folds space anywhere, and how far a drag may go",
          {{.name = "lattice",
            .type = ParameterType::Path,
            .help = "the lattice with its pose (.json, .ovm)",
            .is_required = true,
            .is_positional = true},
           {.name = "model",
            .type = ParameterType::Path,
            .help = "check only the patches that hold points of this model, and tell how much "
                    "the volume inside it changes (default: all patches)"},
           {.name = "drag",
            .type = ParameterType::Text,
            .help = "INDEX=dx,dy,dz, a control point and how it moves from the pose: tells the "
                    "largest t for which moving by t times that stays free of folds; may repeat, "
                    "then all move together",
            .is_list = true},
           freeze_parameter()},
          run};
}

}  // namespace espalier::tools
