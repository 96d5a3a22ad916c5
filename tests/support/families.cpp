#include "tests/support/families.h"

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <random>
#include <utility>

#include "lattice/build/extrude.h"
#include "lattice/build/primitives.h"

namespace espalier::test {
namespace {

glm::dvec3 on_circle(double radius, double turns) {
  const double angle = 2 * std::numbers::pi * turns;
  return {radius * std::cos(angle), radius * std::sin(angle), 0};
}

/// Loops of a box whose corners, in the order of index_order.h, are `c`.
std::vector<std::vector<std::int32_t>> box_loops(const std::array<std::int32_t, 8>& c) {
  return {{c[0], c[4], c[6], c[2]}, {c[1], c[3], c[7], c[5]}, {c[0], c[1], c[5], c[4]},
          {c[2], c[6], c[7], c[3]}, {c[0], c[2], c[3], c[1]}, {c[4], c[5], c[7], c[6]}};
}

std::vector<std::vector<std::int32_t>> tetrahedron_loops(std::int32_t a, std::int32_t b,
                                                         std::int32_t c, std::int32_t d) {
  return {{a, b, c}, {a, b, d}, {b, c, d}, {c, a, d}};
}

std::vector<glm::dvec3> unit_cube_points() {
  std::vector<glm::dvec3> points;
  for (int c = 0; c < 8; ++c) {
    points.emplace_back(c % 2, c / 2 % 2, c / 4);
  }
  return points;
}

/// Unit cubes at integer places, corners merged.
SubdivisionLattice unit_cubes(const std::vector<std::array<int, 3>>& places) {
  std::vector<glm::dvec3> points;
  std::vector<std::vector<std::vector<std::int32_t>>> cells;
  const auto vertex = [&](const glm::dvec3& point) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (points[i] == point) {
        return static_cast<std::int32_t>(i);
      }
    }
    points.push_back(point);
    return static_cast<std::int32_t>(points.size() - 1);
  };
  for (const auto& [x, y, z] : places) {
    std::array<std::int32_t, 8> corners{};
    for (int c = 0; c < 8; ++c) {
      corners[static_cast<std::size_t>(c)] =
          vertex(glm::dvec3(x + c % 2, y + c / 2 % 2, z + c / 4));
    }
    cells.push_back(box_loops(corners));
  }
  return lattice_from(mesh_from_loops(points, cells));
}

}  // namespace

Section grid_section(int nx, int ny) {
  Section section{"grid", {}, {}};
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i) {
      section.points.emplace_back(i, j, 0);
    }
  }
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const int a = i + (nx + 1) * j;
      section.faces.push_back(std::array{a, a + 1, a + nx + 2, a + nx + 1});
    }
  }
  return section;
}

Section wheel_section(int n) {
  Section section{"wheel " + std::to_string(n), {glm::dvec3(0)}, {}};
  for (int i = 0; i < n; ++i) {
    section.points.push_back(on_circle(1, static_cast<double>(i) / n));
    section.faces.push_back(std::array{0, i + 1, (i + 1) % n + 1});
  }
  return section;
}

Section flower_section(int n) {
  Section section{"flower " + std::to_string(n), {glm::dvec3(0)}, {}};
  for (const double radius : {1.0, 2.0}) {
    for (int i = 0; i < 2 * n; ++i) {
      section.points.push_back(on_circle(radius, static_cast<double>(i) / (2 * n)));
    }
  }
  for (int i = 0; i < 2 * n; i += 2) {
    section.faces.push_back(std::array{0, i + 1, i + 2, (i + 2) % (2 * n) + 1});
  }
  for (int i = 0; i < 2 * n; ++i) {
    const int next = (i + 1) % (2 * n);
    section.faces.push_back(std::array{i + 1, 2 * n + i + 1, 2 * n + next + 1, next + 1});
  }
  return section;
}

Section pentagon_section() {
  Section section{"pentagon core", {}, {}};
  for (const double radius : {1.0, 2.0}) {
    for (int i = 0; i < 5; ++i) {
      section.points.push_back(on_circle(radius, i / 5.0));
    }
  }
  section.faces.push_back(std::array{0, 1, 2, 3, 4});
  for (int i = 0; i < 5; ++i) {
    section.faces.push_back(std::array{i, i + 5, (i + 1) % 5 + 5, (i + 1) % 5});
  }
  return section;
}

Section o_grid_section() {
  Section section = grid_section(2, 2);
  section.name = "O-grid";
  for (glm::dvec3& point : section.points) {
    point -= glm::dvec3(1, 1, 0);
  }
  const std::array<std::int32_t, 8> rim = {5, 8, 7, 6, 3, 0, 1, 2};  // round the core
  for (int i = 0; i < 8; ++i) {
    section.points.push_back(on_circle(2.5, i / 8.0));
  }
  for (std::int32_t i = 0; i < 8; ++i) {
    const std::int32_t next = (i + 1) % 8;
    section.faces.push_back(std::array{rim[static_cast<std::size_t>(i)], 9 + i, 9 + next,
                                       rim[static_cast<std::size_t>(next)]});
  }
  return section;
}

Section l_section() {
  Section section{"L", {}, {}};
  std::map<std::pair<int, int>, std::int32_t> number;
  const auto point = [&](int i, int j) {
    const auto [at, is_new] =
        number.emplace(std::pair(i, j), static_cast<std::int32_t>(section.points.size()));
    if (is_new) {
      section.points.emplace_back(i, j, 0);
    }
    return at->second;
  };
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      if (i < 2 || j < 2) {
        section.faces.push_back(
            std::array{point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)});
      }
    }
  }
  return section;
}

Section half_disk_section(int n) {
  Section section{"half disk " + std::to_string(n), {glm::dvec3(0)}, {}};
  for (int i = 0; i <= n; ++i) {
    section.points.push_back(on_circle(1, 0.5 * i / n));
  }
  for (int i = 0; i < n; ++i) {
    section.faces.push_back(std::array{0, i + 1, i + 2});
  }
  return section;
}

std::vector<Section> irregular_sections() {
  return {flower_section(3),    flower_section(5),   flower_section(6),  wheel_section(3),
          wheel_section(5),     wheel_section(8),    pentagon_section(), l_section(),
          half_disk_section(3), half_disk_section(5)};
}

SubdivisionLattice prism(const Section& section, int layers, Scheme scheme) {
  return lattice_from(extrude(section.points, section.faces, glm::dvec3(0, 0, layers), layers),
                      scheme);
}

SubdivisionLattice lattice_from(CellMesh mesh, Scheme scheme) {
  SubdivisionLattice lattice;
  lattice.complex = std::make_shared<const CellComplex>(std::move(mesh.cells));
  lattice.rest = std::move(mesh.points);
  lattice.sharpness = automatic_sharpness(*lattice.complex);
  lattice.scheme = scheme;
  return lattice;
}

CellMesh mesh_from_loops(std::vector<glm::dvec3> points,
                         const std::vector<std::vector<std::vector<std::int32_t>>>& cells) {
  CellLoops loops{static_cast<std::int32_t>(points.size()), {}, {0}};
  for (const auto& cell : cells) {
    for (const auto& loop : cell) {
      loops.loops.push_back(loop);
    }
    loops.cells.push_back(static_cast<std::uint32_t>(loops.loops.n_rows()));
  }
  CellMesh mesh{match_faces(std::move(loops)), std::move(points)};
  orient(mesh.cells, mesh.points);
  return mesh;
}

SubdivisionLattice tetrahedron() {
  return lattice_from(mesh_from_loops({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                      {tetrahedron_loops(0, 1, 2, 3)}));
}

SubdivisionLattice pyramid_on_cube() {
  std::vector<glm::dvec3> points = unit_cube_points();
  points.emplace_back(0.5, 0.5, 2);
  return lattice_from(
      mesh_from_loops(points, {box_loops({0, 1, 2, 3, 4, 5, 6, 7}),
                               {{4, 5, 7, 6}, {4, 5, 8}, {5, 7, 8}, {7, 6, 8}, {6, 4, 8}}}));
}

SubdivisionLattice six_tetrahedra() {
  return lattice_from(mesh_from_loops(
      unit_cube_points(), {tetrahedron_loops(0, 1, 3, 7), tetrahedron_loops(0, 3, 2, 7),
                           tetrahedron_loops(0, 2, 6, 7), tetrahedron_loops(0, 6, 4, 7),
                           tetrahedron_loops(0, 4, 5, 7), tetrahedron_loops(0, 5, 1, 7)}));
}

SubdivisionLattice cubes_sharing_edge() {
  return unit_cubes({{0, 0, 0}, {1, 1, 0}});
}

SubdivisionLattice cubes_sharing_vertex() {
  return unit_cubes({{0, 0, 0}, {1, 1, 1}});
}

SubdivisionLattice plus_of_cubes() {
  return unit_cubes(
      {{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}});
}

std::vector<NamedLattice> lattice_families() {
  std::vector<NamedLattice> families;
  families.push_back({"box", lattice_from(make_box({3, 2, 4}, {0, 0, 0}, {3, 2, 4}))});
  families.push_back({"single cube", lattice_from(make_box({1, 1, 1}, {0, 0, 0}, {1, 1, 1}))});
  families.push_back({"wedge cylinder", lattice_from(make_cylinder({}))});
  for (const Section& section : irregular_sections()) {
    families.push_back({"prism over " + section.name, prism(section, 3)});
  }
  families.push_back({"MacCracken-Joy prism", prism(flower_section(5), 3, Scheme::MacCrackenJoy)});
  families.push_back({"tetrahedron", tetrahedron()});
  families.push_back({"pyramid on a cube", pyramid_on_cube()});
  families.push_back({"six tetrahedra", six_tetrahedra()});
  families.push_back({"cubes sharing an edge", cubes_sharing_edge()});
  families.push_back({"cubes sharing a vertex", cubes_sharing_vertex()});
  families.push_back({"plus of cubes", plus_of_cubes()});
  SubdivisionLattice creased = prism(wheel_section(5), 2);
  float sharpness = 0;
  for (const EdgeId edge : creased.complex->edges()) {
    if (creased.complex->is_boundary(edge)) {
      creased.sharpness.edges[edge] = sharpness;
      sharpness = sharpness > 3 ? 0 : sharpness + 0.7f;
    }
  }
  families.push_back({"creased", std::move(creased)});
  return families;
}

std::vector<glm::dvec3> jittered(std::vector<glm::dvec3> points, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> noise(-size, size);
  for (glm::dvec3& point : points) {
    for (int axis = 0; axis < 3; ++axis) {
      point[axis] += noise(random);
    }
  }
  return points;
}

}  // namespace espalier::test
