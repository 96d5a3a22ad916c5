/// espalier info: what a file holds, and whether a lattice is valid.

#include <cstdio>
#include <string>

#include "deform/model/model_file.h"
#include "deform/scene/lattice_parameters.h"
#include "lattice/core/error.h"
#include "lattice/io/lattice.h"
#include "lattice/topology/validate.h"
#include "tools/command.h"
#include "tools/influence_report.h"
#include "tools/report.h"

namespace espalier::tools {
namespace {

void print(const std::string& report, const Session& session) {
  if (!session.is_quiet) {
    std::fputs(report.c_str(), stdout);
  }
}

/// What a valid lattice holds, and with --model what it does to the model.
std::string report_of(const Lattice& lattice, const Arguments& arguments, const Session& session) {
  if (!arguments.has("model")) {
    return lattice_report(lattice, session.is_json);
  }
  const ModelInfluence influence = influence_on(read_model(arguments.text("model")), lattice,
                                                arguments.text("freeze"), session.progress);
  return lattice_report(lattice, influence, session.is_json);
}

ExitStatus run(const Arguments& arguments, const Session& session) {
  const std::string& path = arguments.text("file");
  if (!is_lattice_path(path)) {
    if (arguments.has("model")) {
      throw ParameterError("'model' is for lattices, " + path + " is a model");
    }
    print(model_report(read_model(path), session.is_json), session);
    return ExitStatus::Done;
  }
  std::variant<RawLattice, Lattice> parts = read_lattice_parts(path);
  if (const auto* lattice = std::get_if<Lattice>(&parts)) {
    print(report_of(*lattice, arguments, session), session);
    return ExitStatus::Done;
  }
  LatticeReport report{std::get<RawLattice>(std::move(parts)), {}};
  report.defects = validate(report.raw.polyhedra, report.raw.rest, session.progress);
  if (report.defects.empty() && arguments.has("model")) {
    print(
        report_of(build_lattice(std::move(report.raw), path, session.progress), arguments, session),
        session);
    return ExitStatus::Done;
  }
  print(lattice_report(report, session.is_json), session);
  return report.defects.empty() ? ExitStatus::Done : ExitStatus::Failed;
}

}  // namespace

Command info_command() {
  return {"info",
          "Tell what a lattice or model file holds, and what is wrong with it",
          {{.name = "file",
            .type = ParameterType::Path,
            .help = "a lattice (.json, .ovm) or a model (.obj, .off, .ply, .stl)",
            .is_required = true,
            .is_positional = true},
           {.name = "model",
            .type = ParameterType::Path,
            .help = "tell too how many points of this model control points move, by level"},
           freeze_parameter()},
          run};
}

}  // namespace espalier::tools
