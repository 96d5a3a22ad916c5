#pragma once

/// What commands tell about models and lattices, as text for people or JSON for programs.

#include <string>
#include <vector>

#include "deform/model/model.h"
#include "deform/scene/scene.h"
#include "lattice/io/lattice.h"
#include "lattice/topology/defect.h"
#include "tools/influence_report.h"

namespace espalier::tools {

/// A lattice file, valid or not. complex: none where the defects leave none.
struct LatticeReport {
  RawLattice raw;
  std::vector<Defect> defects;
};

/// All of these end in a line feed.
[[nodiscard]] std::string lattice_report(const LatticeReport& report, bool is_json);
[[nodiscard]] std::string lattice_report(const Lattice& lattice, bool is_json);
/// With how many points of a model control points move.
[[nodiscard]] std::string lattice_report(const Lattice& lattice, const ModelInfluence& influence,
                                         bool is_json);
[[nodiscard]] std::string model_report(const Model& model, bool is_json);

/// A picture of so many pixels, now in the file `path`.
[[nodiscard]] std::string picture_report(const std::string& path, int width, int height,
                                         bool is_json);

/// What an operation made: `name` in the scene, now in the file `path`; for a bound model also how
/// many points each lattice holds: "inside" …, with several lattices in "lattices" by name, what is
/// locked, and how many faces tore.
[[nodiscard]] std::string result_report(const Scene& scene, const std::string& name,
                                        const std::string& path, bool is_json);

/// The reports of many results in one: a JSON array, or one after the other.
[[nodiscard]] std::string series_report(const std::vector<std::string>& reports, bool is_json);
/// The same of a binding that was written to `path`.
[[nodiscard]] std::string binding_report(const Scene& scene, const std::string& path, bool is_json);

}  // namespace espalier::tools
