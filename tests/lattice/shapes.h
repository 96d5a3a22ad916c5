#pragma once

/// Small lattices for tests, by name.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "lattice/subdivision/subdivision_lattice.h"
#include "lattice/topology/polyhedra.h"

namespace espalier::shapes {

struct Shape {
  Polyhedra polyhedra;
  std::vector<glm::dvec3> points;
};

using Loops = std::vector<std::vector<std::int32_t>>;

/// Cells by their faces' loops, in any winding.
inline Shape from_loops(std::vector<glm::dvec3> points, const std::vector<Loops>& cells) {
  CellLoops loops;
  loops.n_vertices = static_cast<std::int32_t>(points.size());
  loops.cells = {0};
  for (const Loops& cell : cells) {
    for (const auto& loop : cell) {
      loops.loops.push_back(loop);
    }
    loops.cells.push_back(static_cast<std::uint32_t>(loops.loops.n_rows()));
  }
  Shape shape{match_faces(std::move(loops)), std::move(points)};
  orient(shape.polyhedra, shape.points);
  return shape;
}

inline Loops tetrahedron_loops(int a, int b, int c, int d) {
  return {{a, b, c}, {a, b, d}, {b, c, d}, {c, a, d}};
}

/// A prism over a loop: bottom vertices, then as many top vertices.
inline Loops prism_loops(const std::vector<std::int32_t>& bottom,
                         const std::vector<std::int32_t>& top) {
  Loops loops = {bottom, top};
  for (std::size_t i = 0; i < bottom.size(); ++i) {
    const std::size_t j = (i + 1) % bottom.size();
    loops.push_back({bottom[i], bottom[j], top[j], top[i]});
  }
  return loops;
}

inline Shape box_grid(int nu, int nv, int nw) {
  std::vector<glm::dvec3> points;
  for (int k = 0; k <= nw; ++k) {
    for (int j = 0; j <= nv; ++j) {
      for (int i = 0; i <= nu; ++i) {
        points.emplace_back(i, j, k);
      }
    }
  }
  std::vector<std::array<std::int32_t, 8>> cells;
  for (int k = 0; k < nw; ++k) {
    for (int j = 0; j < nv; ++j) {
      for (int i = 0; i < nu; ++i) {
        std::array<std::int32_t, 8>& cell = cells.emplace_back();
        for (int c = 0; c < 8; ++c) {
          cell[static_cast<std::size_t>(c)] =
              i + (c & 1) + (nu + 1) * (j + (c >> 1 & 1) + (nv + 1) * (k + (c >> 2)));
        }
      }
    }
  }
  return {match_faces(hexahedron_loops(static_cast<std::int32_t>(points.size()), cells)), points};
}

inline Shape cube() {
  return box_grid(1, 1, 1);
}

/// A grid bent, twisted and shaken so that no face is flat.
inline Shape warped_grid(int nu, int nv, int nw) {
  Shape shape = box_grid(nu, nv, nw);
  for (std::size_t i = 0; i < shape.points.size(); ++i) {
    const glm::dvec3 p = shape.points[i];
    const double angle = 0.4 + 0.3 * p.z / (nu + nv + nw);
    const auto shake = [&](double seed) {
      return 0.12 * std::sin(12.9898 * seed + 78.233 * static_cast<double>(i));
    };
    shape.points[i] = glm::dvec3(std::cos(angle) * p.x - std::sin(angle) * p.y + shake(1),
                                 std::sin(angle) * p.x + std::cos(angle) * p.y + shake(2),
                                 p.z + 0.2 * p.x * p.y / (nu + nv) + shake(3));
  }
  return shape;
}

inline Shape tetrahedron() {
  return from_loops({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {tetrahedron_loops(0, 1, 2, 3)});
}

inline Shape pyramid_on_cube() {
  std::vector<glm::dvec3> points = cube().points;
  points.emplace_back(0.5, 0.5, 2);
  return from_loops(points, {prism_loops({0, 1, 3, 2}, {4, 5, 7, 6}),
                             {{4, 5, 7, 6}, {4, 5, 8}, {5, 7, 8}, {7, 6, 8}, {6, 4, 8}}});
}

/// A prism whose ends are given in the plane.
inline Shape prism(const std::vector<std::array<double, 2>>& end, double height) {
  std::vector<glm::dvec3> points;
  std::array<std::vector<std::int32_t>, 2> loops;
  for (std::size_t side = 0; side < 2; ++side) {
    for (const auto& [x, y] : end) {
      loops[side].push_back(static_cast<std::int32_t>(points.size()));
      points.emplace_back(x, y, static_cast<double>(side) * height);
    }
  }
  return from_loops(points, {prism_loops(loops[0], loops[1])});
}

inline Shape regular_prism(int n) {
  std::vector<std::array<double, 2>> end;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    end.push_back({std::cos(angle), std::sin(angle)});
  }
  return prism(end, 1);
}

/// n wedges round an axis, one layer: vertices on the axis 0, 1; rims 2 + 2i, 3 + 2i.
inline Shape wedge_cylinder(int n) {
  std::vector<glm::dvec3> points = {{0, 0, 0}, {0, 0, 1}};
  std::vector<Loops> cells;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    points.emplace_back(std::cos(angle), std::sin(angle), 0);
    points.emplace_back(std::cos(angle), std::sin(angle), 1);
    const int j = (i + 1) % n;
    cells.push_back(prism_loops({0, 2 + 2 * i, 2 + 2 * j}, {1, 3 + 2 * i, 3 + 2 * j}));
  }
  return from_loops(points, cells);
}

/// A cell with a concave end (a U), and a taller box that stands in its notch, apart from it.
inline Shape concave_cell_with_box_in_notch() {
  Shape u = prism({{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}}, 1);
  std::vector<glm::dvec3> points = u.points;
  const auto first = static_cast<std::int32_t>(points.size());
  for (int k = 0; k < 2; ++k) {
    for (const auto& [x, y] : {std::pair{1.2, 1.2}, {1.8, 1.2}, {1.8, 4.0}, {1.2, 4.0}}) {
      points.emplace_back(x, y, -1.0 + 3.0 * k);
    }
  }
  const auto f = first;
  return from_loops(points, {prism_loops({0, 1, 2, 3, 4, 5, 6, 7}, {8, 9, 10, 11, 12, 13, 14, 15}),
                             prism_loops({f, f + 1, f + 2, f + 3}, {f + 4, f + 5, f + 6, f + 7})});
}

/// Two columns of n cubes that share the edges of one line.
inline Shape columns_sharing_a_line(int n) {
  std::vector<glm::dvec3> points;
  std::vector<Loops> cells;
  for (int k = 0; k <= n; ++k) {
    for (const auto& [x, y] :
         {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}, {-1, 0}, {-1, -1}, {0, -1}}) {
      points.emplace_back(x, y, k);
    }
  }
  for (std::int32_t k = 0; k < n; ++k) {
    const std::int32_t a = 7 * k;
    const std::int32_t b = a + 7;
    cells.push_back(prism_loops({a, a + 1, a + 2, a + 3}, {b, b + 1, b + 2, b + 3}));
    cells.push_back(prism_loops({a, a + 4, a + 5, a + 6}, {b, b + 4, b + 5, b + 6}));
  }
  return from_loops(points, cells);
}

inline Shape cubes_sharing_a_vertex() {
  std::vector<glm::dvec3> points = cube().points;
  for (const glm::dvec3& point : cube().points) {
    if (point != glm::dvec3(0)) {
      points.push_back(-point);  // 8 … 14 mirror 1 … 7
    }
  }
  return from_loops(points, {prism_loops({0, 1, 3, 2}, {4, 5, 7, 6}),
                             prism_loops({0, 8, 10, 9}, {11, 12, 14, 13})});
}

/// Both shapes in one, nothing shared.
inline Shape together(const Shape& a, const Shape& b, glm::dvec3 offset_of_b) {
  Shape both = a;
  const auto n_points = static_cast<std::int32_t>(a.points.size());
  const auto n_faces = static_cast<std::int32_t>(a.polyhedra.faces.n_rows());
  for (const glm::dvec3& point : b.points) {
    both.points.push_back(point + offset_of_b);
  }
  const auto append = [](CompressedRows<std::int32_t>& rows,
                         const CompressedRows<std::int32_t>& more, std::int32_t shift) {
    for (std::size_t i = 0; i < more.n_rows(); ++i) {
      std::vector<std::int32_t> row(more[i].begin(), more[i].end());
      for (std::int32_t& value : row) {
        value += shift;
      }
      rows.push_back(row);
    }
  };
  append(both.polyhedra.faces, b.polyhedra.faces, n_points);
  append(both.polyhedra.cells, b.polyhedra.cells, 2 * n_faces);
  both.polyhedra.n_vertices += b.polyhedra.n_vertices;
  return both;
}

inline SubdivisionLattice lattice(const Shape& shape) {
  SubdivisionLattice result;
  result.complex = std::make_shared<const CellComplex>(shape.polyhedra);
  result.rest = shape.points;
  result.sharpness = automatic_sharpness(*result.complex);
  return result;
}

}  // namespace espalier::shapes
