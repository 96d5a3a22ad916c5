#include "lattice/subdivision/volume_builder.h"

#include <algorithm>
#include <utility>

namespace espalier {

void VolumeBuilder::begin_level(std::shared_ptr<const StencilTable> rows) {
  numbers_.assign(rows->n_rows(), -1);
  levels_.push_back(std::move(rows));
}

std::int32_t VolumeBuilder::vertex_point(VertexId vertex) {
  std::int32_t& number = numbers_[vertex.index()];
  if (number < 0) {
    number = add_point({{vertex, 1.0}});
  }
  return number;
}

std::int32_t VolumeBuilder::add_point(const VertexCombination& combination) {
  point_levels_.push_back(static_cast<std::uint8_t>(levels_.size() - 1));
  points_.push_back(combination);
  return static_cast<std::int32_t>(points_.n_rows()) - 1;
}

std::uint16_t VolumeBuilder::extraction(const Extraction& extraction) {
  auto& table = tables_.extractions;
  const auto found = std::find(table.begin(), table.end(), extraction);
  const auto number = static_cast<std::uint16_t>(found - table.begin());
  if (found == table.end()) {
    table.push_back(extraction);
  }
  return number;
}

void VolumeBuilder::add_patch(const Patch& patch, std::span<const std::int32_t> block) {
  tables_.patches.push_back(patch);
  tables_.blocks.push_back(block);
}

Volume VolumeBuilder::build(std::vector<glm::dvec3> rest_controls) && {
  tables_.stencils = StencilTable::build(
      points_.n_rows(), rest_controls.size(), [&](std::size_t i, StencilRow& row) {
        const StencilTable& level = *levels_[point_levels_[i]];
        for (const auto& [vertex, weight] : std::as_const(points_)[i]) {
          const StencilTable::Row source = level[vertex.index()];
          for (std::size_t k = 0; k < source.indices.size(); ++k) {
            row.add(source.indices[k], weight * source.weights[k]);
          }
        }
      });
  return {std::move(tables_), std::move(rest_controls)};
}

}  // namespace espalier
