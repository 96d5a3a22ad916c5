/// espalier weights: how a model's points depend on the control points, as a sparse matrix.

#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "deform/evaluate/weights.h"
#include "deform/model/model_file.h"
#include "deform/scene/bind.h"
#include "deform/scene/lattice_parameters.h"
#include "lattice/core/file.h"
#include "lattice/io/lattice.h"
#include "lattice/io/matrix_market.h"
#include "tools/command.h"
#include "tools/influence_report.h"

namespace espalier::tools {
namespace {

constexpr const char* kComment =
    "W of x' = x + W (P - P_rest): a row a model point, a column a control point, empty rows "
    "outside";

using Json = nlohmann::ordered_json;

std::string report(const std::string& path, const StencilTable& weights, const StatusCounts& counts,
                   const std::vector<LevelInfluence>& levels, bool is_json) {
  if (!is_json) {
    return fmt::format(
               "{}: {} points x {} control points, {} weights\n"
               "  {} inside, {} on the border, {} outside, {} unconverged\n",
               path, weights.n_rows(), weights.n_controls(), weights.n_weights(), counts.inside,
               counts.border, counts.outside, counts.unconverged) +
           influence_text(levels);
  }
  Json json = {{"rows", weights.n_rows()},       {"columns", weights.n_controls()},
               {"weights", weights.n_weights()}, {"output", path},
               {"inside", counts.inside},        {"border", counts.border},
               {"outside", counts.outside},      {"unconverged", counts.unconverged}};
  add_influence(levels, "levels", json);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

ExitStatus run(const Arguments& arguments, const Session& session) {
  const Model model = read_model(arguments.text("model"));
  const Lattice lattice = read_any_lattice(arguments.text("lattice"), session.progress);
  const Volume volume = freeze(lattice, arguments.text("freeze"), session.progress);
  const Binding binding = embed(volume, model.points(), session.progress);
  const StencilTable weights = control_weights(volume, binding);
  const std::string& path = arguments.text("output");
  write_file(path, matrix_market_text(weights, kComment));
  if (!session.is_quiet && path != "/dev/stdout") {
    const auto* thb = lattice.as<ThbLattice>();
    const auto levels =
        thb != nullptr ? level_influences(*thb->hierarchy, weights) : std::vector<LevelInfluence>();
    std::fputs(report(path, weights, binding.counts(), levels, session.is_json).c_str(), stdout);
  }
  return ExitStatus::Done;
}

}  // namespace

Command weights_command() {
  return {"weights",
          "Write how a model's points depend on the control points, as a sparse matrix",
          {{.name = "model",
            .type = ParameterType::Path,
            .help = "the model (.obj, .off, .ply, .stl)",
            .is_required = true,
            .is_positional = true},
           {.name = "lattice",
            .type = ParameterType::Path,
            .help = "the lattice at rest (.json, .ovm)",
            .is_required = true},
           freeze_parameter(),
           {.name = "output",
            .type = ParameterType::Path,
            .help = "the matrix as MatrixMarket (.mtx), rows and columns from 1",
            .is_required = true}},
          run};
}

}  // namespace espalier::tools
