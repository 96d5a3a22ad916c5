/// Operations that refine lattices of all types, and models.

#include <fmt/format.h>

#include <cmath>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "deform/embed/thb_region.h"
#include "deform/model/point_selection.h"
#include "deform/model/surface_model.h"
#include "deform/scene/lattice_parameters.h"
#include "deform/scene/operations.h"
#include "lattice/core/error.h"
#include "lattice/subdivision/refine.h"

namespace espalier {
namespace {

using Type = ParameterType;

constexpr int kMostLevels = 8;
constexpr double kMostControlsMade = 1 << 22;  // a gigabyte
constexpr double kMostCellsMade = 1 << 20;     // seconds

void require_absent(const Arguments& arguments, std::initializer_list<const char*> names,
                    const std::string& reason) {
  for (const char* name : names) {
    if (arguments.has(name) && (std::string(name) != "elevate" || arguments.flag(name))) {
      throw ParameterError("'" + std::string(name) + "' is for " + reason);
    }
  }
}

int levels_of(const Arguments& arguments) {
  const int levels = arguments.has("levels") ? arguments.integer("levels") : 1;
  if (levels < 1 || levels > kMostLevels) {
    throw ParameterError("'levels' must be 1 to " + std::to_string(kMostLevels));
  }
  return levels;
}

/// Refuses before anything grows. n: cells, or control points.
void require_refinable(double n, double most, const char* what) {
  if (n > most) {
    throw ParameterError(
        fmt::format("'levels' would make {:.0f} {}, at most {:.0f} are made: refine "
                    "fewer times, or where it matters",
                    n, what, most));
  }
}

/// Each refinement puts a knot into every span.
double n_controls_after(const TensorLattice& lattice, int levels) {
  double n = 1;
  for (const TensorAxis& axis : lattice.axes) {
    const double n_added = static_cast<double>(axis.spans().size()) * (std::ldexp(1.0, levels) - 1);
    n *= axis.n_controls() + (axis.degree() > 0 ? n_added : 0);
  }
  return n;
}

Lattice refined_by(const SubdivisionLattice& lattice, const Scene&, const Arguments& arguments,
                   const Progress& progress) {
  require_absent(arguments, {"box", "model", "only", "grow", "level"}, "thb lattices");
  require_absent(arguments, {"elevate"}, "bezier, bspline and nurbs lattices");
  SubdivisionLattice source = lattice;
  source.scheme = scheme_of(arguments, lattice.scheme);
  return refined(source, levels_of(arguments), progress);
}

Lattice refined_by(const TensorLattice& lattice, const Scene&, const Arguments& arguments,
                   const Progress&) {
  require_absent(arguments, {"scheme"}, "subdivision lattices");
  require_absent(arguments, {"box", "model", "only", "grow", "level"}, "thb lattices");
  TensorLattice result = lattice;
  if (!arguments.flag("elevate")) {
    require_refinable(n_controls_after(lattice, levels_of(arguments)), kMostControlsMade,
                      "control points");
    for (int level = levels_of(arguments); level > 0; --level) {
      result = refined(result);
    }
    return result;
  }
  require_absent(arguments, {"levels"}, "refining, --elevate raises the degree by one");
  for (int axis = 0; axis < 3; ++axis) {
    if (lattice.axes[static_cast<std::size_t>(axis)].n_controls() > 1) {
      result = elevated(result, axis);
    }
  }
  return result;
}

/// Every leaf made eight.
ThbLattice refined_everywhere(ThbLattice lattice) {
  std::vector<std::vector<GridIndex>> cells(
      static_cast<std::size_t>(lattice.hierarchy->n_levels()));
  for (const ThbCell& leaf : lattice.hierarchy->leaves()) {
    cells[static_cast<std::size_t>(leaf.level)].push_back(leaf.index);
  }
  for (std::size_t level = 0; level < cells.size(); ++level) {
    if (!cells[level].empty()) {
      lattice = with_cells(lattice, static_cast<int>(level) + 1, cells[level]);
    }
  }
  return lattice;
}

/// Where the selected points of a model are.
Lattice refined_under_model(const ThbLattice& lattice, const Model& model,
                            const Arguments& arguments, int level, const Progress& progress) {
  const std::vector<std::string> only = arguments.texts("only");
  const std::vector<glm::dvec3> points = selected_points(model, only);
  const int n_rings = arguments.has("grow") ? arguments.integer("grow") : 0;
  try {
    return refined_under(lattice, points, level, n_rings, progress);
  } catch (const ParameterError& error) {
    throw ParameterError("'model', --level and --grow: " + std::string(error.what()));
  }
}

Lattice refined_by(const ThbLattice& lattice, const Scene& scene, const Arguments& arguments,
                   const Progress& progress) {
  require_absent(arguments, {"scheme"}, "subdivision lattices");
  require_absent(arguments, {"elevate"}, "bezier, bspline and nurbs lattices");
  if (!arguments.has("model")) {
    require_absent(arguments, {"only", "grow"}, "a --model");
  }
  const int level = arguments.has("level") ? arguments.integer("level") : 1;
  if (arguments.has("model")) {
    require_absent(arguments, {"levels", "box"}, "other ways than under a --model");
    return refined_under_model(lattice, model_in(scene, arguments.text("model")), arguments, level,
                               progress);
  }
  if (arguments.has("box")) {
    require_absent(arguments, {"levels"}, "refining everywhere, --level says how finely a box is");
    const std::vector<double> box = arguments.numbers("box");
    return with_cells(lattice, level,
                      cells_of_box(*lattice.hierarchy, level, {box[0], box[1], box[2]},
                                   {box[3], box[4], box[5]}));
  }
  require_absent(arguments, {"level"}, "a --box or a --model");
  require_refinable(
      static_cast<double>(lattice.hierarchy->leaves().size()) * std::pow(8.0, levels_of(arguments)),
      kMostCellsMade, "cells");
  ThbLattice result = lattice;
  for (int left = levels_of(arguments); left > 0; --left) {
    result = refined_everywhere(std::move(result));
  }
  return result;
}

Scene refine_object(const Scene& scene, const Arguments& arguments, const Progress& progress) {
  const std::string& name = arguments.text("input");
  const std::string& output = arguments.text("output");
  if (scene.models.contains(name)) {
    require_absent(arguments, {"scheme"},
                   "lattices; a model is refined as a Catmull-Clark surface");
    require_absent(arguments, {"elevate", "box", "model", "only", "grow", "level"}, "lattices");
    return with_model(scene, output,
                      refined_model(model_in(scene, name), levels_of(arguments), output));
  }
  return with_lattice(scene, output, lattice_in(scene, name).visit([&](const auto& lattice) {
    return refined_by(lattice, scene, arguments, progress);
  }));
}

}  // namespace

std::vector<Operation> refine_operations() {
  return {
      {"refine",
       "Refine a lattice, which changes nothing but its control points, or a model",
       {{.name = "input",
         .type = Type::ModelOrLattice,
         .help = "a lattice (.json, .ovm), or a model (.obj, .off, .ply, .stl), which is refined "
                 "as a Catmull-Clark surface",
         .is_required = true,
         .is_positional = true},
        {.name = "levels",
         .type = Type::Integer,
         .help = "how often: subdivided, or every span of knots or every cell of a thb lattice "
                 "halved (default 1)"},
        {.name = "scheme",
         .type = Type::Choice,
         .help = "of a subdivision lattice: rules at extraordinary lines (default: its own)",
         .choices = scheme_names()},
        {.name = "elevate",
         .type = Type::Flag,
         .help = "of a bezier, bspline or nurbs lattice: raise the degree by one instead"},
        {.name = "box",
         .type = Type::Numbers,
         .help = "of a thb lattice: only this box u0 v0 w0 u1 v1 w1 of [0,1]^3, along its cells",
         .count = 6},
        {.name = "model",
         .type = Type::Model,
         .help = "of a thb lattice: only the cells that hold points of this model at rest"},
        {.name = "only",
         .type = Type::Text,
         .help = "of --model: only the points of this group or object, or @FILE: of these indices; "
                 "may repeat (default: all points)",
         .is_list = true},
        {.name = "grow",
         .type = Type::Integer,
         .help = "of --model: so many rings of cells more on every level (default 0)"},
        {.name = "level",
         .type = Type::Integer,
         .help = "what the box, or up to what the model's cells are refined to, from cells of the "
                 "level before (default 1)"},
        result_parameter("the refined lattice, or model (.obj)")},
       refine_object},
  };
}

}  // namespace espalier
