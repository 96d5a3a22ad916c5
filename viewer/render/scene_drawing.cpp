#include "viewer/render/scene_drawing.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "viewer/render/mesh_drawing.h"

namespace espalier::viewer {
namespace {

constexpr glm::vec3 kCornerYellow{0.98F, 0.80F, 0.10F};
constexpr glm::vec3 kSharpRed{0.85F, 0.16F, 0.14F};
constexpr glm::vec3 kBoundaryGreen{0.16F, 0.60F, 0.25F};
constexpr glm::vec3 kInnerBlue{0.17F, 0.38F, 0.82F};

std::span<const glm::dvec3> shown_points(const SubdivisionLattice& lattice, LatticeShape shape) {
  return shape == LatticeShape::Posed ? lattice.posed_points()
                                      : std::span<const glm::dvec3>(lattice.rest);
}

glm::vec3 edge_color(const SubdivisionLattice& lattice, EdgeId edge) {
  if (lattice.sharpness.edges[edge] > 0) {
    return kSharpRed;
  }
  return lattice.complex->is_boundary(edge) ? kBoundaryGreen : kInnerBlue;
}

/// How much finer than usual a lattice with many edges is drawn, or it would hide everything.
float pen_scale(std::size_t n_edges) {
  return std::clamp(std::sqrt(250.0F / static_cast<float>(n_edges + 1)), 0.4F, 1.0F);
}

void add_lattice(const SubdivisionLattice& lattice, LatticeShape shape, const DrawingFrame& frame,
                 float pen, Drawing& drawing) {
  const auto points = shown_points(lattice, shape);
  const auto at = [&](VertexId vertex) {
    return glm::vec3(frame.to_drawing(points[vertex.index()]));
  };
  const float scale = pen * pen_scale(lattice.complex->n_edges());
  LineSet lines;
  lines.width = 2.6F * scale;
  for (const EdgeId edge : lattice.complex->edges()) {
    for (const VertexId vertex : lattice.complex->vertices(edge)) {
      lines.points.push_back(at(vertex));
    }
    lines.colors.push_back(edge_color(lattice, edge));
  }
  PointSet corners;
  corners.diameter = 11 * scale;
  PointSet others;
  others.diameter = 6 * scale;
  others.outline = 0;
  for (const VertexId vertex : lattice.complex->vertices()) {
    const bool is_corner = lattice.sharpness.vertices[vertex] > 0;
    PointSet& set = is_corner ? corners : others;
    set.points.push_back(at(vertex));
    set.colors.push_back(is_corner                              ? kCornerYellow
                         : lattice.complex->is_boundary(vertex) ? kBoundaryGreen
                                                                : kInnerBlue);
  }
  drawing.lines.push_back(std::move(lines));
  drawing.points.push_back(std::move(others));
  drawing.points.push_back(std::move(corners));
}

}  // namespace

Drawing draw_scene(std::span<const Model> models, std::span<const SubdivisionLattice> lattices,
                   LatticeShape shape, const DrawingFrame& frame, float pen) {
  Drawing drawing;
  for (const Model& model : models) {
    drawing.meshes.push_back(draw_mesh(model.points(), model.faces(), {.frame = frame}));
  }
  for (const SubdivisionLattice& lattice : lattices) {
    add_lattice(lattice, shape, frame, pen, drawing);
  }
  return drawing;
}

Box bounds(std::span<const Model> models, std::span<const SubdivisionLattice> lattices,
           LatticeShape shape) {
  Box box;
  for (const Model& model : models) {
    box.add(model.points());
  }
  for (const SubdivisionLattice& lattice : lattices) {
    box.add(shown_points(lattice, shape));
  }
  return box;
}

}  // namespace espalier::viewer
