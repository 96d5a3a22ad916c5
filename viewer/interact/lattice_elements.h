#pragma once

/// What the viewer asks of a lattice: the one place that knows its type.

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

/// A lattice's vertices in every element.
struct LatticeElements {
  std::int32_t n_vertices = 0;
  CompressedRows<std::int32_t> edges;
  CompressedRows<std::int32_t> faces;  ///< loops
  CompressedRows<std::int32_t> cells;
  CompressedRows<std::int32_t> edge_faces;  ///< the faces at every edge
  std::vector<bool> is_outer;               ///< #faces: on the boundary

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
};

/// Throw ParameterError if the scene has no lattice of this name.
[[nodiscard]] LatticeElements elements_of(const Scene& scene, const std::string& lattice);
[[nodiscard]] std::span<const glm::dvec3> points_of(const Scene& scene, const std::string& lattice,
                                                    Shape shape);

/// The area vector of an outer face, away from its cell; model units².
[[nodiscard]] glm::dvec3 outward_area(const Scene& scene, const std::string& lattice,
                                      std::int32_t face, std::span<const glm::dvec3> points);

}  // namespace espalier::viewer
