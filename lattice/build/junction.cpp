#include "lattice/build/junction.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <set>
#include <utility>

#include "lattice/build/checks.h"
#include "lattice/build/extrude_faces.h"
#include "lattice/build/offsets.h"
#include "lattice/build/primitives.h"
#include "lattice/build/reshape.h"
#include "lattice/build/section.h"
#include "lattice/core/error.h"
#include "lattice/topology/cell_complex.h"

namespace espalier {
namespace {

using Indices = std::vector<std::int32_t>;

/// The side of the cube an arm leaves by: its axis, and which end.
struct Side {
  int axis = 0;
  double sign = 1;
  auto operator<=>(const Side&) const = default;
};

Side side_towards(const glm::dvec3& arm) {
  const glm::dvec3 size = glm::abs(arm);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  return {axis, arm[axis] > 0 ? 1.0 : -1.0};
}

/// Turns the side's axis the shortest way to the arm.
glm::dmat3 turn_of(const Side& side, const glm::dvec3& arm) {
  glm::dvec3 normal(0);
  normal[side.axis] = side.sign;
  const glm::dvec3 across = glm::cross(normal, unit_vector(arm));
  return glm::length(across) < 1e-12
             ? glm::dmat3(1)
             : rotation(across, glm::degrees(std::asin(std::min(1.0, glm::length(across)))));
}

/// The boundary faces all of whose vertices are new or satisfy a test.
template <class Test>
Indices boundary_faces(const CellMesh& mesh, const Test& test) {
  const CellComplex complex(mesh.cells);
  Indices faces;
  for (const FaceId face : complex.faces()) {
    const auto loop = complex.vertices(face);
    if (complex.is_boundary(face) && std::all_of(loop.begin(), loop.end(), test)) {
      faces.push_back(face.value);
    }
  }
  return faces;
}

/// Grows an arm, a layer at a time, from the side of the cube; returns its last faces' vertices.
std::set<std::int32_t> grow_arm(const glm::dvec3& arm, double half, int layers, CellMesh& mesh) {
  const Side side = side_towards(arm);
  const glm::dmat3 turn = turn_of(side, arm);
  std::vector<glm::dvec3> places = mesh.points;  // of each vertex in the section of the cube
  Indices faces = boundary_faces(mesh, [&](VertexId v) {
    return v.index() < 27 && mesh.points[v.index()][side.axis] == side.sign * half;
  });
  const glm::dvec3 along = unit_vector(arm);
  std::set<std::int32_t> last;
  for (int layer = 1; layer <= layers; ++layer) {
    const std::size_t n_before = mesh.points.size();
    std::vector<glm::dvec3> offsets(n_before, glm::dvec3(0));
    const double reach = half + (glm::length(arm) - half) * layer / layers;
    for (const std::int32_t face : faces) {
      for (const std::int32_t vertex :
           std::as_const(mesh.cells.faces)[static_cast<std::size_t>(face)]) {
        const auto v = static_cast<std::size_t>(vertex);
        glm::dvec3 place = places[v];
        place[side.axis] = 0;
        // Drawn in at the corners, the section is nearly round.
        const bool is_corner = glm::length(place) > 1.2 * half;
        offsets[v] = along * reach + turn * place * (is_corner ? 0.8 : 1.0) - mesh.points[v];
      }
    }
    const Edited grown = extrude_faces_by(mesh, faces, offsets, 1);
    places.resize(grown.mesh.points.size());
    for (std::size_t i = n_before; i < places.size(); ++i) {
      places[i] = places[static_cast<std::size_t>(grown.sources[i][0].vertex)];
    }
    mesh = grown.mesh;
    faces = boundary_faces(mesh, [&](VertexId v) { return v.index() >= n_before; });
    last.clear();
    for (std::size_t i = n_before; i < places.size(); ++i) {
      last.insert(static_cast<std::int32_t>(i));
    }
  }
  return last;
}

/// Wraps all but the arms' ends in a shell.
CellMesh in_shell(const CellMesh& mesh, const std::vector<std::set<std::int32_t>>& ends,
                  const std::vector<Side>& sides, double half, double thickness) {
  const CellComplex complex(mesh.cells);
  Indices faces;
  CompressedRows<std::int32_t> loops;
  for (const FaceId face : complex.faces()) {
    const auto loop = complex.vertices(face);
    const bool is_end = std::any_of(ends.begin(), ends.end(), [&](const auto& end) {
      return std::all_of(loop.begin(), loop.end(),
                         [&](VertexId v) { return end.contains(v.value); });
    });
    if (complex.is_boundary(face) && !is_end) {
      faces.push_back(face.value);
      Indices numbers;
      for (const VertexId vertex : loop) {
        numbers.push_back(vertex.value);
      }
      if (complex.inner_half_face(face).side() != 0) {
        std::reverse(numbers.begin(), numbers.end());
      }
      loops.push_back(numbers);
    }
  }
  std::vector<glm::dvec3> offsets = offsets_along_normals(mesh.points, loops, thickness);
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const auto n_sides = std::count_if(sides.begin(), sides.end(), [&](const Side& side) {
      return i < 27 && mesh.points[i][side.axis] == side.sign * half;
    });
    // Corners stay round, but where arms meet the shell must clear both.
    if (n_sides < 2 && offsets[i] != glm::dvec3(0)) {
      offsets[i] = unit_vector(offsets[i]) * thickness;
    }
  }
  return extrude_faces_by(mesh, faces, offsets, 1).mesh;
}

void check(const JunctionOptions& options, double control_radius) {
  check_point("junction", "the centre", options.center);
  check_size("junction", "the radius", options.radius);
  check_count("junction", "layers", options.layers, 1, 10000);
  check_count("junction", "the number of arms", static_cast<int>(options.arms.size()), 1, 6);
  std::set<Side> sides;
  for (const glm::dvec3& arm : options.arms) {
    check_point("junction", "an arm", arm);
    if (!(glm::length(arm) > 2 * control_radius)) {
      throw ParameterError("junction: an arm must be longer than about twice the radius");
    }
    if (!sides.insert(side_towards(arm)).second) {
      throw ParameterError("junction: two arms point the same way");
    }
  }
}

}  // namespace

CellMesh make_junction(const JunctionOptions& options) {
  const double control_radius = options.radius / radii_of_ring(8).inner;
  check(options, control_radius);
  const double half = control_radius / 2;
  CellMesh mesh = make_box({2, 2, 2}, glm::dvec3(-half), glm::dvec3(half));
  std::vector<std::set<std::int32_t>> ends;
  std::vector<Side> sides;
  for (const glm::dvec3& arm : options.arms) {
    ends.push_back(grow_arm(arm, half, options.layers, mesh));
    sides.push_back(side_towards(arm));
  }
  mesh = in_shell(mesh, ends, sides, half, control_radius - half);
  for (glm::dvec3& point : mesh.points) {
    point += options.center;
  }
  return mesh;
}

}  // namespace espalier
