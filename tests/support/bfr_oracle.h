#pragma once

/// OpenSubdiv's evaluation of Catmull-Clark limit surfaces at any parameter, in double: the oracle
/// for cross-sections.

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "lattice/core/compressed_rows.h"

namespace espalier::test {

/// The limit surface of a polygon mesh; boundary edges and corners are sharp
/// (VTX_BOUNDARY_EDGE_AND_CORNER). Extraordinary corners are isolated over ten levels. Exact at the
/// corner itself and, in quadrilaterals, at parameters at least 2⁻⁸ from it; in other faces, whose
/// quarters have an extraordinary corner at their middle too, at least 2⁻⁵ of the quarter from it
/// (at 2⁻⁶ it was seen to be off by 1e-4). Approximate between.
class BfrOracle {
 public:
  BfrOracle(int n_vertices, const CompressedRows<std::int32_t>& faces);
  BfrOracle(BfrOracle&&) noexcept;
  ~BfrOracle();

  /// Parameters of a face where evaluation is exact: near every corner, on its edges and inside.
  [[nodiscard]] std::vector<glm::dvec2> exact_parameters(int face) const;

  /// The surface at parameters of a face. points: one a vertex of the mesh.
  [[nodiscard]] std::vector<glm::dvec3> limits(int face, std::span<const glm::dvec2> parameters,
                                               std::span<const glm::dvec3> points) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace espalier::test
