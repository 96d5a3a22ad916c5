#pragma once

/// Collects the tables of a volume while levels of refinement come and go.

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "lattice/core/compressed_rows.h"
#include "lattice/subdivision/limit.h"
#include "lattice/volume/volume.h"

namespace espalier {

/// Points are combinations of the vertices of a level, whose rows over the control points are kept
/// until the end.
class VolumeBuilder {
 public:
  /// rows: the level's vertices over the control points.
  void begin_level(std::shared_ptr<const StencilTable> rows);

  /// The number of a vertex of the current level as a point, the same at every call.
  [[nodiscard]] std::int32_t vertex_point(VertexId vertex);
  /// The number of a further point of the current level.
  [[nodiscard]] std::int32_t add_point(const VertexCombination& combination);

  /// The number of an extraction in the shared table.
  [[nodiscard]] std::uint16_t extraction(const Extraction& extraction);

  void add_patch(const Patch& patch, std::span<const std::int32_t> block);

  /// See Volume::freeze_error().
  void set_freeze_error(double error) { tables_.freeze_error = error; }
  /// See Volume::gradient_error(): the largest counts.
  void add_gradient_error(double error) {
    tables_.gradient_error = std::max(tables_.gradient_error, error);
  }

  [[nodiscard]] Volume build(std::vector<glm::dvec3> rest_controls) &&;

 private:
  std::vector<std::shared_ptr<const StencilTable>> levels_;
  std::vector<std::int32_t> numbers_;       // of the current level's vertices, -1 none yet
  std::vector<std::uint8_t> point_levels_;  // #points
  CompressedRows<std::pair<VertexId, double>> points_;  // #points: combinations
  VolumeTables tables_;
};

}  // namespace espalier
