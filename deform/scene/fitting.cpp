#include "deform/scene/fitting.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "deform/fit/held_points.h"
#include "deform/fit/limb_fit.h"
#include "deform/fit/point_extent.h"
#include "deform/model/point_selection.h"
#include "deform/scene/bind.h"
#include "deform/scene/lattice_parameters.h"
#include "lattice/build/checks.h"
#include "lattice/core/error.h"

namespace espalier {
namespace {

using Type = ParameterType;
using Points = std::vector<glm::dvec3>;

constexpr double kUsualPadding = 0.05;

double padding_of(const Arguments& arguments) {
  const double padding = arguments.has("padding") ? arguments.number("padding") : kUsualPadding;
  if (!(padding >= 0 && padding <= 100)) {
    throw ParameterError("'padding' is a fraction of the diagonal, from 0 to 100");
  }
  return padding;
}

FitOptions options_of(const Arguments& arguments, const FitKind& kind) {
  if (arguments.has("axes") && arguments.has("along")) {
    throw ParameterError("'along' and --axes exclude each other");
  }
  FitOptions options;
  options.is_principal =
      arguments.has("axes") ? arguments.text("axes") == "principal" : kind.is_principal;
  options.along = arguments.has("along") ? arguments.text("along")[0] - 'x' : -1;
  return options;
}

void require_no_places(const Arguments& arguments, const std::vector<std::string>& places) {
  for (const std::string& place : places) {
    if (arguments.has(place)) {
      throw ParameterError("'fit' and --" + place + " exclude each other");
    }
  }
}

/// Consecutive joints must differ for bones to have a direction.
void check_joints(const Points& joints) {
  if (joints.size() < 2) {
    throw ParameterError("limb: needs two joints or more");
  }
  for (const glm::dvec3& joint : joints) {
    check_point("limb", "a joint", joint);
  }
  for (std::size_t i = 0; i + 1 < joints.size(); ++i) {
    if (!(glm::distance(joints[i], joints[i + 1]) > 0)) {
      throw ParameterError("limb: joints " + std::to_string(i) + " and " + std::to_string(i + 1) +
                           " coincide");
    }
  }
}

/// The points that a limb along joints has to hold.
Points points_round(const Points& joints, const Scene& scene, const Arguments& arguments) {
  const Model& model = model_in(scene, arguments.text("fit"));
  if (arguments.has("only")) {
    Points chosen = points_to_fit(scene, arguments);
    const std::size_t n_beyond = count_beyond_ends(chosen, joints);
    if (n_beyond > 0) {
      throw ParameterError("'only' selects " + std::to_string(n_beyond) +
                           " points beyond the ends of the limb: move its first or last joint "
                           "outward, or select fewer");
    }
    return chosen;
  }
  Points points;
  for (const std::int32_t i : limb_points(model.points(), model.faces(), joints)) {
    points.push_back(model.points()[static_cast<std::size_t>(i)]);
  }
  return points;
}

bool holds(const Volume& volume, const Fitting& fitting, const Progress& progress) {
  return count_not_held(volume, fitting.points, fitting.clearance, progress) == 0;
}

}  // namespace

std::vector<Parameter> fit_parameters(const FitKind& kind) {
  std::vector<Parameter> parameters = {
      {.name = "fit", .type = Type::Model, .help = "a model to hold, instead of places and sizes"},
      {.name = "padding",
       .type = Type::Number,
       .help = "of --fit: room on all sides, of the points' diagonal (default 0.05)"},
      {.name = "only",
       .type = Type::Text,
       .help = "of --fit: only the points of this group or object, or @FILE: of these indices; may "
               "repeat (default: all points)",
       .is_list = true}};
  if (kind.has_axes) {
    parameters.push_back({.name = "axes",
                          .type = Type::Choice,
                          .help = std::string("of --fit: the coordinate axes or the points' own "
                                              "(default ") +
                                  (kind.is_principal ? "principal)" : "world)"),
                          .choices = {"world", "principal"}});
  }
  if (kind.has_along) {
    parameters.push_back({.name = "along",
                          .type = Type::Choice,
                          .help = "of --fit: the coordinate axis that is the lattice's, instead",
                          .choices = {"x", "y", "z"}});
  }
  return parameters;
}

std::vector<glm::dvec3> points_to_fit(const Scene& scene, const Arguments& arguments) {
  const Model& model = model_in(scene, arguments.text("fit"));
  const std::vector<std::string> only = arguments.texts("only");
  const std::vector<double> weights = point_weights(model, only, "");
  Points points;
  for (std::size_t i = 0; i < model.points().size(); ++i) {
    if (weights.empty() || weights[i] > 0) {
      points.push_back(model.points()[i]);
    }
  }
  return points;
}

FitRequest fit_request(const Scene& scene, const Arguments& arguments, const FitKind& kind) {
  require_no_places(arguments, kind.places);
  FitRequest request;
  request.options = options_of(arguments, kind);
  request.points = points_to_fit(scene, arguments);
  request.padding = padding_of(arguments) * extent_of(request.points);
  return request;
}

FitRequest limb_fit_request(const Scene& scene, const Arguments& arguments, const FitKind& kind,
                            const std::vector<glm::dvec3>& joints) {
  require_no_places(arguments, kind.places);
  check_joints(joints);
  FitRequest request;
  request.points = points_round(joints, scene, arguments);
  if (request.points.empty()) {
    throw ParameterError("'fit': no points of " + arguments.text("fit") +
                         " are round the limb, between its ends");
  }
  request.padding = padding_of(arguments) * extent_of(request.points);
  return request;
}

void require_no_fit_options(const Arguments& arguments) {
  for (const char* name : {"padding", "axes", "along", "only"}) {
    if (arguments.has(name)) {
      throw ParameterError("'" + std::string(name) + "' is for --fit");
    }
  }
}

Scene add_fitted_lattice(const Scene& scene, const Arguments& arguments, const Fitting& fitting,
                         const Progress& progress) {
  constexpr int kTries = 20;
  constexpr double kFirstStep = 0.1;     // of the margin
  constexpr double kLeastStep = 0.0025;  // of the points' extent
  double step = std::max(kFirstStep * fitting.margin, kLeastStep * extent_of(fitting.points));
  double margin = fitting.margin;
  for (int i = 0; i < kTries; ++i) {
    Scene result = add_lattice(scene, arguments, fitting.mesh(margin), progress);
    const Lattice& lattice = lattice_in(result, arguments.text("output"));
    // A coarser volume is soon made and tells most of what is too small.
    if (holds(freeze(lattice, "adaptive:1e-2", progress), fitting, progress) &&
        holds(freeze(lattice, "adaptive", progress), fitting, progress)) {
      return result;
    }
    margin += step;
    step *= 1.4;
  }
  throw ParameterError("'fit': no lattice of this kind and so many cells holds all the points");
}

}  // namespace espalier
