#pragma once

/// What the viewer asks of a lattice: with grid_elements.h the one place that knows its type.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "deform/scene/scene.h"
#include "lattice/core/compressed_rows.h"

namespace espalier::viewer {

enum class Shape { Rest, Pose };
enum class ElementKind { Vertex, Edge, Face, Cell };

/// Elements of one kind, by index.
using Selection = std::set<std::int32_t>;

/// A lattice's vertices in every element. The vertices are its control points; edges, faces and
/// cells of a grid stand between neighbours on one level.
struct LatticeElements {
  std::int32_t n_vertices = 0;
  CompressedRows<std::int32_t> edges;
  CompressedRows<std::int32_t> faces;  ///< loops
  CompressedRows<std::int32_t> cells;
  CompressedRows<std::int32_t> edge_faces;  ///< the faces at every edge
  CompressedRows<std::int32_t> cell_faces;
  std::vector<bool> is_outer;           ///< #faces: on the boundary
  std::vector<float> edge_sharpness;    ///< #edges; of a grid 0
  std::vector<float> vertex_sharpness;  ///< #vertices
  std::vector<std::int32_t> levels;     ///< #vertices: in a hierarchy; else 0
  std::int32_t n_levels = 1;

  [[nodiscard]] std::size_t count(ElementKind kind) const;
  /// The vertices of one element.
  [[nodiscard]] std::vector<std::int32_t> vertices(ElementKind kind, std::int32_t element) const;
  /// The vertices of all of them.
  [[nodiscard]] Selection vertices(ElementKind kind, const Selection& elements) const;
  /// The elements all of whose vertices are among these.
  [[nodiscard]] Selection within(ElementKind kind, const Selection& vertices) const;
  /// The elements that can be reached from these through common vertices.
  [[nodiscard]] Selection connected(ElementKind kind, const Selection& elements) const;
  /// The edges that go straight on from an edge: at each end the only one that shares no face with
  /// it, as far as there is one and only one.
  [[nodiscard]] Selection loop(std::int32_t edge) const;
  /// #edges: whether some face at the edge is outer, or it has none.
  [[nodiscard]] std::vector<bool> outer_edges() const;
  /// Whether both have the same vertices in the same edges, faces and cells.
  [[nodiscard]] bool is_same_net(const LatticeElements& other) const;
};

[[nodiscard]] LatticeElements elements_of(const Lattice& lattice);

/// Whether two lattices are one and the same value, or copies that share it.
[[nodiscard]] bool is_same(const Lattice& a, const Lattice& b);

/// Throws ParameterError if the scene has no lattice of this name.
[[nodiscard]] std::span<const glm::dvec3> points_of(const Scene& scene, const std::string& lattice,
                                                    Shape shape);

/// The area vector of an outer face, away from its cell; model units². Throws ParameterError unless
/// it is a subdivision lattice.
[[nodiscard]] glm::dvec3 outward_area(const Scene& scene, const std::string& lattice,
                                      std::int32_t face, std::span<const glm::dvec3> points);

}  // namespace espalier::viewer
