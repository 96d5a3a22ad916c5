/// Operations that pose limbs: each changes a lattice's pose as it is now.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

#include "deform/animate/limb_part.h"
#include "deform/animate/limb_pose.h"
#include "deform/scene/element_lists.h"
#include "deform/scene/operations.h"
#include "lattice/build/mesh_draft.h"
#include "lattice/core/error.h"

namespace espalier {
namespace {

using Type = ParameterType;
using Points = std::vector<glm::dvec3>;

/// Where some of a lattice's posed points go.
using PoseMap = std::function<Points(const Lattice&, const Points&, const Arguments&)>;

/// The limb that `about` and `along` describe; throws ParameterError without these, and for what is
/// the larger part of the lattice.
LimbPart limb_of(const Lattice& lattice, const Arguments& arguments) {
  if (!arguments.has("along") || arguments.vector("along") == glm::dvec3(0)) {
    throw ParameterError("'limb' needs --along, the direction of the limb, not zero");
  }
  const glm::dvec3 joint = arguments.vector("about");
  LimbPart limb =
      limb_part(lattice.posed_points(), lattice.net(), joint, arguments.vector("along"));
  if (2 * limb.n_parted > limb.shares.size()) {
    throw ParameterError(fmt::format(
        "'limb': the cut at ({:.6g}, {:.6g}, {:.6g}) parts {} of the lattice's {} control points, "
        "more than a limb: put the joint where the limb hangs together with nothing else, or give "
        "the lattice more cells",
        joint.x, joint.y, joint.z, limb.n_parted, limb.shares.size()));
  }
  return limb;
}

bool is_of_limb(const Arguments& arguments) {
  return arguments.has("limb") && arguments.flag("limb");
}

/// The posed points with those that the arguments name mapped.
Points mapped_points(const Lattice& lattice, const Arguments& arguments, const PoseMap& map) {
  const auto posed = lattice.posed_points();
  Points result(posed.begin(), posed.end());
  if (is_of_limb(arguments)) {
    if (arguments.has("vertices")) {
      throw ParameterError("'limb' and --vertices exclude each other");
    }
    const LimbPart limb = limb_of(lattice, arguments);
    const Points all = map(lattice, result, arguments);
    for (std::size_t i = 0; i < result.size(); ++i) {
      const double share = limb.shares[i];
      result[i] = share == 1 ? all[i] : share == 0 ? posed[i] : glm::mix(posed[i], all[i], share);
    }
    return result;
  }
  if (!arguments.has("vertices")) {
    return map(lattice, result, arguments);
  }
  const std::vector<std::int32_t> chosen = indices_of(arguments, "vertices");
  check_selection(chosen, result.size(), "'vertices': control point");
  Points some;
  for (const std::int32_t i : chosen) {
    some.push_back(result[static_cast<std::size_t>(i)]);
  }
  some = map(lattice, some, arguments);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    result[static_cast<std::size_t>(chosen[i])] = some[i];
  }
  return result;
}

/// A pose that changes nothing leaves the lattice as it is, so at rest if it was.
std::function<Scene(const Scene&, const Arguments&, const Progress&)> posing(PoseMap map) {
  return [map = std::move(map)](const Scene& scene, const Arguments& arguments, const Progress&) {
    const std::string& source = arguments.text("lattice");
    const Lattice& lattice = lattice_in(scene, source);
    const std::string& name = arguments.has("output") ? arguments.text("output") : source;
    Points points = mapped_points(lattice, arguments, map);
    const Scene result = name == source ? scene : with_lattice(scene, name, lattice);
    return std::ranges::equal(points, lattice.posed_points())
               ? result
               : with_pose(result, name, std::move(points));
  };
}

/// The region that `about`, `along` and `falloff` describe. usual: the falloff where none is given,
/// in half thicknesses of the limb at the joint.
LimbRegion region_of(const Lattice& lattice, const Arguments& arguments, double usual) {
  LimbRegion region{.joint = arguments.vector("about")};
  if (!arguments.has("along")) {
    if (arguments.has("falloff")) {
      throw ParameterError("'falloff' needs --along, the direction of the limb");
    }
    return region;
  }
  region.along = arguments.vector("along");
  if (region.along == glm::dvec3(0)) {
    throw ParameterError("'along' must not be zero");
  }
  if (arguments.has("falloff")) {
    region.falloff = arguments.number("falloff");
  } else {
    region.falloff =
        usual * (is_of_limb(arguments) ? limb_of(lattice, arguments).radius
                                       : cut_radius(lattice.posed_points(), lattice.net(),
                                                    region.joint, region.along));
  }
  return region;
}

Bone bone_of(const Arguments& arguments) {
  return {arguments.vector("from"), arguments.vector("to")};
}

/// A falloff of 3/2 θ half thicknesses is just enough not to fold.
Points rotate(const Lattice& lattice, const Points& points, const Arguments& arguments) {
  const double degrees = arguments.number("angle");
  const double usual = 2 * std::max(1.0, std::abs(glm::radians(degrees)));
  return turned(points, region_of(lattice, arguments, usual), arguments.vector("axis"), degrees);
}

Points scale(const Lattice& lattice, const Points& points, const Arguments& arguments) {
  return scaled(points, region_of(lattice, arguments, 2), arguments.vector("scale"));
}

Points move(const Lattice& lattice, const Points& points, const Arguments& arguments) {
  return moved(points, region_of(lattice, arguments, 2), arguments.vector("by"));
}

Points twist(const Lattice&, const Points& points, const Arguments& arguments) {
  return twisted(points, bone_of(arguments), arguments.number("angle"));
}

Points bend(const Lattice&, const Points& points, const Arguments& arguments) {
  return bent(points, bone_of(arguments), arguments.vector("towards"), arguments.number("angle"));
}

Points taper(const Lattice&, const Points& points, const Arguments& arguments) {
  return tapered(points, bone_of(arguments), arguments.number("scale"));
}

// The table.

Parameter vector_parameter(const char* name, const char* help) {
  return {.name = name, .type = Type::Numbers, .help = help, .is_required = true, .count = 3};
}

Parameter number_parameter(const char* name, const char* help) {
  return {.name = name, .type = Type::Number, .help = help, .is_required = true};
}

Operation pose_operation(const char* name, const char* summary, std::vector<Parameter> own,
                         PoseMap map) {
  std::vector<Parameter> parameters = {{.name = "lattice",
                                        .type = Type::Lattice,
                                        .help = "the lattice, of any type, as it is posed now",
                                        .is_required = true,
                                        .is_positional = true}};
  std::move(own.begin(), own.end(), std::back_inserter(parameters));
  parameters.push_back({.name = "vertices",
                        .type = Type::Text,
                        .help = "only these control points, such as 0,3,7-9 (default: all)"});
  parameters.push_back({.name = "output",
                        .type = Type::Result,
                        .help = "the posed lattice (in a script also: the lattice itself)"});
  return {name, summary, std::move(parameters), posing(std::move(map))};
}

/// `own`, then what describes a region.
std::vector<Parameter> with_region(std::vector<Parameter> own, const char* about) {
  own.push_back(
      {.name = "about", .type = Type::Numbers, .help = about, .is_required = true, .count = 3});
  own.push_back({.name = "along",
                 .type = Type::Numbers,
                 .help = "direction of the limb: only what is beyond the joint (default: all)",
                 .count = 3});
  own.push_back({.name = "falloff",
                 .type = Type::Number,
                 .help = "length over which that begins, half before and half beyond the joint "
                         "(default: the lattice's thickness there, more for large angles)"});
  own.push_back({.name = "limb",
                 .type = Type::Flag,
                 .help =
                     "only what hangs together with the joint, of a lattice round a whole body: "
                     "no other limb, though it too is beyond"});
  return own;
}

}  // namespace

std::vector<Operation> limb_pose_operations() {
  const Parameter from = vector_parameter("from", "where it begins on the limb's axis");
  const Parameter to = vector_parameter("to", "where it ends; what is beyond follows");
  Parameter axis = vector_parameter("axis", "to turn about (default 0 0 1)");
  axis.is_required = false;
  axis.fallback = Value(std::vector<double>{0, 0, 1});
  return {
      pose_operation("pose rotate", "Turn a limb about a joint",
                     with_region({number_parameter("angle", "in degrees, counter-clockwise"), axis},
                                 "the joint, a point of the axis"),
                     rotate),
      pose_operation("pose twist", "Twist a limb about its axis",
                     {from, to, number_parameter("angle", "at its end, in degrees")}, twist),
      pose_operation("pose bend", "Bend a limb into an arc of the same length",
                     {from, to, number_parameter("angle", "between its ends, in degrees"),
                      vector_parameter("towards", "the side to bend to")},
                     bend),
      pose_operation("pose taper", "Make a limb thicker or thinner towards its end",
                     {from, to, number_parameter("scale", "factor at its end, across it")}, taper),
      pose_operation("pose scale", "Scale a limb from a joint on",
                     with_region({vector_parameter("scale", "factors along x y z")},
                                 "the joint, which scaling keeps"),
                     scale),
      pose_operation("pose move", "Move a limb from a joint on",
                     with_region({vector_parameter("by", "dx dy dz, model units")}, "the joint"),
                     move),
  };
}

}  // namespace espalier
