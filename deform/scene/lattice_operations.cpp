/// Operations that make subdivision lattices from boxes and bars.

#include <array>
#include <utility>

#include "deform/scene/lattice_parameters.h"
#include "deform/scene/operations.h"
#include "lattice/build/primitives.h"
#include "lattice/core/error.h"

namespace espalier {
namespace {

using Type = ParameterType;

Scene new_box(const Scene& scene, const Arguments& arguments, const Progress& progress) {
  const auto n = arguments.integers("cells");
  std::array<int, 3> cells{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (n[axis] < 1 || n[axis] > 100000) {
      throw ParameterError("'cells' must be three numbers from 1 to 100000");
    }
    cells[axis] = static_cast<int>(n[axis]);
  }
  CellMesh mesh = make_box(cells, arguments.vector("min"), arguments.vector("max"));
  return add_lattice(scene, arguments, std::move(mesh), progress);
}

Scene new_cylinder(const Scene& scene, const Arguments& arguments, const Progress& progress) {
  CylinderOptions options;
  options.from = arguments.vector("from");
  options.to = arguments.vector("to");
  options.radius = arguments.number("radius");
  if (arguments.has("end-radius")) {
    options.end_radius = arguments.number("end-radius");
    if (options.end_radius == 0) {
      throw ParameterError("'end-radius' must be positive: wedge cells cannot end in a point");
    }
  }
  options.sectors = arguments.integer("sectors");
  options.layers = arguments.integer("layers");
  return add_lattice(scene, arguments, make_cylinder(options), progress);
}

}  // namespace

std::vector<Operation> lattice_operations() {
  using Numbers3 = std::vector<double>;
  return {
      {"new box",
       "Make a box of hexahedral cells",
       {{.name = "cells",
         .type = Type::Integers,
         .help = "cells along x, y, z (default 2 2 2)",
         .count = 3,
         .fallback = Value(std::vector<std::int64_t>{2, 2, 2})},
        {.name = "min",
         .type = Type::Numbers,
         .help = "lowest corner (default 0 0 0)",
         .count = 3,
         .fallback = Value(Numbers3{0, 0, 0})},
        {.name = "max",
         .type = Type::Numbers,
         .help = "highest corner (default 1 1 1)",
         .count = 3,
         .fallback = Value(Numbers3{1, 1, 1})},
        scheme_parameter(),
        sharp_parameter(),
        result_parameter("the lattice, .json or .ovm")},
       new_box},
      {"new cylinder",
       "Make a round bar of wedge cells, to wrap a limb",
       {{.name = "from",
         .type = Type::Numbers,
         .help = "centre of the first end (default 0 0 0)",
         .count = 3,
         .fallback = Value(Numbers3{0, 0, 0})},
        {.name = "to",
         .type = Type::Numbers,
         .help = "centre of the second end (default 0 1 0)",
         .count = 3,
         .fallback = Value(Numbers3{0, 1, 0})},
        {.name = "radius",
         .type = Type::Number,
         .help = "of the space it fills; its control points lie farther out (default 0.5)",
         .fallback = Value(0.5)},
        {.name = "end-radius",
         .type = Type::Number,
         .help = "at the second end (default: the same)"},
        {.name = "sectors",
         .type = Type::Integer,
         .help = "wedges round the axis (default 8)",
         .fallback = Value(std::int64_t{8})},
        {.name = "layers",
         .type = Type::Integer,
         .help = "cells along the axis (default 4)",
         .fallback = Value(std::int64_t{4})},
        scheme_parameter(),
        sharp_parameter(),
        result_parameter("the lattice, .json or .ovm")},
       new_cylinder},
  };
}

}  // namespace espalier
