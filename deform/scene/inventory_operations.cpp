/// Operations that make lattices of the inventory.

#include <cmath>
#include <utility>

#include "deform/scene/lattice_parameters.h"
#include "deform/scene/operations.h"
#include "lattice/build/inventory.h"
#include "lattice/build/junction.h"
#include "lattice/core/error.h"
#include "lattice/core/text_scanner.h"

namespace espalier {
namespace {

using Type = ParameterType;

Parameter point(const char* name, const char* help, std::vector<double> fallback) {
  return {.name = name,
          .type = Type::Numbers,
          .help = help,
          .count = 3,
          .fallback = Value(std::move(fallback))};
}

Parameter number(const char* name, const char* help, double fallback) {
  return {.name = name, .type = Type::Number, .help = help, .fallback = Value(fallback)};
}

Parameter count(const char* name, const char* help, int fallback) {
  return {
      .name = name, .type = Type::Integer, .help = help, .fallback = Value(std::int64_t{fallback})};
}

/// An operation that adds the lattice that `make` makes, with the parameters all of them have.
template <class Make>
Operation making(const char* name, const char* summary, std::vector<Parameter> parameters,
                 const Make& make) {
  parameters.push_back(scheme_parameter());
  parameters.push_back(sharp_parameter());
  parameters.push_back(result_parameter("the lattice, .json or .ovm"));
  return {name, summary, std::move(parameters),
          [make](const Scene& scene, const Arguments& arguments, const Progress& progress) {
            return add_lattice(scene, arguments, make(arguments), progress);
          }};
}

CellMesh new_o_grid(const Arguments& arguments) {
  OGridOptions options;
  options.from = arguments.vector("from");
  options.to = arguments.vector("to");
  options.radius = arguments.number("radius");
  options.end_radius =
      arguments.has("end-radius") ? arguments.number("end-radius") : options.radius;
  options.core = arguments.integer("core");
  options.rings = arguments.integer("rings");
  options.layers = arguments.integer("layers");
  if (options.end_radius == 0) {
    throw ParameterError("'end-radius' must be positive: cells cannot end in a point");
  }
  return make_o_grid(options);
}

CellMesh new_annulus(const Arguments& arguments) {
  AnnulusOptions options;
  options.from = arguments.vector("from");
  options.to = arguments.vector("to");
  options.radius = arguments.number("radius");
  options.inner_radius = arguments.number("inner-radius");
  options.sectors = arguments.integer("sectors");
  options.rings = arguments.integer("rings");
  options.layers = arguments.integer("layers");
  return make_annulus(options);
}

CellMesh new_torus(const Arguments& arguments) {
  TorusOptions options;
  options.center = arguments.vector("center");
  options.axis = arguments.vector("axis");
  options.radius = arguments.number("radius");
  options.tube_radius = arguments.number("tube-radius");
  options.sectors = arguments.integer("sectors");
  options.segments = arguments.integer("segments");
  return make_torus(options);
}

CellMesh new_star(const Arguments& arguments) {
  StarOptions options;
  options.from = arguments.vector("from");
  options.to = arguments.vector("to");
  options.radius = arguments.number("radius");
  options.inner_radius = arguments.number("inner-radius");
  options.tips = arguments.integer("tips");
  options.layers = arguments.integer("layers");
  return make_star(options);
}

CellMesh new_barbell(const Arguments& arguments) {
  BarbellOptions options;
  options.from = arguments.vector("from");
  options.to = arguments.vector("to");
  options.by = arguments.vector("by");
  options.radius = arguments.number("radius");
  options.bar_radius = arguments.number("bar-radius");
  options.cells = arguments.integer("cells");
  options.layers = arguments.integer("layers");
  return make_barbell(options);
}

CellMesh new_sphere(const Arguments& arguments) {
  SphereOptions options;
  options.center = arguments.vector("center");
  options.radius = arguments.number("radius");
  options.cells = arguments.integer("cells");
  options.rings = arguments.integer("rings");
  return make_sphere(options);
}

CellMesh new_junction(const Arguments& arguments) {
  JunctionOptions options;
  options.center = arguments.vector("center");
  options.radius = arguments.number("radius");
  options.layers = arguments.integer("layers");
  const double length = arguments.number("length");
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
  return make_junction(options);
}

/// The numbers of "x,y,z" or "x,y,z,r".
std::vector<double> numbers_of(const std::string& word) {
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= word.size();) {
    const std::size_t end = std::min(word.find(',', begin), word.size());
    if (!parse_number(std::string_view(word).substr(begin, end - begin), numbers.emplace_back())) {
      return {};
    }
    begin = end + 1;
  }
  return numbers;
}

CellMesh new_limb(const Arguments& arguments) {
  LimbOptions options;
  options.sectors = arguments.integer("sectors");
  options.layers = arguments.integer("layers");
  for (const std::string& word : arguments.texts("joint")) {
    const std::vector<double> numbers = numbers_of(word);
    if (numbers.size() != 3 && numbers.size() != 4) {
      throw ParameterError("'joint' is " + quoted(word) + ", must be x,y,z or x,y,z,radius");
    }
    options.joints.emplace_back(numbers[0], numbers[1], numbers[2]);
    options.radii.push_back(numbers.size() == 4 ? numbers[3] : arguments.number("radius"));
  }
  return make_limb(options);
}

std::vector<Operation> round_operations() {
  const Parameter from = point("from", "centre of the first end (default 0 0 0)", {0, 0, 0});
  const Parameter to = point("to", "centre of the second end (default 0 1 0)", {0, 1, 0});
  const Parameter center = point("center", "its middle (default 0 0 0)", {0, 0, 0});
  const Parameter radius = number("radius", "of the space it fills (default 0.5)", 0.5);
  const Parameter layers = count("layers", "cells along the axis (default 4)", 4);
  return {
      making("new ogrid", "Make a round bar of hexahedra, a square in rings",
             {from,
              to,
              radius,
              {.name = "end-radius",
               .type = Type::Number,
               .help = "at the second end (default: the same)"},
              count("core", "cells across the square (default 2)", 2),
              count("rings", "cells from the square to the side (default 1)", 1),
              layers},
             new_o_grid),
      making("new annulus", "Make a pipe of hexahedra",
             {from, to, radius, number("inner-radius", "of the hole (default 0.25)", 0.25),
              count("sectors", "cells round the axis (default 8)", 8),
              count("rings", "cells from the hole to the side (default 1)", 1), layers},
             new_annulus),
      making("new torus", "Make a closed ring of wedges",
             {center, point("axis", "across the ring (default 0 1 0)", {0, 1, 0}),
              number("radius", "of the circle in the tube's middle (default 1)", 1),
              number("tube-radius", "of the space round it (default 0.25)", 0.25),
              count("sectors", "wedges round the tube (default 8)", 8),
              count("segments", "cells along the ring (default 12)", 12)},
             new_torus),
      making("new sphere", "Make a ball of hexahedra, a cube in shells",
             {center, radius, count("cells", "across the cube (default 2)", 2),
              count("rings", "shells (default 1)", 1)},
             new_sphere),
  };
}

std::vector<Operation> outline_operations() {
  return {
      making("new star", "Make a star, extruded",
             {point("from", "centre of the first side (default 0 0 0)", {0, 0, 0}),
              point("to", "centre of the second side (default 0 0 1)", {0, 0, 1}),
              number("radius", "of its tips (default 1)", 1),
              number("inner-radius", "between them (default 0.5)", 0.5),
              count("tips", "how many (default 5)", 5),
              count("layers", "cells from side to side (default 1)", 1)},
             new_star),
      making("new barbell", "Make two disks joined by a bar, extruded",
             {point("from", "middle of the first disk (default -1 0 0)", {-1, 0, 0}),
              point("to", "middle of the second disk (default 1 0 0)", {1, 0, 0}),
              point("by", "extrusion dx dy dz (default 0 0 1)", {0, 0, 1}),
              number("radius", "of the disks (default 0.5)", 0.5),
              number("bar-radius", "half the bar's width (default 0.15)", 0.15),
              count("cells", "along the bar (default 4)", 4),
              count("layers", "cells along the extrusion (default 1)", 1)},
             new_barbell),
  };
}

std::vector<Operation> limb_operations() {
  return {
      making("new junction", "Make round bars that meet in an L, T or Y, in the x-y plane",
             {{.name = "kind",
               .type = Type::Choice,
               .help = "the letter (default T)",
               .choices = {"L", "T", "Y"},
               .fallback = Value(std::string("T"))},
              point("center", "where they meet (default 0 0 0)", {0, 0, 0}),
              number("radius", "of the space round each (default 0.25)", 0.25),
              number("length", "of each from the centre (default 1)", 1),
              count("layers", "cells along each (default 3)", 3)},
             new_junction),
      making("new limb", "Make wedges along a chain of joints",
             {{.name = "joint",
               .type = Type::Text,
               .help = "x,y,z or x,y,z,radius; two or more, in order",
               .is_required = true,
               .is_list = true},
              number("radius", "of the space round joints without their own (default 0.1)", 0.1),
              count("sectors", "wedges round the bones (default 8)", 8),
              count("layers", "cells along each bone (default 3)", 3)},
             new_limb),
  };
}

}  // namespace

std::vector<Operation> inventory_operations() {
  std::vector<Operation> operations;
  for (auto part : {round_operations(), outline_operations(), limb_operations()}) {
    std::move(part.begin(), part.end(), std::back_inserter(operations));
  }
  return operations;
}

}  // namespace espalier
