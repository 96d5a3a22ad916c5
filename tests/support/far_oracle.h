#pragma once

/// OpenSubdiv's own uniform refinement of a polygon mesh, in double: the oracle for boundaries and
/// cross-sections.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lattice/core/compressed_rows.h"

namespace espalier::test {

/// A refined polygon mesh that remembers what its vertices come from.
class FarOracle {
 public:
  struct Creases {
    std::vector<std::array<int, 2>> edges;
    std::vector<float> edge_sharpness;
    std::vector<int> vertices;
    std::vector<float> vertex_sharpness;
  };

  /// is_corner_sharp: VTX_BOUNDARY_EDGE_AND_CORNER, else edge only.
  FarOracle(int n_vertices, const CompressedRows<std::int32_t>& faces, const Creases& creases,
            int levels, bool is_corner_sharp);
  FarOracle(const FarOracle&) = delete;
  FarOracle& operator=(const FarOracle&) = delete;
  ~FarOracle();

  /// The points of `level` (1 …) for the points of the level before.
  [[nodiscard]] std::vector<glm::dvec3> interpolate(int level,
                                                    std::span<const glm::dvec3> points) const;

  /// The vertices of an edge or face of `level`, and the vertex of the next level that stands for
  /// it.
  struct Element {
    std::vector<int> vertices;
    int refined_vertex;
  };
  /// All vertices, edges and faces of `level` (0 …).
  [[nodiscard]] std::vector<Element> elements(int level) const;

 private:
  struct Data;
  Data* data_;
};

}  // namespace espalier::test
