#include "tools/influence_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "deform/evaluate/weights.h"
#include "deform/scene/bind.h"

namespace espalier::tools {
namespace {

/// Of all control points together.
LevelInfluence total_influence(const StencilTable& weights) {
  std::vector<std::size_t> n_points(weights.n_controls(), 0);
  for (std::size_t row = 0; row < weights.n_rows(); ++row) {
    for (const std::int32_t control : weights[row].indices) {
      ++n_points[static_cast<std::size_t>(control)];
    }
  }
  const auto n_without = std::count(n_points.begin(), n_points.end(), 0u);
  return {n_points.size(),
          static_cast<double>(weights.n_weights()) / static_cast<double>(n_points.size()),
          static_cast<std::size_t>(n_without)};
}

}  // namespace

ModelInfluence influence_on(const Model& model, const Lattice& lattice, const std::string& freeze,
                            const Progress& progress) {
  const Volume volume = espalier::freeze(lattice, freeze, progress);
  const Binding binding = embed(volume, model.points(), progress);
  const StencilTable weights = control_weights(volume, binding);
  const auto* thb = lattice.as<ThbLattice>();
  return {binding.counts(), thb != nullptr ? level_influences(*thb->hierarchy, weights)
                                           : std::vector<LevelInfluence>{total_influence(weights)}};
}

std::string influence_text(const std::vector<LevelInfluence>& levels) {
  std::string text;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    text +=
        fmt::format("  level {}: {} control points, one moves {:.6g} points on average, {} none\n",
                    i, levels[i].n_controls, levels[i].mean_points, levels[i].n_without);
  }
  return text;
}

void add_influence(const std::vector<LevelInfluence>& levels, const std::string& key,
                   nlohmann::ordered_json& json) {
  for (const LevelInfluence& level : levels) {
    json[key].push_back({{"control_points", level.n_controls},
                         {"mean_points", level.mean_points},
                         {"without_points", level.n_without}});
  }
}

}  // namespace espalier::tools
