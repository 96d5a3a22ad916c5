#include "deform/scene/pull_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string_view>
#include <utility>

#include "deform/model/point_selection.h"
#include "deform/scene/index_list.h"
#include "deform/scene/indexed_vector.h"
#include "deform/scene/lattice_parameters.h"
#include "lattice/core/box.h"
#include "lattice/core/error.h"
#include "lattice/core/text_scanner.h"

namespace espalier {
namespace {

using Type = ParameterType;

constexpr double kLeastStiffness = 1e-6;
constexpr double kMostStiffness = 1e6;
constexpr int kMostLevels = 8;
/// Told of a place that is so far from the surface, of the model's diagonal.
constexpr double kFar = 0.01;

/// "NAME=VALUE", split at the last '='; without one all is the name.
struct Assignment {
  std::string name;
  std::string value;

  explicit Assignment(const std::string& word) : name(word.substr(0, word.rfind('='))) {
    value = name.size() < word.size() ? word.substr(name.size() + 1) : "";
  }
};

PulledPoint pulled_point(std::size_t index, const char* option, Aim aim, const glm::dvec3& goal) {
  return {option, fmt::format("point {}", index), {{{index, 1.0}}}, aim, goal};
}

void add_picks(const Arguments& arguments, const Model& model, PullRequest& request) {
  for (const IndexedVector& pick : parse_indexed_vectors(
           "pick", arguments.texts("pick"), model.points().size(), "points of the model")) {
    request.task.points.push_back(pulled_point(pick.index, "pick", Aim::Place, pick.vector));
    request.picks.push_back({request.task.points.back().name, pick.index});
  }
}

void add_surface_picks(const Arguments& arguments, const Model& model, PullRequest& request) {
  const double far = kFar * 2 * box_of(model.points()).radius();
  for (const std::string& word : arguments.texts("pick-at")) {
    const Assignment parts(word);
    glm::dvec3 place(0);
    PulledPoint point;
    if (!parse_vector(parts.name, place) || !parse_vector(parts.value, point.goal)) {
      throw ParameterError("'pick-at' is '" + word +
                           "', must be x,y,z=tx,ty,tz with six finite numbers: a place on the "
                           "model's surface and its goal");
    }
    point.option = "pick-at";
    point.point = closest_surface_point(model, place);
    const glm::dvec3 found = place_of(point.point, model.points());
    point.name = fmt::format("the surface at ({:.6g}, {:.6g}, {:.6g})", found.x, found.y, found.z);
    request.picks.push_back({point.name});
    if (const double distance = glm::distance(found, place); distance > far) {
      request.picks.back().name += fmt::format(", {:.3g} from {}", distance, parts.name);
    }
    request.task.points.push_back(std::move(point));
  }
}

/// The points of indices such as 0,3,7-9, of a group, or of the indices in a file @FILE.
std::vector<std::size_t> points_named(const char* option, const std::string& name,
                                      const Model& model) {
  std::vector<double> weights(model.points().size(), 0.0);
  if (const auto list = parse_index_list(name)) {
    for (const std::int32_t index : *list) {
      const auto i = static_cast<std::size_t>(index);
      if (i >= weights.size()) {
        throw ParameterError(
            fmt::format("'{}' names point {} of {} points of the model, counted from 0", option, i,
                        weights.size()));
      }
      weights[i] = 1;
    }
  } else if (!name.empty() && name.find_first_not_of("0123456789,-") == std::string::npos) {
    throw ParameterError(
        fmt::format("'{}' is '{}', must be indices of the model's points, 0 to {}, such as "
                    "0,3,7-9, or a group or @FILE",
                    option, name, weights.size() - 1));
  } else if (!name.empty()) {
    weights = point_weights(model, std::vector<std::string>{name}, "");
  }
  std::vector<std::size_t> points;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] > 0) {
      points.push_back(i);
    }
  }
  if (points.empty()) {
    throw ParameterError(fmt::format("'{}' is '{}', which names no points", option, name));
  }
  return points;
}

void add_group(const char* option, const std::string& name, const Model& model, Aim aim,
               const glm::dvec3& goal, PullRequest& request) {
  RequestedGroup group{fmt::format("{} {}", option, name), request.task.points.size()};
  for (const std::size_t index : points_named(option, name, model)) {
    request.task.points.push_back(pulled_point(index, option, aim, goal));
    request.task.points.back().is_optional = true;
  }
  group.end = request.task.points.size();
  request.groups.push_back(std::move(group));
}

void add_magnets(const Arguments& arguments, const Model& model, PullRequest& request) {
  for (const std::string& word : arguments.texts("magnet")) {
    const Assignment parts(word);
    glm::dvec3 by(0);
    if (!parse_vector(parts.value, by)) {
      throw ParameterError("'magnet' is '" + word +
                           "', must be NAME=dx,dy,dz or INDICES=dx,dy,dz with three finite "
                           "numbers");
    }
    add_group("magnet", parts.name, model, Aim::Shift, by, request);
  }
}

void add_flattened(const Arguments& arguments, const Model& model, PullRequest& request) {
  if (arguments.has("flatten") != arguments.has("plane")) {
    throw ParameterError("'flatten' and --plane go together: what is flattened, and to what");
  }
  if (!arguments.has("plane")) {
    return;
  }
  if (arguments.has("symmetry")) {
    throw ParameterError("'symmetry' is for picks and magnets, not for --flatten");
  }
  const std::vector<double> plane = arguments.numbers("plane");
  const glm::dvec3 normal(plane[3], plane[4], plane[5]);
  const double length = glm::length(normal);
  if (!(length > 0 && length <= kLargestCoordinate)) {
    throw ParameterError(
        "'plane' has a normal that is zero or too long: must be x y z of a point "
        "and nx ny nz of a normal");
  }
  request.task.plane_point = {plane[0], plane[1], plane[2]};
  request.task.plane_normal = normal / length;
  for (const std::string& name : arguments.texts("flatten")) {
    add_group("flatten", name, model, Aim::Plane, glm::dvec3(0), request);
  }
}

void set_mobilities(const char* option, const std::string& word, const std::string& list,
                    double mobility, std::vector<double>& mobilities) {
  const auto indices = parse_index_list(list);
  const bool is_good = indices && static_cast<std::size_t>(*std::max_element(
                                      indices->begin(), indices->end())) < mobilities.size();
  if (!is_good) {
    throw ParameterError(
        fmt::format("'{}' is '{}', must be the index of one of {} control points, "
                    "from 0, or several such as 0,3,7-9",
                    option, word, mobilities.size()));
  }
  for (const std::int32_t index : *indices) {
    mobilities[static_cast<std::size_t>(index)] = mobility;
  }
}

std::vector<double> mobilities_of(const Arguments& arguments, std::size_t n_controls) {
  std::vector<double> mobilities(n_controls, 1.0);
  for (const std::string& word : arguments.texts("stiffness")) {
    const Assignment parts(word);
    double stiffness = 0;
    if (!parse_number(parts.value, stiffness) ||
        !(stiffness >= kLeastStiffness && stiffness <= kMostStiffness)) {
      throw ParameterError("'stiffness' is '" + word +
                           "', must be INDEX=s or 0,3,7-9=s with s from 1e-6 to 1e6");
    }
    set_mobilities("stiffness", word, parts.name, 1 / stiffness, mobilities);
  }
  for (const std::string& word : arguments.texts("pin")) {
    set_mobilities("pin", word, word, 0, mobilities);
  }
  return mobilities;
}

std::optional<SymmetryPlane> symmetry_of(const Arguments& arguments) {
  if (!arguments.has("symmetry")) {
    return std::nullopt;
  }
  const std::string& text = arguments.text("symmetry");
  const std::size_t axis =
      text.size() == 1 || text[1] == ':' ? std::string("xyz").find(text[0]) : std::string::npos;
  SymmetryPlane plane;
  if (axis == std::string::npos ||
      (text.size() > 1 && (!parse_number(std::string_view(text).substr(2), plane.offset) ||
                           !(std::abs(plane.offset) <= kLargestCoordinate)))) {
    throw ParameterError("'symmetry' is " + quoted(text) +
                         ", must be x, y or z, or with an offset such as x:0.5");
  }
  plane.axis = static_cast<int>(axis);
  return plane;
}

int refinements_of(const Arguments& arguments) {
  if (!arguments.flag("refine")) {
    if (arguments.has("levels")) {
      throw ParameterError("'levels' is for --refine");
    }
    return 0;
  }
  const int levels = arguments.has("levels") ? arguments.integer("levels") : kMostLevels;
  if (levels < 1 || levels >= kMostThbLevels) {
    throw ParameterError(fmt::format("'levels' must be 1 to {}", kMostThbLevels - 1));
  }
  return levels;
}

Parameter list_parameter(const char* name, const char* help) {
  return {.name = name, .type = Type::Text, .help = help, .is_list = true};
}

Parameter flag_parameter(const char* name, const char* help) {
  return {.name = name, .type = Type::Flag, .help = help, .fallback = Value(false)};
}

}  // namespace

std::vector<Parameter> pull_parameters() {
  return {
      list_parameter("pick",
                     "INDEX=x,y,z, a point of the model and where it is to go; may repeat: control "
                     "points move as little as they can, and share out what they cannot do"),
      list_parameter("pick-at",
                     "x,y,z=tx,ty,tz, the same for the point of the surface of the model at rest "
                     "that is closest to x,y,z; may repeat"),
      list_parameter("magnet",
                     "NAME=dx,dy,dz, the points of a group or object of the model, of indices such "
                     "as 0,3,7-9, or of @FILE, moved by one vector from where they are; may "
                     "repeat"),
      list_parameter("flatten",
                     "NAME, such points pressed against --plane: they go there along its normal, "
                     "and may slide; may repeat"),
      {.name = "plane",
       .type = Type::Numbers,
       .help = "x y z of a point and nx ny nz of the normal of the plane for --flatten",
       .count = 6},
      {.name = "symmetry",
       .type = Type::Text,
       .help = "x, y, z or such as x:0.5, the plane x = 0.5: every pick and magnet pulls its "
               "mirror image too"},
      list_parameter("pin",
                     "index of a control point that stays where it is, or several such as "
                     "0,3,7-9; may repeat"),
      list_parameter("stiffness",
                     "INDEX=s or 0,3,7-9=s, how much control points resist, from 1e-6 to 1e6 "
                     "(default 1); may repeat"),
      flag_parameter("smooth",
                     "move the lattice as evenly as it can, whole where nothing is pinned, instead "
                     "of as few control points as little as they can"),
      flag_parameter("stop-at-fold", "go only as far as is certified to fold nothing"),
      flag_parameter("refine",
                     "of a thb lattice: refine under picks that cannot be met, or only by throwing "
                     "control points away, until they are"),
      {.name = "levels", .type = Type::Integer, .help = "of --refine: at most (default 8)"},
      freeze_parameter(),
  };
}

PullRequest pull_request(const Arguments& arguments, const Model& model, std::size_t n_controls) {
  PullRequest request;
  add_picks(arguments, model, request);
  add_surface_picks(arguments, model, request);
  add_magnets(arguments, model, request);
  add_flattened(arguments, model, request);
  if (request.task.points.empty()) {
    throw ParameterError("'pick', --pick-at, --magnet or --flatten must be given");
  }
  for (std::size_t i = 0; i < request.task.points.size(); ++i) {
    request.task.points[i].number = i;
  }
  request.task.mobilities = mobilities_of(arguments, n_controls);
  request.task.symmetry = symmetry_of(arguments);
  request.task.is_smooth = arguments.flag("smooth");
  request.task.stops_at_fold = arguments.flag("stop-at-fold");
  request.task.most_refinements = refinements_of(arguments);
  return request;
}

}  // namespace espalier
