#pragma once

/// What becomes of a model's normals when it deforms.

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "deform/model/model.h"
#include "lattice/core/compressed_rows.h"

namespace espalier {

/// Unit normals no farther apart than this are one.
inline constexpr double kSameNormal = 1e-6;

/// `v` at length 1, or zero if it has no direction (zero or not finite).
[[nodiscard]] glm::dvec3 unit_or_zero(glm::dvec3 v);

/// How each normal of a file changes.
struct NormalPlan {
  /// Row k: the values that normal k takes, at least one; the first replaces it, or equals it bit
  /// for bit if it stays.
  CompressedRows<glm::dvec3> values;
  /// #pairs: index in the row of its normal.
  std::vector<std::int32_t> value_of_pair;
};

/// A normal takes several values where the pairs that share it differ by more than kSameNormal.
/// One that stays within kSameNormal of its old direction stays as it is, as does one whose new
/// direction is zero or not finite. pair_normals: #pairs × 3, parallel to model.pairs().
[[nodiscard]] NormalPlan split_normals(const Model& model,
                                       std::span<const glm::dvec3> pair_normals);

/// As split_normals, but every normal takes one value, the mean direction of its pairs.
[[nodiscard]] NormalPlan average_normals(const Model& model,
                                         std::span<const glm::dvec3> pair_normals);

/// Normals for a model that has none: each of one point, used at some of its corners.
struct CornerNormals {
  std::vector<std::int32_t> points;      ///< #normals, ascending
  std::vector<glm::dvec3> normals;       ///< #normals × 3, unit
  std::vector<std::int32_t> of_corners;  ///< #corners: the normal at each
};

/// Where an edge is sharp.
struct SharpEdges {
  double angle = 40;  ///< degrees between the normals of its faces; larger ones are sharp
  /// #faces, or empty: then instead, where two faces are not of one group; 0 is none.
  std::vector<std::int64_t> smoothing_groups = {};
};

/// At each point one normal for the corners that hang together over edges that are not sharp: the
/// sum of their faces' normals, weighted by the angles at the corners [TW98]; (0, 0, 1) where the
/// faces leave it open. O(#corners log #corners).
[[nodiscard]] CornerNormals corner_normals(std::span<const glm::dvec3> points,
                                           const CompressedRows<std::int32_t>& faces,
                                           const SharpEdges& sharp = {});

/// #faces: the smoothing group (`s`) of each face of an OBJ file, 0 for none or off; empty if the
/// model's file has no smoothing groups.
[[nodiscard]] std::vector<std::int64_t> smoothing_groups(const Model& model);

}  // namespace espalier
