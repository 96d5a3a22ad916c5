#pragma once

/// How many points of a model control points move, by level, as reports. A header for sources of
/// this folder that use JSON.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "deform/embed/embed.h"
#include "deform/model/model.h"
#include "lattice/core/progress.h"
#include "lattice/io/lattice.h"

namespace espalier::tools {

/// What control points do to a model.
struct ModelInfluence {
  StatusCounts counts;                 ///< of its points
  std::vector<LevelInfluence> levels;  ///< one for lattices without levels
};

[[nodiscard]] ModelInfluence influence_on(const Model& model, const Lattice& lattice,
                                          const std::string& freeze, const Progress& progress);

/// A line a level.
[[nodiscard]] std::string influence_text(const std::vector<LevelInfluence>& levels);

/// An object a level, as a list in json[key]; nothing without levels.
void add_influence(const std::vector<LevelInfluence>& levels, const std::string& key,
                   nlohmann::ordered_json& json);

}  // namespace espalier::tools
