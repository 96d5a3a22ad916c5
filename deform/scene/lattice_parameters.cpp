#include "deform/scene/lattice_parameters.h"

#include <utility>

#include "deform/scene/bind.h"
#include "lattice/core/error.h"
#include "lattice/core/text_scanner.h"
#include "lattice/io/lattice_file.h"

namespace espalier {
namespace {

using Type = ParameterType;

/// Tags by "auto", "none" or "angle:DEGREES".
Sharpness sharpness_of(const SubdivisionLattice& lattice, const std::string& word) {
  static const std::string kAngle = "angle:";
  double degrees = 0;
  if (word == "auto") {
    return automatic_sharpness(*lattice.complex);
  }
  if (word == "none") {
    return smooth_sharpness(*lattice.complex);
  }
  if (!word.starts_with(kAngle) ||
      !parse_number(std::string_view(word).substr(kAngle.size()), degrees) ||
      !(degrees >= 0 && degrees <= 180)) {
    throw ParameterError("'sharp' is '" + word +
                         "', must be auto, none or angle:DEGREES from 0 to 180");
  }
  return sharpness_by_angle(*lattice.complex, lattice.rest, degrees);
}

}  // namespace

const std::vector<std::string>& scheme_names() {
  static const std::vector<std::string> kSchemes = {"catmull-clark", "mj96"};
  return kSchemes;
}

Parameter result_parameter(const char* help) {
  return {.name = "output", .type = Type::Result, .help = help, .is_required = true};
}

Parameter scheme_parameter() {
  return {.name = "scheme",
          .type = Type::Choice,
          .help = "rules at extraordinary lines (default catmull-clark)",
          .choices = scheme_names()};
}

Scheme scheme_of(const Arguments& arguments, Scheme fallback) {
  return arguments.has("scheme") ? *scheme_named(arguments.text("scheme")) : fallback;
}

Parameter sharp_parameter() {
  return {.name = "sharp",
          .type = Type::Text,
          .help = "creases: auto, none, or angle:DEGREES for edges that bend more (default auto)",
          .fallback = Value(std::string("auto"))};
}

Parameter freeze_parameter() {
  return {.name = "freeze",
          .type = Type::Text,
          .help =
              "how the volume is frozen: adaptive[:TOLERANCE[:TOLERANCE_OF_DERIVATIVES]], or "
              "uniform:N, the lattice refined N times (default adaptive, 1e-5 of the lattice's "
              "diagonal)",
          .fallback = Value(BindOptions().freeze)};
}

Scene add_lattice(const Scene& scene, const Arguments& arguments, CellMesh mesh,
                  const Progress& progress, const std::string& source) {
  RawLattice raw;
  raw.polyhedra = std::move(mesh.cells);
  raw.rest = std::move(mesh.points);
  const std::string& blamed = source.empty() ? arguments.text("output") : source;
  return add_lattice(scene, arguments, build_lattice(std::move(raw), blamed, progress));
}

Scene add_lattice(const Scene& scene, const Arguments& arguments, SubdivisionLattice lattice) {
  lattice.scheme = scheme_of(arguments, lattice.scheme);
  if (arguments.has("sharp")) {
    lattice.sharpness = sharpness_of(lattice, arguments.text("sharp"));
  }
  return with_lattice(scene, arguments.text("output"), std::move(lattice));
}

}  // namespace espalier
