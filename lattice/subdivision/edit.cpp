#include "lattice/subdivision/edit.h"

#include <algorithm>
#include <array>
#include <utility>

#include "lattice/build/weld.h"
#include "lattice/topology/validate.h"

namespace espalier {
namespace {

/// Tags of one old element, and what they would be automatically.
struct Tag {
  float value = 0;
  float automatic = 0;
};

/// The tag of an element made from old ones. `automatic`: of its new place.
float inherited(std::span<const Tag> origins, float automatic, bool is_boundary) {
  bool is_by_hand = false;
  float sharpest = 0;
  for (const Tag& tag : origins) {
    if (tag.value != tag.automatic) {
      sharpest = is_by_hand ? std::max(sharpest, tag.value) : tag.value;
      is_by_hand = true;
    }
  }
  return !is_boundary ? 0 : is_by_hand ? sharpest : automatic;
}

/// Finds what elements of an edited lattice were made from.
class Origins {
 public:
  Origins(const SubdivisionLattice& old_lattice, const Edited& edit, const CellComplex& complex)
      : old_(old_lattice),
        edit_(edit),
        automatic_(automatic_sharpness(*old_lattice.complex)),
        edges_(complex.n_edges()) {
    for (const EdgeId edge : old_.complex->edges()) {
      const auto [a, b] = old_.complex->vertices(edge);
      const VertexId from{edit.map.vertices[a.index()]};
      const VertexId to{edit.map.vertices[b.index()]};
      if (from.is_valid() && to.is_valid()) {
        if (const EdgeId now = complex.find_edge(from, to); now.is_valid()) {
          edges_[now].push_back(edge);
        }
      }
    }
  }

  [[nodiscard]] std::vector<Tag> of(VertexId vertex) const {
    std::vector<Tag> tags;
    const auto sources = edit_.sources[vertex.index()];
    const bool is_itself = std::all_of(sources.begin(), sources.end(), [&](const Source& source) {
      return edit_.map.vertices[static_cast<std::size_t>(source.vertex)] == vertex.value;
    });
    if (is_itself || sources.size() == 1) {
      for (const Source& source : sources) {
        const VertexId old{source.vertex};
        tags.push_back({old_.sharpness.vertices[old], automatic_.vertices[old]});
      }
    }
    return tags;
  }

  /// `ends`: of the new edge.
  [[nodiscard]] std::vector<Tag> of(EdgeId edge, const std::array<VertexId, 2>& ends) const {
    std::vector<Tag> tags;
    for (const EdgeId old : edges_[edge]) {
      tags.push_back({old_.sharpness.edges[old], automatic_.edges[old]});
    }
    if (tags.empty()) {
      if (const EdgeId old = copied_edge(ends); old.is_valid()) {
        tags.push_back({old_.sharpness.edges[old], automatic_.edges[old]});
      }
    }
    return tags;
  }

 private:
  /// The old edge that joins all that both ends were made from.
  [[nodiscard]] EdgeId copied_edge(const std::array<VertexId, 2>& ends) const {
    std::vector<std::int32_t> vertices;
    for (const VertexId end : ends) {
      for (const Source& source : edit_.sources[end.index()]) {
        vertices.push_back(source.vertex);
      }
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices.size() == 2
               ? old_.complex->find_edge(VertexId{vertices[0]}, VertexId{vertices[1]})
               : EdgeId{};
  }

  const SubdivisionLattice& old_;
  const Edited& edit_;
  Sharpness automatic_;
  IdVector<EdgeId, std::vector<EdgeId>> edges_;  // old edges that lie on each new one
};

Sharpness followed_sharpness(const SubdivisionLattice& old_lattice, const Edited& edit,
                             const CellComplex& complex) {
  Sharpness sharpness = automatic_sharpness(complex);
  if (old_lattice.sharpness == automatic_sharpness(*old_lattice.complex)) {
    return sharpness;
  }
  if (old_lattice.sharpness == smooth_sharpness(*old_lattice.complex)) {
    return smooth_sharpness(complex);
  }
  const Origins origins(old_lattice, edit, complex);
  for (const EdgeId edge : complex.edges()) {
    float& tag = sharpness.edges[edge];
    tag = inherited(origins.of(edge, complex.vertices(edge)), tag, complex.is_boundary(edge));
  }
  for (const VertexId vertex : complex.vertices()) {
    float& tag = sharpness.vertices[vertex];
    tag = inherited(origins.of(vertex), tag, complex.is_boundary(vertex));
  }
  return sharpness;
}

std::vector<glm::dvec3> followed_pose(const SubdivisionLattice& old_lattice, const Edited& edit) {
  if (old_lattice.pose.empty()) {
    return {};
  }
  std::vector<glm::dvec3> pose = edit.mesh.points;
  for (std::size_t i = 0; i < pose.size(); ++i) {
    glm::dvec3 displacement(0);
    for (const Source& source : edit.sources[i]) {
      const auto old = static_cast<std::size_t>(source.vertex);
      displacement += source.weight * (old_lattice.pose[old] - old_lattice.rest[old]);
    }
    pose[i] += edit.turns[i] * displacement;
  }
  return pose;
}

/// Copies a lattice's tags to where its elements are in a larger one.
void copy_tags(const SubdivisionLattice& part, std::int32_t shift, SubdivisionLattice& whole) {
  const auto shifted = [shift](VertexId vertex) { return VertexId{vertex.value + shift}; };
  for (const EdgeId edge : part.complex->edges()) {
    const auto [a, b] = part.complex->vertices(edge);
    whole.sharpness.edges[whole.complex->find_edge(shifted(a), shifted(b))] =
        part.sharpness.edges[edge];
  }
  for (const VertexId vertex : part.complex->vertices()) {
    whole.sharpness.vertices[shifted(vertex)] = part.sharpness.vertices[vertex];
  }
}

}  // namespace

CellMesh mesh_of(const SubdivisionLattice& lattice) {
  return {lattice.complex->polyhedra(), lattice.rest};
}

SubdivisionLattice edited_lattice(const SubdivisionLattice& lattice, Edited edit,
                                  const Progress& progress) {
  SubdivisionLattice result;
  result.complex = valid_complex(edit.mesh.cells, edit.mesh.points, progress);
  result.sharpness = followed_sharpness(lattice, edit, *result.complex);
  result.pose = followed_pose(lattice, edit);
  result.rest = std::move(edit.mesh.points);
  result.scheme = lattice.scheme;
  result.extra_json = lattice.extra_json;
  return result;
}

SubdivisionLattice merged_lattice(const SubdivisionLattice& first, const SubdivisionLattice& second,
                                  double tolerance, const Progress& progress) {
  CellMesh mesh = side_by_side(mesh_of(first), mesh_of(second));
  SubdivisionLattice both;
  both.complex = std::make_shared<const CellComplex>(CellComplex::from_valid(mesh.cells));
  both.rest = mesh.points;
  if (!first.pose.empty() || !second.pose.empty()) {
    both.pose.assign(first.posed_points().begin(), first.posed_points().end());
    both.pose.insert(both.pose.end(), second.posed_points().begin(), second.posed_points().end());
  }
  both.sharpness = smooth_sharpness(*both.complex);
  copy_tags(first, 0, both);
  copy_tags(second, static_cast<std::int32_t>(first.complex->n_vertices()), both);
  both.scheme = first.scheme;
  both.extra_json = first.extra_json;
  return edited_lattice(both, weld(mesh, tolerance), progress);
}

}  // namespace espalier
