/// Operations on a lattice's points, and what they do to models.

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "deform/injectivity/injectivity.h"
#include "deform/model/point_selection.h"
#include "deform/scene/lock.h"
#include "deform/scene/operations.h"
#include "lattice/core/error.h"
#include "lattice/topology/defect.h"
#include "lattice/topology/validate.h"

namespace espalier {
namespace {

using Type = ParameterType;

/// Where the listed points go: #indices.
std::vector<glm::dvec3> targets(const Arguments& arguments, std::span<const glm::dvec3> points,
                                std::span<const std::int64_t> indices) {
  if (arguments.has("to") == arguments.has("by")) {
    throw ParameterError("needs 'to', positions, or 'by', a vector: one of them");
  }
  std::vector<glm::dvec3> result;
  if (arguments.has("by")) {
    const glm::dvec3 by = arguments.vector("by");
    for (const std::int64_t i : indices) {
      result.push_back(points[static_cast<std::size_t>(i)] + by);
    }
    return result;
  }
  const std::vector<double> xyz = arguments.numbers("to");
  if (xyz.size() != 3 * indices.size()) {
    throw ParameterError("'to' has " + std::to_string(xyz.size()) +
                         " numbers, must have three for "
                         "each of " +
                         std::to_string(indices.size()) + " points");
  }
  for (std::size_t i = 0; i < xyz.size(); i += 3) {
    result.emplace_back(xyz[i], xyz[i + 1], xyz[i + 2]);
  }
  return result;
}

/// The points with those that the arguments name moved.
std::vector<glm::dvec3> moved_points(const Arguments& arguments,
                                     std::span<const glm::dvec3> points) {
  const std::vector<std::int64_t> indices = arguments.integers("points");
  for (const std::int64_t i : indices) {
    if (i < 0 || static_cast<std::size_t>(i) >= points.size()) {
      throw ParameterError("'points' has " + std::to_string(i) + ", must be from 0 to " +
                           std::to_string(points.size() - 1));
    }
  }
  const std::vector<glm::dvec3> to = targets(arguments, points, indices);
  std::vector<glm::dvec3> moved(points.begin(), points.end());
  for (std::size_t i = 0; i < indices.size(); ++i) {
    moved[static_cast<std::size_t>(indices[i])] = to[i];
  }
  return moved;
}

/// A grid that goes on being one; what it does at rest is not affine any more.
template <class GridLattice>
Scene with_rest(const Scene& scene, const std::string& name, GridLattice lattice,
                const Arguments& arguments) {
  lattice.rest = moved_points(arguments, lattice.rest);
  require_valid(lattice);
  const auto volume = std::make_shared<const Volume>(freeze(lattice));
  const auto differs = [&](double weight) { return weight != volume->weights()[0]; };
  if (std::none_of(volume->weights().begin(), volume->weights().end(), differs)) {
    static_cast<void>(InjectivityCheck(volume));  // throws where a patch is turned inside out
  }
  return with_lattice(scene, name, std::move(lattice));
}

/// A lattice at rest that moves must be a valid one where it goes; a pose may fold.
Scene move_points(const Scene& scene, const Arguments& arguments, const Progress& progress) {
  const std::string& name = arguments.text("lattice");
  if (arguments.text("shape") == "pose") {
    return with_pose(scene, name, moved_points(arguments, lattice_in(scene, name).posed_points()));
  }
  const Lattice& lattice = lattice_in(scene, name);
  if (const auto* tensor = lattice.as<TensorLattice>()) {
    return with_rest(scene, name, *tensor, arguments);
  }
  if (const auto* thb = lattice.as<ThbLattice>()) {
    return with_rest(scene, name, *thb, arguments);
  }
  SubdivisionLattice moved = *lattice.as<SubdivisionLattice>();
  moved.rest = moved_points(arguments, moved.rest);
  throw_if_defective(find_geometric_defects(*moved.complex, moved.rest, progress));
  return with_lattice(scene, name, std::move(moved));
}

Scene set_pose(const Scene& scene, const Arguments& arguments, const Progress& /*progress*/) {
  const std::string& name = arguments.text("lattice");
  return with_pose(scene, name,
                   arguments.has("pose") ? pose_in(scene, arguments.text("pose")).points
                                         : std::vector<glm::dvec3>());
}

Scene set_influence(const Scene& scene, const Arguments& arguments, const Progress& /*progress*/) {
  const std::string& name = arguments.text("model");
  const Model& model = model_in(scene, name);
  ModelInfluence asked;
  asked.strength = arguments.number("strength");
  asked.only = arguments.texts("only");
  asked.weights = arguments.has("weights") ? arguments.text("weights") : "";
  asked.influence = {asked.strength, point_weights(model, asked.only, asked.weights)};
  Scene result = scene;
  result.influences.insert_or_assign(name,
                                     std::make_shared<const ModelInfluence>(std::move(asked)));
  return result;
}

Scene set_lock(const Scene& scene, const Arguments& arguments, const Progress& /*progress*/) {
  const std::string& model = arguments.text("model");
  const std::string& lattice = arguments.text("lattice");
  if (!scene.bound.contains({model, lattice})) {
    throw ParameterError(model + " is not bound to " + lattice + ": bind it first");
  }
  return with_lock(scene, model, lattice, arguments.text("lock"));
}

/// The arguments of `deform` for a model's influence, if it has one.
void add_influence(const Scene& scene, const std::string& model, Arguments& arguments) {
  const auto found = scene.influences.find(model);
  if (found == scene.influences.end()) {
    return;
  }
  arguments.set("strength", found->second->strength);
  if (!found->second->only.empty()) {
    arguments.set("only", found->second->only);
  }
  if (!found->second->weights.empty()) {
    arguments.set("weights", found->second->weights);
  }
}

/// Every lattice that a model is bound to moves it; the scene keeps the model at rest.
Scene save_deformed(const Scene& scene, const Arguments& arguments, const Progress& progress) {
  static const std::string kResult = "deformed model";
  const std::string& model = arguments.text("model");
  std::vector<std::string> lattices;
  std::vector<std::string> locks;
  for (const auto& [key, bound] : scene.bound) {
    if (key.first == model) {
      lattices.push_back(key.second);
      locks.push_back(bound.lock.option);
    }
  }
  if (lattices.empty()) {
    throw ParameterError(model + " is not bound to a lattice: nothing deforms it");
  }
  const BoundModel& bound = scene.bound.at({model, lattices.front()});
  Arguments how({{"model", model},
                 {"lattice", lattices},
                 {"freeze", bound.freeze},
                 {"outside", bound.outside},
                 {"lock", locks},
                 {"output", kResult}});
  add_influence(scene, model, how);
  const Scene deformed = apply(operation_named("deform"), scene, how, progress);
  static_cast<void>(apply(operation_named("save"), deformed,
                          Arguments({{"name", kResult}, {"path", arguments.text("path")}}),
                          progress));
  return scene;
}

}  // namespace

std::vector<Operation> pose_operations() {
  const Parameter lattice = {
      .name = "lattice", .type = Type::Lattice, .help = "the lattice", .is_required = true};
  return {
      {"move points",
       "Move points of a lattice, of its pose or at rest",
       {lattice,
        {.name = "points",
         .type = Type::Integers,
         .help = "which, from 0",
         .is_required = true,
         .count = 0},
        {.name = "to", .type = Type::Numbers, .help = "x y z for each of them", .count = 0},
        {.name = "by", .type = Type::Numbers, .help = "instead: dx dy dz for all", .count = 3},
        {.name = "shape",
         .type = Type::Choice,
         .help = "of the pose, or of the lattice at rest, which unties its models (default pose)",
         .choices = {"pose", "rest"},
         .fallback = Value(std::string("pose"))}},
       move_points},
      {"set pose",
       "Bring a lattice back to rest, or into a pose",
       {lattice, {.name = "pose", .type = Type::Pose, .help = "the pose (default: at rest)"}},
       set_pose},
      {"set influence",
       "Say how much of what its lattices do a model follows",
       {{.name = "model", .type = Type::Model, .help = "the model", .is_required = true},
        {.name = "strength",
         .type = Type::Number,
         .help = "so many times the motion (default 1)",
         .fallback = Value(1.0)},
        {.name = "only",
         .type = Type::Text,
         .help = "only the points of this group or object, or of @FILE, a list of indices",
         .is_list = true},
        {.name = "weights",
         .type = Type::Path,
         .help = "a file with a weight from 0 to 1 for every point, one a line"}},
       set_influence},
      {"set lock",
       "Say how a model that leaves its lattice joins the part that stays",
       {{.name = "model", .type = Type::Model, .help = "the model", .is_required = true},
        lattice,
        {.name = "lock",
         .type = Type::Text,
         .help = "none, C0, C1 or C2: where its faces cross the lattice's boundary; C1:0,5,7: at "
                 "these faces (default C1)",
         .fallback = Value(std::string("C1"))}},
       set_lock},
      {"save deformed",
       "Write a model as the lattices it is bound to deform it",
       {{.name = "model", .type = Type::Model, .help = "the model", .is_required = true},
        {.name = "path", .type = Type::Path, .help = "the file", .is_required = true}},
       save_deformed,
       false},
  };
}

}  // namespace espalier
