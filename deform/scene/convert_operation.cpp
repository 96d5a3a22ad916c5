/// The operation that makes lattices from meshes of surfaces and volumes.

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "deform/fit/conversion.h"
#include "deform/fit/sweep.h"
#include "deform/fit/wrap.h"
#include "deform/scene/lattice_parameters.h"
#include "deform/scene/operations.h"
#include "lattice/build/extrude.h"
#include "lattice/core/error.h"

namespace espalier {
namespace {

using Type = ParameterType;

constexpr std::array kWays = {"extrude", "thicken", "solid", "wrap", "sweep"};
/// What only one of them has.
constexpr std::array kSweepOptions = {"radius", "padding", "reach", "core", "rings"};

bool has_way(const Arguments& arguments, const char* way) {
  return way == std::string("solid") ? arguments.flag(way) : arguments.has(way);
}

/// The option that chooses the way.
std::string way_of(const Arguments& arguments) {
  const auto* way = std::find_if(kWays.begin(), kWays.end(),
                                 [&](const char* name) { return has_way(arguments, name); });
  return std::string("--") + *way;
}

/// Throws ParameterError for options that another way than the chosen one has.
void refuse(const Arguments& arguments, const char* option, const char* is_for) {
  if (arguments.has(option)) {
    throw ParameterError(std::string("'") + option + "' is for " + is_for);
  }
}

/// The scene with what there is to tell about its lattice "output" and a model.
Scene with_conversion(Scene scene, const Arguments& arguments, Conversion conversion) {
  scene.conversions.insert_or_assign(arguments.text("output"), std::move(conversion));
  return scene;
}

/// The same with the points of "model" counted, or else of the mesh itself, if it is one.
Scene with_count(Scene scene, const Arguments& arguments, const Progress& progress) {
  const std::string& name = arguments.text(arguments.has("model") ? "model" : "mesh");
  const auto* lattice = lattice_in(scene, arguments.text("output")).as<SubdivisionLattice>();
  Conversion conversion;
  if (lattice != nullptr && scene.models.contains(name)) {
    conversion = measured(*lattice, model_in(scene, name), progress);
  }
  return with_conversion(std::move(scene), arguments, std::move(conversion));
}

/// A lattice converts to itself: what changes is its file. Its tags stay.
Scene convert_lattice(const Scene& scene, const Arguments& arguments, const Progress& progress) {
  for (const char* option : {"extrude", "thicken", "solid", "wrap", "sweep", "layers", "sharp"}) {
    refuse(arguments, option, "surface meshes, not for lattices");
  }
  const std::string& name = arguments.text("mesh");
  const std::string& output = arguments.text("output");
  if (!arguments.has("scheme")) {
    return with_count(with_lattice(scene, output, lattice_in(scene, name)), arguments, progress);
  }
  SubdivisionLattice lattice = subdivision_lattice_in(scene, name, "--scheme");
  lattice.scheme = scheme_of(arguments, lattice.scheme);
  return with_count(with_lattice(scene, output, std::move(lattice)), arguments, progress);
}

/// Cells between copies of the mesh, or the one cell inside it.
CellMesh mesh_from(const Model& model, const Arguments& arguments) {
  if (arguments.flag("solid")) {
    refuse(arguments, "layers", "--extrude, --thicken and --sweep");
    return solid(model.points(), model.faces());
  }
  const int layers = arguments.has("layers") ? arguments.integer("layers") : 1;
  return arguments.has("extrude")
             ? extrude(model.points(), model.faces(), arguments.vector("extrude"), layers)
             : thicken(model.points(), model.faces(), arguments.number("thicken"), layers);
}

Scene wrap_model(const Scene& scene, const Arguments& arguments, const Model& model,
                 const Progress& progress) {
  refuse(arguments, "layers", "--extrude, --thicken and --sweep");
  Wrap wrapped = wrap(model, arguments.integer("wrap"), progress);
  const std::size_t n = model.points().size();
  Scene result = add_lattice(scene, arguments, std::move(wrapped.lattice));
  if (arguments.has("model")) {
    result = with_count(std::move(result), arguments, progress);
    Conversion& counted = result.conversions.at(arguments.text("output"));
    counted.shared = std::move(wrapped.shared);
    counted.cells_to_part = wrapped.cells_to_part;
    return result;
  }
  return with_conversion(std::move(result), arguments,
                         {n, n, std::move(wrapped.shared), wrapped.cells_to_part});
}

Scene sweep_path(const Scene& scene, const Arguments& arguments, const Model& model,
                 const Progress& progress) {
  const Model& path = model_in(scene, arguments.text("sweep"));
  SweepOptions options;
  for (const auto& [name, number] : {std::pair{"radius", &options.radius},
                                     {"padding", &options.padding},
                                     {"reach", &options.reach}}) {
    *number = arguments.has(name) ? arguments.number(name) : *number;
  }
  for (const auto& [name, count] :
       {std::pair{"core", &options.core}, {"rings", &options.rings}, {"layers", &options.layers}}) {
    *count = arguments.has(name) ? arguments.integer(name) : *count;
  }
  if (arguments.has("radius") && options.radius <= 0) {
    throw ParameterError("'radius' must be positive");
  }
  CellMesh mesh = sweep(path.points(), polylines_of(path), model.points(), options);
  return with_count(add_lattice(scene, arguments, std::move(mesh), progress,
                                path.path() + ": " + way_of(arguments)),
                    arguments, progress);
}

Scene convert_model(const Scene& scene, const Arguments& arguments, const Model& model,
                    const Progress& progress) {
  const auto n_ways = std::count_if(kWays.begin(), kWays.end(),
                                    [&](const char* way) { return has_way(arguments, way); });
  if (n_ways != 1) {
    throw ParameterError(n_ways == 0 ? "'extrude' is missing: direction and length dx dy dz; or "
                                       "--thicken, --solid, --wrap or --sweep"
                                     : "'extrude', --thicken, --solid, --wrap and --sweep exclude "
                                       "each other");
  }
  if (arguments.has("sweep")) {
    return sweep_path(scene, arguments, model, progress);
  }
  for (const char* option : kSweepOptions) {
    refuse(arguments, option, "--sweep");
  }
  if (arguments.has("wrap")) {
    return wrap_model(scene, arguments, model, progress);
  }
  if (model.faces().empty()) {
    throw ParameterError(model.path() + ": has no faces to make cells of");
  }
  Arguments options = arguments;
  if (arguments.flag("solid") && !arguments.has("sharp")) {
    options.set("sharp", std::string("none"));
  }
  CellMesh mesh = mesh_from(model, arguments);
  return with_count(add_lattice(scene, options, std::move(mesh), progress,
                                model.path() + ": " + way_of(arguments)),
                    arguments, progress);
}

Scene convert(const Scene& scene, const Arguments& arguments, const Progress& progress) {
  const std::string& name = arguments.text("mesh");
  return scene.lattices.contains(name)
             ? convert_lattice(scene, arguments, progress)
             : convert_model(scene, arguments, model_in(scene, name), progress);
}

}  // namespace

std::vector<Operation> convert_operations() {
  return {
      {"convert",
       "Make a lattice from a surface mesh, or write a lattice in another format",
       {{.name = "mesh",
         .type = Type::ModelOrLattice,
         .help = "a surface mesh (.obj, .off, .ply, .stl); or a lattice (.json, .ovm) or a volume "
                 "mesh (.mesh, .vtk, .msh)",
         .is_required = true,
         .is_positional = true},
        {.name = "extrude",
         .type = Type::Numbers,
         .help = "every face becomes a stack of cells: direction and length dx dy dz",
         .count = 3},
        {.name = "thicken",
         .type = Type::Number,
         .help = "the same along the normals: how far; negative: to the other side"},
        {.name = "solid",
         .type = Type::Flag,
         .help = "make the inside of a closed mesh one cell, smooth unless --sharp says otherwise"},
        {.name = "wrap",
         .type = Type::Integer,
         .help = "the cells of a grid that the mesh touches or encloses, drawn round it: how many "
                 "along its longest side, 1 to 128"},
        {.name = "sweep",
         .type = Type::Model,
         .help =
             "a round bar along a path, the lines of an OBJ file, as wide as the mesh is there"},
        {.name = "layers",
         .type = Type::Integer,
         .help = "cells along the direction or the normals (default 1), or along each piece of the "
                 "path (default: about as long as wide)"},
        {.name = "radius",
         .type = Type::Number,
         .help = "of a sweep, instead of the mesh's, model units"},
        {.name = "padding",
         .type = Type::Number,
         .help = "added to a sweep's radius by the mesh, as a fraction of it (default 0.05)"},
        {.name = "reach",
         .type = Type::Number,
         .help = "points of the mesh farther from the path do not count, model units (default: all "
                 "do)"},
        {.name = "core",
         .type = Type::Integer,
         .help = "cells across a sweep's middle (default 2)"},
        {.name = "rings",
         .type = Type::Integer,
         .help = "cells from a sweep's middle to its side (default 1)"},
        {.name = "model",
         .type = Type::Model,
         .help = "whose share inside the lattice is told (default: the mesh itself)"},
        scheme_parameter(),
        {.name = "sharp", .type = Type::Text, .help = sharp_parameter().help},
        result_parameter("the lattice, .json, .ovm, or .vtu for VTK and ParaView")},
       convert},
  };
}

}  // namespace espalier
