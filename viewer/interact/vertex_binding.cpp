#include "viewer/interact/vertex_binding.h"

#include <utility>
#include <vector>

#include "lattice/core/compressed_rows.h"

namespace espalier::viewer {
namespace {

/// Vertices by the point they are drawn at.
CompressedRows<std::int32_t> vertices_by_point(std::span<const std::uint32_t> vertex_points,
                                               std::size_t n_points) {
  std::vector<std::uint32_t> offsets(n_points + 1, 0);
  for (const std::uint32_t point : vertex_points) {
    ++offsets[point + 1];
  }
  for (std::size_t i = 0; i < n_points; ++i) {
    offsets[i + 1] += offsets[i];
  }
  std::vector<std::int32_t> vertices(vertex_points.size());
  std::vector<std::uint32_t> next(offsets.begin(), offsets.end() - 1);
  for (std::size_t vertex = 0; vertex < vertex_points.size(); ++vertex) {
    vertices[next[vertex_points[vertex]]++] = static_cast<std::int32_t>(vertex);
  }
  return CompressedRows<std::int32_t>::from_offsets(std::move(offsets), std::move(vertices));
}

}  // namespace

Binding binding_of_vertices(const Binding& binding, std::span<const std::uint32_t> vertex_points) {
  const auto vertices = vertices_by_point(vertex_points, binding.status.size());
  Binding result;
  for (const std::uint32_t point : vertex_points) {
    result.status.push_back(binding.status[point]);
  }
  for (std::size_t i = 0; i < binding.points.size(); ++i) {
    for (const std::int32_t vertex : vertices[static_cast<std::size_t>(binding.points[i])]) {
      result.points.push_back(vertex);
      result.patches.push_back(binding.patches[i]);
      result.uvw.push_back(binding.uvw[i]);
    }
  }
  const Fringe& fringe = binding.fringe;
  for (std::size_t i = 0; i < fringe.points.size(); ++i) {
    for (const std::int32_t vertex : vertices[static_cast<std::size_t>(fringe.points[i])]) {
      result.fringe.points.push_back(vertex);
      result.fringe.patches.push_back(fringe.patches[i]);
      result.fringe.uvw.push_back(fringe.uvw[i]);
      result.fringe.weights.push_back(fringe.weights[i]);
      result.fringe.weight_slopes.push_back(fringe.weight_slopes[i]);
      result.fringe.uvw_slopes.push_back(fringe.uvw_slopes[i]);
    }
  }
  return result;
}

}  // namespace espalier::viewer
