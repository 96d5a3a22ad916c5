/// espalier info: what a file holds, and whether a lattice is valid.

#include <cstdio>
#include <string>

#include "deform/model/model_file.h"
#include "lattice/io/lattice.h"
#include "lattice/topology/validate.h"
#include "tools/command.h"
#include "tools/report.h"

namespace espalier::tools {
namespace {

void print(const std::string& report, const Session& session) {
  if (!session.is_quiet) {
    std::fputs(report.c_str(), stdout);
  }
}

ExitStatus run(const Arguments& arguments, const Session& session) {
  const std::string& path = arguments.text("file");
  if (!is_lattice_path(path)) {
    print(model_report(read_model(path), session.is_json), session);
    return ExitStatus::Done;
  }
  std::variant<RawLattice, Lattice> parts = read_lattice_parts(path);
  if (const auto* lattice = std::get_if<Lattice>(&parts)) {
    print(lattice_report(*lattice, session.is_json), session);
    return ExitStatus::Done;
  }
  LatticeReport report{std::get<RawLattice>(std::move(parts)), {}};
  report.defects = validate(report.raw.polyhedra, report.raw.rest, session.progress);
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
            .is_positional = true}},
          run};
}

}  // namespace espalier::tools
