#pragma once

/// Where the boundary faces of a frozen volume meet: along seams and at corners.

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "deform/injectivity/face_net.h"
#include "lattice/core/compressed_rows.h"
#include "lattice/volume/volume.h"

namespace espalier {

/// A face of a patch that lies on the volume's boundary.
struct BoundaryFaceId {
  std::int32_t patch = 0;
  int face = 0;  ///< of index_order.h
  bool is_leaf = false;
};

/// A seam is a curve along which faces meet: a stretch of an edge of each.
struct SeamUse {
  std::int32_t seam = 0;
  int across = 0;  ///< the face's parameter that is 0 or 1 on the edge
  int side = 0;    ///< 0 or 1
  /// Of the face's other parameter, at the seam's beginning and end; begin > end if they run
  /// against each other.
  double begin = 0;
  double end = 1;
};

/// A corner is a point where faces meet; `place` in the face lies on its edge.
struct CornerUse {
  std::int32_t corner = 0;
  glm::dvec2 place{0};
};

/// The boundary of a volume at rest and in a pose.
struct BoundaryMesh {
  std::vector<BoundaryFaceId> faces;
  std::vector<FaceNet> rest;
  std::vector<FaceNet> pose;
  double rest_size = 0;               ///< diagonal of the box of the nets at rest
  CompressedRows<SeamUse> seams;      ///< of each face
  CompressedRows<CornerUse> corners;  ///< of each face
};

/// Faces meet where they do at rest and in the pose, within a thousandth of their shorter sides and
/// 1e-9 of the size of the whole, but for round-off; along the edges of leaves, which meet their
/// neighbours only nearly, within a tenth of the leaf's size between corners. A corner may lie
/// within another face's edge, at a dyadic parameter.
/// pose: points of the volume; pose_weights: of its points, if it is rational. O(n log n).
[[nodiscard]] BoundaryMesh boundary_mesh(const Volume& volume, std::span<const glm::dvec3> pose,
                                         std::span<const double> pose_weights);

}  // namespace espalier
