#include "tests/support/random_edits.h"

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "lattice/build/cells.h"
#include "lattice/build/extrude_faces.h"
#include "lattice/build/primitives.h"
#include "lattice/build/reshape.h"
#include "lattice/build/split.h"
#include "lattice/build/weld.h"
#include "lattice/core/error.h"
#include "lattice/subdivision/edit.h"
#include "lattice/topology/crease.h"
#include "tests/support/families.h"

namespace espalier::test {
namespace {

using Indices = std::vector<std::int32_t>;

std::size_t below(std::size_t n, std::mt19937& random) {
  return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
}

double between(double low, double high, std::mt19937& random) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

glm::dvec3 vector_within(double size, std::mt19937& random) {
  const double x = between(-size, size, random);
  const double y = between(-size, size, random);
  return {x, y, between(-size, size, random)};
}

/// Up to `most` distinct indices below n.
Indices some_of(std::size_t n, std::size_t most, std::mt19937& random) {
  Indices indices;
  const std::size_t n_wanted = 1 + below(most, random);
  for (std::size_t i = 0; i < n_wanted; ++i) {
    const auto index = static_cast<std::int32_t>(below(n, random));
    if (std::find(indices.begin(), indices.end(), index) == indices.end()) {
      indices.push_back(index);
    }
  }
  return indices;
}

/// Marks some edges and vertices of the boundary, or clears them; of any edge: inner ones are
/// refused.
SubdivisionLattice random_crease(SubdivisionLattice lattice, std::mt19937& random) {
  const CellComplex& complex = *lattice.complex;
  std::vector<EdgeId> edges;
  for (const std::int32_t edge : some_of(complex.n_edges(), 4, random)) {
    edges.push_back(EdgeId{edge});
  }
  if (below(3, random) == 0) {
    edges = boundary_line(complex, edges.front());
  }
  std::vector<VertexId> vertices;
  for (const std::int32_t vertex : some_of(complex.n_vertices(), 2, random)) {
    vertices.push_back(VertexId{vertex});
  }
  const bool is_mark = below(2, random) == 0;
  lattice.sharpness = with_tags(complex, std::move(lattice.sharpness), edges, vertices,
                                is_mark ? static_cast<float>(between(0.5, 12, random)) : 0.0F);
  return lattice;
}

using MeshEdit = std::function<Edited(const CellMesh&, std::mt19937&)>;

Edited random_extrusion(const CellMesh& mesh, std::mt19937& random) {
  const Indices faces = some_of(mesh.cells.faces.n_rows(), 3, random);
  const int layers = 1 + static_cast<int>(below(2, random));
  return below(2, random) == 0
             ? extrude_faces_along(mesh, faces, vector_within(1, random), layers)
             : extrude_faces_outward(mesh, faces, between(-0.3, 0.7, random), layers);
}

/// Boundary faces that share an edge; in a corner that points inward a cell fits between them.
Indices neighbouring_faces(const CellMesh& mesh, std::mt19937& random) {
  const CellComplex complex(mesh.cells);
  Indices faces;
  while (faces.empty()) {
    const EdgeId edge{static_cast<std::int32_t>(below(complex.n_edges(), random))};
    for (const HalfFaceId half_face : complex.half_faces(edge)) {
      if (complex.is_boundary(half_face.face()) && complex.half_faces(edge).size() > 2) {
        faces.push_back(half_face.face().value);
      }
    }
    if (below(20, random) == 0) {
      return {0, 1};
    }
  }
  return faces;
}

Edited random_cell(const CellMesh& mesh, std::mt19937& random) {
  const Indices faces = neighbouring_faces(mesh, random);
  if (below(2, random) == 0) {
    return bridge_faces(mesh, faces.front(), faces.back());
  }
  return below(2, random) == 0
             ? add_spanned_cell(mesh, faces, {})
             : add_spanned_cell(mesh, Indices{faces[0]}, some_of(mesh.points.size(), 2, random));
}

Edited random_split(const CellMesh& mesh, std::mt19937& random) {
  const auto loop = std::as_const(mesh.cells.faces)[below(mesh.cells.faces.n_rows(), random)];
  return split_layer(mesh, loop[0], loop[1], between(0.1, 0.9, random));
}

Edited random_placement(const CellMesh& mesh, std::mt19937& random) {
  Placement placement;
  placement.linear =
      rotation(vector_within(1, random), between(-20, 20, random)) * between(0.8, 1.2, random);
  placement.about = mesh.points[below(mesh.points.size(), random)];
  placement.by = vector_within(0.2, random);
  return placed(mesh, some_of(mesh.points.size(), 4, random), placement);
}

const std::vector<std::pair<std::string, MeshEdit>>& mesh_edits() {
  static const std::vector<std::pair<std::string, MeshEdit>> kEdits = {
      {"extrude", random_extrusion},
      {"attach", random_cell},
      {"split", random_split},
      {"transform", random_placement},
      {"weld", [](const CellMesh& mesh,
                  std::mt19937& random) { return weld(mesh, between(0, 0.4, random)); }},
      {"mirror",
       [](const CellMesh& mesh, std::mt19937& random) {
         const glm::dvec3 at = mesh.points[below(mesh.points.size(), random)];
         const auto axis = static_cast<int>(below(3, random));
         glm::dvec3 normal(0);
         normal[axis] = 1;
         return mirror(mesh, at, normal, 0.01);
       }},
      {"delete",
       [](const CellMesh& mesh, std::mt19937& random) {
         return delete_cells(mesh, some_of(mesh.cells.cells.n_rows(), 2, random));
       }},
      {"relax",
       [](const CellMesh& mesh, std::mt19937& random) {
         return relaxed(mesh, 1 + static_cast<int>(below(3, random)));
       }},
  };
  return kEdits;
}

}  // namespace

RandomEdit random_edit(const SubdivisionLattice& lattice, std::mt19937& random) {
  const auto& edits = mesh_edits();
  const std::size_t kind = below(edits.size() + 2, random);
  const std::string name = kind < edits.size()    ? edits[kind].first
                           : kind == edits.size() ? "merge"
                                                  : "crease";
  RandomEdit edit{name, {}, ""};
  try {
    if (kind < edits.size()) {
      edit.result = edited_lattice(lattice, edits[kind].second(mesh_of(lattice), random));
    } else if (kind == edits.size()) {
      const glm::dvec3 at = lattice.rest[below(lattice.rest.size(), random)];
      edit.result = merged_lattice(lattice, lattice_from(make_box({1, 1, 1}, at, at + 1.0)), 1e-6);
    } else {
      edit.result = random_crease(lattice, random);
    }
  } catch (const Error& error) {
    edit.refusal = error.what();
  }
  return edit;
}

SubdivisionLattice random_seed(std::mt19937& random) {
  const std::vector<std::function<SubdivisionLattice()>> seeds = {
      [] {
        return lattice_from(make_box({2, 1, 1}, {0, 0, 0}, {2, 1, 1}));
      },
      [] {
        return lattice_from(make_box({2, 2, 2}, {0, 0, 0}, {2, 2, 2}));
      },
      [] { return lattice_from(make_cylinder({.sectors = 5, .layers = 2})); },
      pyramid_on_cube,
      six_tetrahedra,
      cubes_sharing_edge,
      plus_of_cubes};
  SubdivisionLattice lattice = seeds[below(seeds.size(), random)]();
  if (below(2, random) == 0) {
    lattice.pose = jittered(lattice.rest, 0.5, static_cast<unsigned>(random()));
  }
  if (below(2, random) == 0) {
    for (const EdgeId edge : lattice.complex->edges()) {
      if (lattice.complex->is_boundary(edge) && below(3, random) == 0) {
        lattice.sharpness.edges[edge] = static_cast<float>(below(5, random));
      }
    }
  }
  return lattice;
}

}  // namespace espalier::test
