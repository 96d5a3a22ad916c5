#pragma once

/// The refinement rules of Catmull-Clark volumes inside the lattice, as weights: [MJ96]
/// section 2.2, with one rule of our own. The boundary follows the surface rules of
/// lattice/osd/crease_masks.h.
///
/// All weights are of means: of the centroids of the cells and faces at an element, of the
/// midpoints of its edges. Each mask sums to 1.

namespace espalier {

/// F = (C0 + 2A + C1) / 4.
struct FacePointMask {
  double cells = 1.0 / 2;  ///< mean of the two cells' centroids
  double centroid = 1.0 / 2;
};

/// E = (Cavg + 2 Aavg + (n − 3) M) / n for an edge with n faces.
struct EdgePointMask {
  double cells;
  double faces;
  double midpoint;
};
[[nodiscard]] constexpr EdgePointMask edge_point_mask(int n_faces) {
  const double n = n_faces;
  return {1 / n, 2 / n, (n - 3) / n};
}

/// V = (Cavg + 3 Aavg + 3 Mavg + P) / 8.
struct VertexPointMask {
  double cells = 1.0 / 8;
  double faces = 3.0 / 8;
  double edges = 3.0 / 8;
  double vertex = 1.0 / 8;
};

/// V = (Cavg + 2 Av + Ah + 2 Mh + (n − 3)(Mz + P)) / 2n for a vertex on a line of valence n: where
/// [MJ96]'s rule gives a volume of its own, this one gives Catmull-Clark surface across × uniform
/// cubic B-spline along. The two are equal for n = 4.
struct LineVertexMask {
  double cells;
  double line_faces;   ///< the 2n faces that contain an edge of the line
  double cross_faces;  ///< the n others
  double cross_edges;  ///< the n edges that are not the line's
  double line_edges;   ///< the two that are
  double vertex;
};
[[nodiscard]] constexpr LineVertexMask line_vertex_mask(int valence) {
  const double n = valence;
  return {1 / (2 * n), 1 / n, 1 / (2 * n), 1 / n, (n - 3) / (2 * n), (n - 3) / (2 * n)};
}

}  // namespace espalier
