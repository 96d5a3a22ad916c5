/// espalier eval: where a posed lattice takes points, as CSV.

#include <fmt/format.h>

#include <cstdio>
#include <iterator>
#include <string>

#include "deform/evaluate/displace.h"
#include "deform/scene/bind.h"
#include "lattice/core/error.h"
#include "lattice/core/file.h"
#include "lattice/io/lattice_file.h"
#include "tools/command.h"
#include "tools/csv_points.h"

namespace espalier::tools {
namespace {

ExitStatus run(const Arguments& arguments, const Session& session) {
  const std::string& lattice_path = arguments.text("lattice");
  const SubdivisionLattice lattice = read_lattice(lattice_path, session.progress);
  const std::string& at = arguments.text("at");
  const std::string path = at == "-" ? "/dev/stdin" : at;
  const std::vector<glm::dvec3> points = parse_csv_points(at, read_file(path), {"x", "y", "z"});
  const Volume volume = freeze(lattice, arguments.text("freeze"), session.progress);
  const Binding binding = embed(volume, points, session.progress);
  const auto displacements = volume.displacements(lattice.posed_points());
  const auto moved = displaced_points(volume, binding, points, displacements);
  const auto gradients = deformation_gradients(volume, binding, displacements);
  std::string text = "x,y,z,status,j00,j01,j02,j10,j11,j12,j20,j21,j22\n";
  for (std::size_t i = 0; i < points.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "{:.17g},{:.17g},{:.17g},{}", moved[i].x, moved[i].y,
                   moved[i].z, name_of(binding.status[i]));
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) {
        fmt::format_to(std::back_inserter(text), ",{:.17g}", gradients[i][b][a]);
      }
    }
    text += '\n';
  }
  std::fputs(text.c_str(), stdout);
  return ExitStatus::Done;
}

}  // namespace

Command eval_command() {
  return {"eval",
          "Print where points go with a posed lattice, and the Jacobian there, as CSV",
          {{.name = "lattice",
            .type = ParameterType::Path,
            .help = "the lattice and its pose (.json, .ovm)",
            .is_required = true,
            .is_positional = true},
           {.name = "at",
            .type = ParameterType::Path,
            .help = "CSV of rest points with a header line x,y,z; - for standard input",
            .is_required = true},
           {.name = "freeze",
            .type = ParameterType::Text,
            .help = "adaptive[:TOLERANCE], or uniform:N, the lattice refined N times (default "
                    "adaptive, 1e-5 of the lattice's diagonal)",
            .fallback = Value(std::string("adaptive"))}},
          run,
          false};
}

}  // namespace espalier::tools
