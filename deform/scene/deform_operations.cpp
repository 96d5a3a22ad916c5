/// Operations that move models with lattices.

#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "deform/evaluate/combine.h"
#include "deform/evaluate/displace.h"
#include "deform/model/deformed.h"
#include "deform/model/normals.h"
#include "deform/model/point_selection.h"
#include "deform/scene/bind.h"
#include "deform/scene/densify.h"
#include "deform/scene/lattice_parameters.h"
#include "deform/scene/lock.h"
#include "deform/scene/operations.h"
#include "deform/scene/pose.h"
#include "lattice/core/error.h"
#include "lattice/core/text_scanner.h"

namespace espalier {
namespace {

using Type = ParameterType;

/// Faces whose parts separate by less than this part of the lattice's diagonal are whole.
constexpr double kTearing = 1e-9;

/// Unit normals for the model's (point, normal) pairs, each turned as the space round its point.
std::vector<glm::dvec3> turned_normals(const Model& model,
                                       const std::vector<glm::dmat3>& gradients) {
  std::vector<glm::dvec3> normals;
  normals.reserve(model.pairs().size());
  for (const PointNormal& pair : model.pairs()) {
    normals.push_back(turned_normal(gradients[static_cast<std::size_t>(pair.point)],
                                    model.normals()[static_cast<std::size_t>(pair.normal)]));
  }
  return normals;
}

/// What `normals` asks for.
struct NormalChange {
  NormalMode mode = NormalMode::Deform;
  std::optional<SharpEdges> added;  // to a model without any
};

/// deform, keep, add or add:DEGREES.
NormalChange normal_change(const std::string& word) {
  if (word == "deform" || word == "keep") {
    return {word == "keep" ? NormalMode::Keep : NormalMode::Deform, std::nullopt};
  }
  SharpEdges sharp;
  const bool is_angle = word.starts_with("add:") && parse_number(word.substr(4), sharp.angle);
  if ((word != "add" && !is_angle) || !(sharp.angle >= 0 && sharp.angle <= 180)) {
    throw ParameterError("'normals' is '" + word +
                         "', must be deform, keep, add or add:DEGREES, from 0 to 180");
  }
  return {NormalMode::Deform, sharp};
}

/// The model moved, with normals that it does not have in its file: those at rest, turned.
Model with_added_normals(const Model& model, std::span<const glm::dvec3> points, SharpEdges sharp,
                         const std::vector<glm::dmat3>& gradients) {
  sharp.smoothing_groups = smoothing_groups(model);
  CornerNormals added = corner_normals(model.points(), model.faces(), sharp);
  for (std::size_t i = 0; i < added.normals.size(); ++i) {
    const glm::dvec3 turned =
        turned_normal(gradients[static_cast<std::size_t>(added.points[i])], added.normals[i]);
    added.normals[i] = turned == glm::dvec3(0) ? added.normals[i] : turned;
  }
  return deformed_with_normals(model, points, added);
}

/// The model moved by lattices.
Model moved(const Model& model, std::span<const LatticeMotion> motions, const Influence& influence,
            const NormalChange& change) {
  const std::vector<glm::dvec3> points = combined_points(model.points(), motions, influence);
  const auto gradients = [&] { return combined_gradients(points.size(), motions, influence); };
  if (!model.pairs().empty()) {
    return deformed(model, points, turned_normals(model, gradients()), change.mode);
  }
  return change.added ? with_added_normals(model, points, *change.added, gradients())
                      : deformed(model, points, {}, change.mode);
}

/// The control points that the i-th lattice of the arguments takes.
ControlPose pose_of(const Scene& scene, const Arguments& arguments, std::size_t i) {
  const std::string lattice = arguments.texts("lattice")[i];
  return arguments.has("pose") ? pose_for(scene, lattice, arguments.texts("pose")[i])
                               : own_pose(lattice_in(scene, lattice));
}

/// An option that goes with each lattice must be given as often as they are, or not at all.
void require_one_for_each_lattice(const Arguments& arguments, const std::string& name) {
  const std::size_t n = arguments.texts(name).size();
  const std::size_t n_lattices = arguments.texts("lattice").size();
  if (n != 0 && n != n_lattices) {
    throw ParameterError("'" + name + "' is given " + std::to_string(n) + " time" +
                         (n == 1 ? "" : "s") + " for " + std::to_string(n_lattices) +
                         " lattices: give one for each, in order");
  }
}

/// The lock of the i-th lattice; one that names no faces may stand for all.
std::string lock_of(const Arguments& arguments, std::size_t i) {
  const std::vector<std::string> locks = arguments.texts("lock");
  if (locks.size() == 1 && locks.front().find(':') == std::string::npos) {
    return locks.front();
  }
  require_one_for_each_lattice(arguments, "lock");
  return locks.empty() ? "none" : locks[i];
}

Influence influence_of(const Model& model, const Arguments& arguments) {
  const std::vector<std::string> only = arguments.texts("only");
  return {arguments.number("strength"),
          point_weights(model, only, arguments.has("weights") ? arguments.text("weights") : "")};
}

/// How `deform` binds: what is not given is as the binding has it.
BindOptions bind_options(const Arguments& arguments) {
  BindOptions options;
  if (arguments.has("binding")) {
    options = {"", ""};
  }
  if (arguments.has("freeze")) {
    options.freeze = arguments.text("freeze");
  }
  if (arguments.has("outside")) {
    options.outside = arguments.text("outside");
  }
  return options;
}

/// The scene with the model bound to the i-th lattice of the arguments.
Scene bound_by(const Scene& scene, const Arguments& arguments, std::size_t i,
               const Progress& progress) {
  const std::string& model = arguments.text("model");
  const std::string lattice = arguments.texts("lattice")[i];
  const BindOptions options = bind_options(arguments);
  if (arguments.has("binding")) {
    return with_saved_binding(scene, model, lattice, arguments.texts("binding")[i], options,
                              progress);
  }
  return with_bound(scene, model, lattice, options, progress);
}

Scene bind(const Scene& scene, const Arguments& arguments, const Progress& progress) {
  const std::string& model = arguments.text("model");
  const std::string& lattice = arguments.text("lattice");
  Scene result = with_bound(scene, model, lattice,
                            {arguments.text("freeze"), arguments.text("outside")}, progress);
  if (arguments.has("output")) {
    save_binding(result, model, lattice, arguments.text("output"));
  }
  return result;
}

/// What one lattice of `deform` does.
struct LatticeAction {
  LatticeMotion motion;
  std::vector<std::int32_t> torn_faces;
};

/// Binds the model to the i-th lattice and poses that; the scene keeps what the next pose can use.
LatticeAction act(Scene& scene, const Arguments& arguments, std::size_t i,
                  const Influence& influence, const Progress& progress) {
  const std::string& model = arguments.text("model");
  const std::string lattice = arguments.texts("lattice")[i];
  ControlPose asked = pose_of(scene, arguments, i);
  scene = bound_by(scene, arguments, i, progress);
  scene = with_lock(scene, model, lattice, lock_of(arguments, i));
  const auto bound = [&]() -> const BoundModel& { return scene.bound.at({model, lattice}); };
  const Volume& volume = *bound().volume;
  const std::span<const glm::dvec3> rest = volume.rest_controls();
  const std::vector<glm::dvec3> pose = locked_pose(std::move(asked.points), rest, bound().lock);
  const std::vector<double> weights = locked_weights(
      std::move(asked.weights), rest_weights(lattice_in(scene, lattice)), bound().lock);
  LatticeAction action{
      {bound().volume, bound().binding, volume.displacements(pose), point_weights(volume, weights)},
      {}};
  const bool is_at_rest = std::ranges::equal(pose, rest);
  if (bound().outside == "keep" && !is_at_rest && bound().binding->counts().outside > 0) {
    scene = with_crossings(scene, model, lattice);
    action.torn_faces =
        torn_faces(*bound().crossings, rest, pose, influence, kTearing * volume.diagonal());
  }
  return action;
}

/// What `deform` binds: the model itself, or in its place a denser one.
Scene made_dense(const Scene& scene, const Arguments& arguments, const Progress& progress) {
  if (!arguments.has("densify")) {
    return scene;
  }
  if (arguments.has("binding")) {
    throw ParameterError(
        "'densify' changes the model, and 'binding' is of the model as it is: bind what the "
        "operation densify makes");
  }
  const std::string& model = arguments.text("model");
  return with_dense_model(scene, model, arguments.texts("lattice"),
                          parse_densify(arguments.text("densify")), bind_options(arguments), model,
                          progress);
}

Scene densify(const Scene& scene, const Arguments& arguments, const Progress& progress) {
  DensifyOptions options = parse_densify(arguments.text("method"));
  if (arguments.has("length")) {
    if (arguments.has("lattice")) {
      throw ParameterError("'length' and --lattice exclude each other: the lattice gives a length");
    }
    options.length = arguments.number("length");
    if (!(options.length > 0)) {
      throw ParameterError("'length' must be positive");
    }
  }
  return with_dense_model(scene, arguments.text("model"), arguments.texts("lattice"), options, {},
                          arguments.text("output"), progress);
}

Scene deform(const Scene& given, const Arguments& arguments, const Progress& progress) {
  require_one_for_each_lattice(arguments, "pose");
  require_one_for_each_lattice(arguments, "binding");
  const Scene scene = made_dense(given, arguments, progress);
  const Model& model = model_in(scene, arguments.text("model"));
  const Influence influence = influence_of(model, arguments);
  const NormalChange change = normal_change(arguments.text("normals"));
  Scene result = scene;
  std::vector<LatticeMotion> motions;
  std::set<std::int32_t> torn;
  for (std::size_t i = 0; i < arguments.texts("lattice").size(); ++i) {
    LatticeAction action = act(result, arguments, i, influence, progress);
    motions.push_back(std::move(action.motion));
    torn.insert(action.torn_faces.begin(), action.torn_faces.end());
  }
  const std::string& output = arguments.text("output");
  result = with_model(std::move(result), output, moved(model, motions, influence, change));
  if (!torn.empty()) {
    result.torn_faces[output] = torn.size();
  }
  return result;
}

Parameter model_parameter() {
  return {.name = "model",
          .type = Type::Model,
          .help = "the model (.obj, .off, .ply, .stl)",
          .is_required = true,
          .is_positional = true};
}

Parameter lattice_parameter() {
  return {.name = "lattice",
          .type = Type::Lattice,
          .help = "the lattice at rest (.json, .ovm)",
          .is_required = true};
}

Parameter outside_parameter() {
  return {.name = "outside",
          .type = Type::Text,
          .help =
              "what points outside the lattice do: keep (default), or falloff:D, follow its "
              "boundary, fading out over distance D",
          .fallback = Value(BindOptions().outside)};
}

/// One that takes several values; `more` continues its help.
Parameter repeating(Parameter parameter, const char* more) {
  parameter.is_list = true;
  parameter.help += more;
  return parameter;
}

/// One that a binding decides where it is not given.
Parameter as_bound(Parameter parameter) {
  parameter.help += ", or as the binding given by --binding";
  parameter.fallback.reset();
  return parameter;
}

}  // namespace

std::vector<Operation> deform_operations() {
  return {
      {"bind",
       "Tie a model to a lattice once, for many deformations",
       {model_parameter(),
        lattice_parameter(),
        freeze_parameter(),
        outside_parameter(),
        {.name = "output",
         .type = Type::Path,
         .help = "the binding, a file for `deform --binding`"}},
       bind},
      {"deform",
       "Deform a model with a lattice and its pose",
       {model_parameter(),
        repeating(lattice_parameter(), "; may repeat: what they do to the model at rest adds up"),
        {.name = "pose",
         .type = Type::Pose,
         .help = "the lattice posed: its pose if it has one, else its points (default: the pose in "
                 "--lattice); repeats in the lattices' order; on the command line a quoted pattern "
                 "such as 'poses/*.json' for many poses in one run",
         .is_list = true},
        {.name = "strength",
         .type = Type::Number,
         .help = "how much of the motion is done, any number (default 1)",
         .fallback = Value(1.0)},
        {.name = "only",
         .type = Type::Text,
         .help = "only the points of this group or object, or @FILE: of these indices, one a line, "
                 "from 0; may repeat (default: all points)",
         .is_list = true},
        {.name = "weights",
         .type = Type::Path,
         .help =
             "a text file with a number from 0 to 1 for each point, one a line, that multiplies "
             "its motion"},
        {.name = "binding",
         .type = Type::Path,
         .help = "what `bind` wrote for this model and lattice; repeats in the lattices' order",
         .is_list = true},
        as_bound(freeze_parameter()),
        as_bound(outside_parameter()),
        {.name = "lock",
         .type = Type::Text,
         .help = "keep the lattice still where the model leaves it, so that the motion joins what "
                 "stays in position (C0), slope too (C1) or curvature too (C2): at the boundary "
                 "faces that the model crosses, or, as C1:0,5,7, at these faces of the lattice's "
                 "file, or, as C1:u0,w1, at these sides of a lattice without cells; repeats in the "
                 "lattices' order, or stands for all (default none)",
         .is_list = true},
        {.name = "normals",
         .type = Type::Text,
         .help = "deform (default), keep their number, or add[:DEGREES]: where a file has none, "
                 "add them, split at edges sharper than that (default 40) or between an OBJ file's "
                 "smoothing groups; OFF and PLY files get points there once more, after all others",
         .fallback = Value(std::string("deform"))},
        {.name = "densify",
         .type = Type::Text,
         .help =
             "make the model denser first: midpoint, loop or catmull-clark, until its edges are "
             "as short as the finest spacing of control points under it, or METHOD:LENGTH, as "
             "short as that"},
        {.name = "output",
         .type = Type::Result,
         .help = "the deformed model; {} stands for the pose's name without folder and extension",
         .is_required = true}},
       deform},
      {"densify",
       "Make a model denser, so that it can follow a lattice",
       {model_parameter(),
        {.name = "method",
         .type = Type::Choice,
         .help = "midpoint (default): only long edges are halved, the shape stays; loop: of "
                 "triangles, or catmull-clark: of any polygons, smooth and everywhere",
         .choices = {"midpoint", "loop", "catmull-clark"},
         .fallback = Value(std::string("midpoint"))},
        {.name = "length", .type = Type::Number, .help = "of the longest edge, model units"},
        {.name = "lattice",
         .type = Type::Lattice,
         .help = "instead of a length: the finest spacing of control points under the model; may "
                 "repeat",
         .is_list = true},
        {.name = "output",
         .type = Type::Result,
         .help = "the denser model, in the format of the model",
         .is_required = true}},
       densify},
  };
}

}  // namespace espalier
