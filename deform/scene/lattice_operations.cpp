/// Operations that make subdivision lattices from meshes.

#include <utility>

#include "deform/scene/lattice_parameters.h"
#include "deform/scene/operations.h"
#include "lattice/build/extrude.h"
#include "lattice/core/error.h"

namespace espalier {
namespace {

using Type = ParameterType;

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
  return {
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
