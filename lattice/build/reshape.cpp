#include "lattice/build/reshape.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

#include "lattice/build/offsets.h"
#include "lattice/core/error.h"
#include "lattice/topology/cell_complex.h"

namespace espalier {
namespace {

constexpr int kMostSteps = 10000;

}  // namespace

glm::dmat3 rotation(const glm::dvec3& axis, double degrees) {
  const glm::dvec3 along = unit_vector(axis);
  if (!(glm::length(along) > 0.5) || !std::isfinite(degrees)) {
    throw ParameterError("rotation: the axis must be finite and not zero, the angle finite");
  }
  const double angle = glm::radians(degrees);
  const glm::dmat3 across(0, along.z, -along.y, -along.z, 0, along.x, along.y, -along.x, 0);
  return glm::dmat3(1) + std::sin(angle) * across + (1 - std::cos(angle)) * across * across;
}

void require_finite(const Placement& placement) {
  const glm::dvec3 all = placement.linear * glm::dvec3(1) + placement.about + placement.by;
  if (!std::isfinite(all.x) || !std::isfinite(all.y) || !std::isfinite(all.z)) {
    throw ParameterError("transform: all numbers must be finite");
  }
}

Edited placed(const CellMesh& mesh, std::span<const std::int32_t> vertices,
              const Placement& placement) {
  check_selection(vertices, mesh.points.size(), "transform: vertex");
  require_finite(placement);
  MeshDraft draft(mesh);
  for (const std::int32_t vertex : vertices) {
    DraftVertex& moved = draft.vertices[static_cast<std::size_t>(vertex)];
    moved.point = placement.of(moved.point);
    moved.turn = placement.linear;
  }
  return finished(std::move(draft));
}

Edited relaxed(const CellMesh& mesh, int steps) {
  if (steps < 1 || steps > kMostSteps) {
    throw ParameterError(fmt::format("relax: steps is {}, must be 1 to {}", steps, kMostSteps));
  }
  const CellComplex complex(mesh.cells);
  std::vector<glm::dvec3> points = mesh.points;
  for (int step = 0; step < steps; ++step) {
    const std::vector<glm::dvec3> before = points;
    for (const VertexId vertex : complex.vertices()) {
      if (complex.is_boundary(vertex)) {
        continue;
      }
      glm::dvec3 sum(0);
      for (const EdgeId edge : complex.edges(vertex)) {
        sum += before[complex.other_end(edge, vertex).index()];
      }
      points[vertex.index()] = sum / static_cast<double>(complex.edges(vertex).size());
    }
  }
  MeshDraft draft(mesh);
  for (std::size_t i = 0; i < points.size(); ++i) {
    draft.vertices[i].point = points[i];
  }
  return finished(std::move(draft));
}

}  // namespace espalier
