#include "viewer/render/scene_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "viewer/render/mesh_drawing.h"

namespace espalier::viewer {
namespace {

constexpr glm::vec3 kCornerYellow{0.98F, 0.80F, 0.10F};
constexpr glm::vec3 kSharpRed{0.85F, 0.16F, 0.14F};
constexpr glm::vec3 kBoundaryGreen{0.16F, 0.60F, 0.25F};
constexpr glm::vec3 kInnerBlue{0.17F, 0.38F, 0.82F};

std::span<const glm::dvec3> shown_points(const Lattice& lattice, LatticeShape shape) {
  return shape == LatticeShape::Posed ? lattice.posed_points() : lattice.rest_points();
}

/// Of a control point on a grid: bit f if it lies on the grid's side f of index_order.h.
using Sides = std::uint8_t;

void add_side(int axis, std::int32_t i, int n, Sides& sides) {
  if (n > 1 && (i == 0 || i == n - 1)) {
    sides = static_cast<Sides>(sides | 1 << (2 * axis + (i == 0 ? 0 : 1)));
  }
}

std::vector<Sides> sides_of(const TensorLattice& lattice) {
  std::vector<Sides> sides(lattice.rest.size(), 0);
  std::int32_t stride = 1;
  for (int a = 0; a < 3; ++a) {
    const TensorAxis& axis = lattice.axes[static_cast<std::size_t>(a)];
    const int n = axis.n_controls();
    for (std::size_t i = 0; axis.ends() != Ends::Periodic && i < sides.size(); ++i) {
      add_side(a, static_cast<std::int32_t>(i) / stride % n, n, sides[i]);
    }
    stride *= n;
  }
  return sides;
}

std::vector<Sides> sides_of(const ThbLattice& lattice) {
  std::vector<Sides> sides(lattice.rest.size(), 0);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const ThbFunction& function = lattice.hierarchy->controls()[i];
    const auto& axes = lattice.hierarchy->axes(function.level);
    for (std::size_t a = 0; a < 3; ++a) {
      add_side(static_cast<int>(a), function.index[a], axes[a].n_functions(), sides[i]);
    }
  }
  return sides;
}

glm::vec3 side_color(Sides sides) {
  return sides != 0 ? kBoundaryGreen : kInnerBlue;
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

/// What lattices of any type are drawn with.
struct LatticePen {
  std::span<const glm::dvec3> points;
  const DrawingFrame& frame;
  float pen;

  [[nodiscard]] glm::vec3 at(std::size_t control) const {
    return glm::vec3(frame.to_drawing(points[control]));
  }
};

void add_lattice(const SubdivisionLattice& lattice, const LatticePen& with, Drawing& drawing) {
  const auto at = [&](VertexId vertex) { return with.at(vertex.index()); };
  const float scale = with.pen * pen_scale(lattice.complex->n_edges());
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

void add_grid(std::span<const std::array<std::int32_t, 2>> net, std::span<const Sides> sides,
              const LatticePen& with, Drawing& drawing) {
  const float scale = with.pen * pen_scale(net.size());
  LineSet lines;
  lines.width = 2.6F * scale;
  for (const auto& ends : net) {
    const auto a = static_cast<std::size_t>(ends[0]);
    const auto b = static_cast<std::size_t>(ends[1]);
    lines.points.push_back(with.at(a));
    lines.points.push_back(with.at(b));
    lines.colors.push_back(side_color(static_cast<Sides>(sides[a] & sides[b])));
  }
  PointSet points;
  points.diameter = 6 * scale;
  points.outline = 0;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    points.points.push_back(with.at(i));
    points.colors.push_back(side_color(sides[i]));
  }
  drawing.lines.push_back(std::move(lines));
  drawing.points.push_back(std::move(points));
}

template <class GridLattice>
void add_lattice(const GridLattice& lattice, const LatticePen& with, Drawing& drawing) {
  add_grid(Lattice(lattice).net(), sides_of(lattice), with, drawing);
}

}  // namespace

Drawing draw_scene(std::span<const Model> models, std::span<const Lattice> lattices,
                   LatticeShape shape, const DrawingFrame& frame, float pen) {
  Drawing drawing;
  for (const Model& model : models) {
    drawing.meshes.push_back(draw_mesh(model.points(), model.faces(), {.frame = frame}));
  }
  for (const Lattice& lattice : lattices) {
    const LatticePen with{shown_points(lattice, shape), frame, pen};
    lattice.visit([&](const auto& held) { add_lattice(held, with, drawing); });
  }
  return drawing;
}

Box bounds(std::span<const Model> models, std::span<const Lattice> lattices, LatticeShape shape) {
  Box box;
  for (const Model& model : models) {
    box.add(model.points());
  }
  for (const Lattice& lattice : lattices) {
    box.add(shown_points(lattice, shape));
  }
  return box;
}

}  // namespace espalier::viewer
