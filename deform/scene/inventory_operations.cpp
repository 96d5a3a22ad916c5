/// Operations that make lattices of the inventory, where they are told to be or round a model.

#include <array>
#include <cmath>
#include <functional>
#include <type_traits>
#include <utility>

#include "deform/fit/limb_fit.h"
#include "deform/scene/fitting.h"
#include "deform/scene/index_list.h"
#include "deform/scene/lattice_parameters.h"
#include "deform/scene/operations.h"
#include "lattice/build/inventory.h"
#include "lattice/build/junction.h"
#include "lattice/build/primitives.h"
#include "lattice/core/error.h"
#include "lattice/core/text_scanner.h"

namespace espalier {
namespace {

using Type = ParameterType;

Parameter point(const char* name, const char* help) {
  return {.name = name, .type = Type::Numbers, .help = help, .count = 3};
}

Parameter number(const char* name, const char* help) {
  return {.name = name, .type = Type::Number, .help = help};
}

Parameter count(const char* name, const char* help) {
  return {.name = name, .type = Type::Integer, .help = help};
}

// Arguments into options, which keep their defaults where nothing is given.

void read(const Arguments& arguments, const char* name, glm::dvec3& value) {
  value = arguments.has(name) ? arguments.vector(name) : value;
}

void read(const Arguments& arguments, const char* name, double& value) {
  value = arguments.has(name) ? arguments.number(name) : value;
}

void read(const Arguments& arguments, const char* name, int& value) {
  value = arguments.has(name) ? arguments.integer(name) : value;
}

/// 0 means "the same" to the makers, but not to a user.
void read_end_radius(const Arguments& arguments, double& value) {
  read(arguments, "end-radius", value);
  if (arguments.has("end-radius") && value == 0) {
    throw ParameterError("'end-radius' must be positive: cells cannot end in a point");
  }
}

struct BoxOptions {
  std::array<int, 3> cells = {2, 2, 2};
  glm::dvec3 min{0};
  glm::dvec3 max{1};
};

BoxOptions box_options(const Arguments& arguments) {
  BoxOptions options;
  if (arguments.has("cells")) {
    const auto n = arguments.integers("cells");
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (n[axis] < 1 || n[axis] > 100000) {
        throw ParameterError("'cells' must be three numbers from 1 to 100000");
      }
      options.cells[axis] = static_cast<int>(n[axis]);
    }
  }
  read(arguments, "min", options.min);
  read(arguments, "max", options.max);
  return options;
}

CylinderOptions cylinder_options(const Arguments& arguments) {
  CylinderOptions options;
  read(arguments, "from", options.from);
  read(arguments, "to", options.to);
  read(arguments, "radius", options.radius);
  read_end_radius(arguments, options.end_radius);
  read(arguments, "sectors", options.sectors);
  read(arguments, "layers", options.layers);
  return options;
}

OGridOptions o_grid_options(const Arguments& arguments) {
  OGridOptions options;
  read(arguments, "from", options.from);
  read(arguments, "to", options.to);
  read(arguments, "radius", options.radius);
  read_end_radius(arguments, options.end_radius);
  read(arguments, "core", options.core);
  read(arguments, "rings", options.rings);
  read(arguments, "layers", options.layers);
  return options;
}

AnnulusOptions annulus_options(const Arguments& arguments) {
  AnnulusOptions options;
  read(arguments, "from", options.from);
  read(arguments, "to", options.to);
  read(arguments, "radius", options.radius);
  read(arguments, "inner-radius", options.inner_radius);
  read(arguments, "sectors", options.sectors);
  read(arguments, "rings", options.rings);
  read(arguments, "layers", options.layers);
  return options;
}

TorusOptions torus_options(const Arguments& arguments) {
  TorusOptions options;
  read(arguments, "center", options.center);
  read(arguments, "axis", options.axis);
  read(arguments, "radius", options.radius);
  read(arguments, "tube-radius", options.tube_radius);
  read(arguments, "sectors", options.sectors);
  read(arguments, "segments", options.segments);
  return options;
}

SphereOptions sphere_options(const Arguments& arguments) {
  SphereOptions options;
  read(arguments, "center", options.center);
  read(arguments, "radius", options.radius);
  read(arguments, "cells", options.cells);
  read(arguments, "rings", options.rings);
  return options;
}

StarOptions star_options(const Arguments& arguments) {
  StarOptions options;
  read(arguments, "from", options.from);
  read(arguments, "to", options.to);
  read(arguments, "radius", options.radius);
  read(arguments, "inner-radius", options.inner_radius);
  read(arguments, "tips", options.tips);
  read(arguments, "layers", options.layers);
  return options;
}

BarbellOptions barbell_options(const Arguments& arguments) {
  BarbellOptions options;
  read(arguments, "from", options.from);
  read(arguments, "to", options.to);
  read(arguments, "by", options.by);
  read(arguments, "radius", options.radius);
  read(arguments, "bar-radius", options.bar_radius);
  read(arguments, "cells", options.cells);
  read(arguments, "layers", options.layers);
  return options;
}

JunctionOptions junction_options(const Arguments& arguments) {
  JunctionOptions options;
  read(arguments, "center", options.center);
  read(arguments, "radius", options.radius);
  read(arguments, "layers", options.layers);
  double length = 1;
  read(arguments, "length", length);
  const std::string& kind = arguments.text("kind");
  if (kind == "Y") {
    options.arms = {{length * std::sqrt(0.75), length / 2, 0},
                    {-length * std::sqrt(0.75), length / 2, 0},
                    {0, -length, 0}};
  } else {
    options.arms = {{length, 0, 0}, {0, length, 0}};
    if (kind == "T") {
      options.arms.emplace_back(-length, 0, 0);
    }
  }
  return options;
}

/// The numbers of "x,y,z" or "x,y,z,r".
std::vector<double> numbers_of(const std::string& word) {
  std::vector<double> numbers;
  for (const std::string& part : words_between(word, ',')) {
    if (!parse_number(part, numbers.emplace_back())) {
      return {};
    }
  }
  return numbers;
}

LimbOptions limb_options(const Arguments& arguments) {
  LimbOptions options;
  double radius = 0.1;
  read(arguments, "radius", radius);
  read(arguments, "sectors", options.sectors);
  read(arguments, "layers", options.layers);
  for (const std::string& word : arguments.texts("joint")) {
    const std::vector<double> numbers = numbers_of(word);
    if (numbers.size() != 3 && numbers.size() != 4) {
      throw ParameterError("'joint' is " + quoted(word) + ", must be x,y,z or x,y,z,radius");
    }
    if (numbers.size() == 4 && arguments.has("fit")) {
      throw ParameterError("'joint' is " + quoted(word) + " with a radius, which --fit finds");
    }
    options.joints.emplace_back(numbers[0], numbers[1], numbers[2]);
    options.radii.push_back(numbers.size() == 4 ? numbers[3] : radius);
  }
  return options;
}

// Options into lattices.

CellMesh make(const BoxOptions& options) {
  return make_box(options.cells, options.min, options.max);
}
CellMesh make(const CylinderOptions& options) {
  return make_cylinder(options);
}
CellMesh make(const OGridOptions& options) {
  return make_o_grid(options);
}
CellMesh make(const AnnulusOptions& options) {
  return make_annulus(options);
}
CellMesh make(const TorusOptions& options) {
  return make_torus(options);
}
CellMesh make(const SphereOptions& options) {
  return make_sphere(options);
}
CellMesh make(const StarOptions& options) {
  return make_star(options);
}
CellMesh make(const BarbellOptions& options) {
  return make_barbell(options);
}
CellMesh make(const JunctionOptions& options) {
  return make_junction(options);
}
CellMesh make(const LimbOptions& options) {
  return make_limb(options);
}

template <class Options>
CellMesh make_fitted(const Options& options, const FitRequest& request, double margin) {
  return make(fitted(options, request.points, request.options, margin));
}
CellMesh make_fitted(const BoxOptions& options, const FitRequest& request, double margin) {
  return fitted_box_grid(options.cells, request.points, request.options, margin);
}

/// A limb with the radii that the model needs. make: gets them.
Scene add_fitted_limb(const Scene& scene, const Arguments& arguments, const FitKind& kind,
                      const std::vector<glm::dvec3>& joints,
                      const std::function<CellMesh(const std::vector<double>&)>& make_with,
                      const Progress& progress) {
  const FitRequest request = limb_fit_request(scene, arguments, kind, joints);
  // The ends stay where they are: room is only wanted on the sides.
  const Fitting fitting = {
      .points = moved_off_bones(request.points, joints, request.padding),
      .margin = request.padding,
      .mesh = [&](double margin) { return make_with(limb_radii(request.points, joints, margin)); }};
  return add_fitted_lattice(scene, arguments, fitting, progress);
}

/// A bar between given ends is a limb of one bone.
template <class Bar>
Scene add_fitted_bar(const Scene& scene, const Arguments& arguments, FitKind kind, const Bar& bar,
                     const Progress& progress) {
  if (!arguments.has("from") || !arguments.has("to")) {
    throw ParameterError("'from' and --to belong together with --fit");
  }
  if (bar.from == bar.to) {
    throw ParameterError("'from' and --to must differ");
  }
  kind.places = {"radius", "end-radius", "axes", "along"};
  return add_fitted_limb(
      scene, arguments, kind, {bar.from, bar.to},
      [&](const std::vector<double>& radii) {
        Bar between = bar;
        between.radius = radii[0];
        between.end_radius = radii[1];
        return make(between);
      },
      progress);
}

/// The scene with the lattice that options describe, or with one of this kind round a model.
template <class Options>
Scene add(const Scene& scene, const Arguments& arguments, const FitKind& kind,
          const Options& options, const Progress& progress) {
  if (!arguments.has("fit")) {
    require_no_fit_options(arguments);
    return add_lattice(scene, arguments, make(options), progress);
  }
  if constexpr (std::is_same_v<Options, LimbOptions>) {
    return add_fitted_limb(
        scene, arguments, kind, options.joints,
        [&](const std::vector<double>& radii) {
          LimbOptions limb = options;
          limb.radii = radii;
          return make(limb);
        },
        progress);
  } else {
    if constexpr (requires { options.end_radius; }) {
      if (arguments.has("from") || arguments.has("to")) {
        return add_fitted_bar(scene, arguments, kind, options, progress);
      }
    }
    const FitRequest request = fit_request(scene, arguments, kind);
    return add_fitted_lattice(
        scene, arguments,
        {.points = request.points,
         .clearance = request.padding,
         .margin = request.padding,
         .mesh = [&](double margin) { return make_fitted(options, request, margin); }},
        progress);
  }
}

// The table.

/// An operation that adds a lattice of a kind, with the parameters all of them have. options_of:
/// what its arguments say.
template <class Options>
Operation making(const char* name, const char* summary, std::vector<Parameter> parameters,
                 FitKind kind, Options (*options_of)(const Arguments&)) {
  std::vector<Parameter> fit = fit_parameters(kind);
  std::move(fit.begin(), fit.end(), std::back_inserter(parameters));
  parameters.push_back(scheme_parameter());
  parameters.push_back(sharp_parameter());
  parameters.push_back(result_parameter("the lattice, .json or .ovm"));
  return {name, summary, std::move(parameters),
          [kind = std::move(kind), options_of](const Scene& scene, const Arguments& arguments,
                                               const Progress& progress) {
            return add(scene, arguments, kind, options_of(arguments), progress);
          }};
}

std::vector<Operation> bar_operations() {
  const FitKind box = {.places = {"min", "max"}, .has_axes = true};
  const FitKind bar = {.places = {"radius", "end-radius"},
                       .has_axes = true,
                       .has_along = true,
                       .is_principal = true};
  const Parameter from = point("from", "centre of the first end (default 0 0 0)");
  const Parameter to = point("to", "centre of the second end (default 0 1 0)");
  const Parameter end_radius = number("end-radius", "at the second end (default: the same)");
  return {
      making("new box", "Make a box of hexahedral cells",
             {{.name = "cells",
               .type = Type::Integers,
               .help = "cells along x, y, z (default 2 2 2)",
               .count = 3},
              point("min", "lowest corner (default 0 0 0)"),
              point("max", "highest corner (default 1 1 1)")},
             box, box_options),
      making("new cylinder", "Make a round bar of wedge cells, to wrap a limb",
             {from, to,
              number("radius",
                     "of the space it fills; its control points lie farther out (default 0.5)"),
              end_radius, count("sectors", "wedges round the axis (default 8)"),
              count("layers", "cells along the axis (default 4)")},
             bar, cylinder_options),
      making("new ogrid", "Make a round bar of hexahedra, a square in rings",
             {from, to, number("radius", "of the space it fills (default 0.5)"), end_radius,
              count("core", "cells across the square (default 2)"),
              count("rings", "cells from the square to the side (default 1)"),
              count("layers", "cells along the axis (default 4)")},
             bar, o_grid_options),
  };
}

std::vector<Operation> round_operations() {
  const FitKind annulus = {.places = {"from", "to", "radius", "inner-radius"},
                           .has_axes = true,
                           .has_along = true,
                           .is_principal = true};
  const FitKind torus = {.places = {"center", "axis", "radius", "tube-radius"},
                         .has_axes = true,
                         .has_along = true,
                         .is_principal = true};
  return {
      making("new annulus", "Make a pipe of hexahedra",
             {point("from", "centre of the first end (default 0 0 0)"),
              point("to", "centre of the second end (default 0 1 0)"),
              number("radius", "of the space it fills (default 0.5)"),
              number("inner-radius", "of the hole (default 0.25)"),
              count("sectors", "cells round the axis (default 8)"),
              count("rings", "cells from the hole to the side (default 1)"),
              count("layers", "cells along the axis (default 4)")},
             annulus, annulus_options),
      making("new torus", "Make a closed ring of wedges",
             {point("center", "its middle (default 0 0 0)"),
              point("axis", "across the ring (default 0 1 0)"),
              number("radius", "of the circle in the tube's middle (default 1)"),
              number("tube-radius", "of the space round it (default 0.25)"),
              count("sectors", "wedges round the tube (default 8)"),
              count("segments", "cells along the ring (default 12)")},
             torus, torus_options),
      making("new sphere", "Make a ball of hexahedra, a cube in shells",
             {point("center", "its middle (default 0 0 0)"),
              number("radius", "of the space it fills (default 0.5)"),
              count("cells", "across the cube (default 2)"), count("rings", "shells (default 1)")},
             {.places = {"center", "radius"}}, sphere_options),
  };
}

std::vector<Operation> outline_operations() {
  const FitKind star = {.places = {"from", "to", "radius", "inner-radius"},
                        .has_axes = true,
                        .has_along = true,
                        .is_principal = true};
  const FitKind barbell = {.places = {"from", "to", "by", "radius", "bar-radius"},
                           .has_axes = true,
                           .is_principal = true};
  return {
      making("new star", "Make a star, extruded",
             {point("from", "centre of the first side (default 0 0 0)"),
              point("to", "centre of the second side (default 0 0 1)"),
              number("radius", "of its tips (default 1)"),
              number("inner-radius", "between them (default 0.5)"),
              count("tips", "how many (default 5)"),
              count("layers", "cells from side to side (default 1)")},
             star, star_options),
      making("new barbell", "Make two disks joined by a bar, extruded",
             {point("from", "middle of the first disk (default -1 0 0)"),
              point("to", "middle of the second disk (default 1 0 0)"),
              point("by", "extrusion dx dy dz (default 0 0 1)"),
              number("radius", "of the disks (default 0.5)"),
              number("bar-radius", "half the bar's width (default 0.15)"),
              count("cells", "along the bar (default 4)"),
              count("layers", "cells along the extrusion (default 1)")},
             barbell, barbell_options),
  };
}

std::vector<Operation> jointed_operations() {
  return {
      making("new junction", "Make round bars that meet in an L, T or Y, in the x-y plane",
             {{.name = "kind",
               .type = Type::Choice,
               .help = "the letter (default T)",
               .choices = {"L", "T", "Y"},
               .fallback = Value(std::string("T"))},
              point("center", "where they meet (default 0 0 0)"),
              number("radius", "of the space round each (default 0.25)"),
              number("length", "of each from the centre (default 1)"),
              count("layers", "cells along each (default 3)")},
             {.places = {"center", "radius", "length"}}, junction_options),
      making(
          "new limb", "Make wedges along a chain of joints",
          {{.name = "joint",
            .type = Type::Text,
            .help =
                "x,y,z or x,y,z,radius; two or more, in order; with --fit x,y,z, from the body on",
            .is_required = true,
            .is_list = true},
           number("radius", "of the space round joints without their own (default 0.1)"),
           count("sectors", "wedges round the bones (default 8)"),
           count("layers", "cells along each bone (default 3)")},
          {.places = {"radius"}}, limb_options),
  };
}

}  // namespace

std::vector<Operation> inventory_operations() {
  std::vector<Operation> operations;
  for (auto part :
       {bar_operations(), round_operations(), outline_operations(), jointed_operations()}) {
    std::move(part.begin(), part.end(), std::back_inserter(operations));
  }
  return operations;
}

}  // namespace espalier
