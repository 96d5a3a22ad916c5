/// Operations that make subdivision lattices from boxes, bars and meshes.

#include <array>
#include <utility>

#include "deform/scene/lattice_parameters.h"
#include "deform/scene/operations.h"
#include "lattice/build/extrude.h"
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

/// A lattice converts to itself: what changes is its file. Its tags stay.
Scene convert_lattice(const Scene& scene, const Arguments& arguments) {
  for (const char* option : {"extrude", "thicken", "solid", "layers", "sharp"}) {
    if (arguments.has(option)) {
      throw ParameterError(std::string("'") + option + "' is for surface meshes, not for lattices");
    }
  }
  const std::string& name = arguments.text("mesh");
  if (!arguments.has("scheme")) {
    return with_lattice(scene, arguments.text("output"), lattice_in(scene, name));
  }
  SubdivisionLattice lattice = subdivision_lattice_in(scene, name, "--scheme");
  lattice.scheme = scheme_of(arguments, lattice.scheme);
  return with_lattice(scene, arguments.text("output"), std::move(lattice));
}

/// Cells from a surface mesh, one of three ways.
CellMesh mesh_from(const Model& model, const Arguments& arguments) {
  const int n_ways = (arguments.has("extrude") ? 1 : 0) + (arguments.has("thicken") ? 1 : 0) +
                     (arguments.flag("solid") ? 1 : 0);
  if (n_ways != 1) {
    throw ParameterError(n_ways == 0 ? "'extrude' is missing: direction and length dx dy dz; or "
                                       "--thicken, or --solid"
                                     : "'extrude', --thicken and --solid exclude each other");
  }
  if (arguments.flag("solid")) {
    if (arguments.has("layers")) {
      throw ParameterError("'layers' is for --extrude and --thicken");
    }
    return solid(model.points(), model.faces());
  }
  const int layers = arguments.has("layers") ? arguments.integer("layers") : 1;
  return arguments.has("extrude")
             ? extrude(model.points(), model.faces(), arguments.vector("extrude"), layers)
             : thicken(model.points(), model.faces(), arguments.number("thicken"), layers);
}

Scene convert(const Scene& scene, const Arguments& arguments, const Progress& progress) {
  const std::string& name = arguments.text("mesh");
  if (scene.lattices.contains(name)) {
    return convert_lattice(scene, arguments);
  }
  const Model& model = model_in(scene, name);
  if (model.faces().empty()) {
    throw ParameterError(name + ": has no faces to make cells of");
  }
  Arguments options = arguments;
  if (arguments.flag("solid") && !arguments.has("sharp")) {
    options.set("sharp", std::string("none"));
  }
  return add_lattice(scene, options, mesh_from(model, arguments), progress);
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
      {"convert",
       "Make a lattice from a surface mesh, or write a lattice in another format",
       {{.name = "mesh",
         .type = Type::ModelOrLattice,
         .help = "a surface mesh (.obj, .off, .ply, .stl), every face of which becomes a stack of "
                 "cells; or a lattice "
                 "(.json, .ovm) or a volume mesh (.mesh, .vtk, .msh)",
         .is_required = true,
         .is_positional = true},
        {.name = "extrude",
         .type = Type::Numbers,
         .help = "direction and length dx dy dz, for a mesh",
         .count = 3},
        {.name = "thicken",
         .type = Type::Number,
         .help = "how far to grow a mesh along its normals; negative: to the other side"},
        {.name = "solid",
         .type = Type::Flag,
         .help = "make the inside of a closed mesh one cell, smooth unless --sharp says otherwise"},
        {.name = "layers",
         .type = Type::Integer,
         .help = "cells along the direction or the normals (default 1)"},
        scheme_parameter(),
        {.name = "sharp", .type = Type::Text, .help = sharp_parameter().help},
        result_parameter("the lattice, .json, .ovm, or .vtu for VTK and ParaView")},
       convert},
  };
}

}  // namespace espalier
