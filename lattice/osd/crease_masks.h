#pragma once

/// The Catmull-Clark surface rules with creases, as OpenSubdiv defines them (its Sdc layer):
/// weights over the boundary faces and edges at one boundary edge or vertex.

#include <array>
#include <span>
#include <vector>

namespace espalier::osd {

/// Weights of an edge point; they sum to 1.
struct EdgeMask {
  std::array<double, 2> ends;
  std::array<double, 2> face_centroids;
};

/// Weights of a vertex point; they sum to 1.
struct VertexMask {
  double vertex = 0;
  std::vector<double> other_ends;      ///< one for the far vertex of each edge
  std::vector<double> face_centroids;  ///< one for each face
};

/// The rule for an edge between two faces. Where more than two meet it must be infinitely sharp.
[[nodiscard]] EdgeMask edge_mask(float sharpness);

/// The rule for a vertex. edges: the sharpness of each boundary edge at it; #faces = #edges unless
/// the vertex or two or more of its edges are sharp. Throws LatticeError beyond 50,000 edges.
[[nodiscard]] VertexMask vertex_mask(float sharpness, std::span<const float> edges,
                                     std::size_t n_faces);

/// Weights of the limit position of a vertex whose sharpness and whose edges' sharpness are 0 or
/// infinite, all faces quadrilaterals: the vertex, the far ends of its edges, and the opposite
/// corners of its faces (in face_centroids). Throws as vertex_mask.
[[nodiscard]] VertexMask vertex_limit_mask(float sharpness, std::span<const float> edges,
                                           std::size_t n_faces);

/// Sharpness after one step of refinement: one less, but infinite stays infinite.
[[nodiscard]] float refined_sharpness(float sharpness);

}  // namespace espalier::osd
