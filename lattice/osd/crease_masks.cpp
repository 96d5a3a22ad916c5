#include "lattice/osd/crease_masks.h"

#include <opensubdiv/sdc/catmarkScheme.h>
#include <opensubdiv/sdc/crease.h>

#include <algorithm>

#include "lattice/core/error.h"

namespace espalier::osd {
namespace {

using OpenSubdiv::Sdc::Crease;
using OpenSubdiv::Sdc::Options;
using CatmarkScheme = OpenSubdiv::Sdc::Scheme<OpenSubdiv::Sdc::SCHEME_CATMARK>;

/// OpenSubdiv keeps its buffers for a vertex on the stack.
constexpr std::size_t kLargestValence = 50000;

Options options() {
  Options result;
  result.SetVtxBoundaryInterpolation(Options::VTX_BOUNDARY_EDGE_ONLY);
  return result;
}

/// The mask that Sdc writes into.
class Mask {
 public:
  using Weight = double;

  Mask(std::size_t n_vertices, std::size_t n_edges, std::size_t n_faces)
      : vertices_(n_vertices), edges_(n_edges), faces_(n_faces) {}

  void SetNumVertexWeights(int n) { n_vertices_ = n; }
  void SetNumEdgeWeights(int n) { n_edges_ = n; }
  void SetNumFaceWeights(int n) { n_faces_ = n; }
  [[nodiscard]] int GetNumVertexWeights() const { return n_vertices_; }
  [[nodiscard]] int GetNumEdgeWeights() const { return n_edges_; }
  [[nodiscard]] int GetNumFaceWeights() const { return n_faces_; }
  double& VertexWeight(int i) { return vertices_[static_cast<std::size_t>(i)]; }
  double& EdgeWeight(int i) { return edges_[static_cast<std::size_t>(i)]; }
  double& FaceWeight(int i) { return faces_[static_cast<std::size_t>(i)]; }
  void SetFaceWeightsForFaceCenters(bool is_on) { is_for_centroids_ = is_on; }
  [[nodiscard]] bool AreFaceWeightsForFaceCenters() const { return is_for_centroids_; }

 private:
  std::vector<double> vertices_, edges_, faces_;
  int n_vertices_ = 0, n_edges_ = 0, n_faces_ = 0;
  bool is_for_centroids_ = true;
};

/// What Sdc asks of an edge.
struct EdgeNeighborhood {
  float sharpness;

  [[nodiscard]] int GetNumFaces() const { return 2; }
  [[nodiscard]] float GetSharpness() const { return sharpness; }
  void GetChildSharpnesses(const Crease& crease, float children[2]) const {
    children[0] = children[1] = crease.SubdivideUniformSharpness(sharpness);
  }
  void GetNumVerticesPerFace(int n[2]) const { n[0] = n[1] = 4; }
};

/// What Sdc asks of a vertex.
struct VertexNeighborhood {
  float sharpness;
  std::span<const float> edges;
  std::size_t n_faces;

  [[nodiscard]] int GetNumEdges() const { return static_cast<int>(edges.size()); }
  [[nodiscard]] int GetNumFaces() const { return static_cast<int>(n_faces); }
  [[nodiscard]] float GetSharpness() const { return sharpness; }
  float* GetSharpnessPerEdge(float* out) const {
    std::copy(edges.begin(), edges.end(), out);
    return out;
  }
  [[nodiscard]] float GetChildSharpness(const Crease& crease) const {
    return crease.SubdivideVertexSharpness(sharpness);
  }
  float* GetChildSharpnessPerEdge(const Crease& crease, float* out) const {
    std::transform(edges.begin(), edges.end(), out,
                   [&](float edge) { return crease.SubdivideUniformSharpness(edge); });
    return out;
  }
};

void check_valence(std::size_t n_edges) {
  if (n_edges > kLargestValence) {
    throw LatticeError("a boundary vertex has " + std::to_string(n_edges) +
                       " edges, at most 50000 can be refined");
  }
}

VertexMask to_vertex_mask(Mask& mask, std::size_t n_edges, std::size_t n_faces) {
  VertexMask result{mask.VertexWeight(0), std::vector<double>(n_edges, 0.0),
                    std::vector<double>(n_faces, 0.0)};
  for (int i = 0; i < mask.GetNumEdgeWeights(); ++i) {
    result.other_ends[static_cast<std::size_t>(i)] = mask.EdgeWeight(i);
  }
  for (int i = 0; i < mask.GetNumFaceWeights(); ++i) {
    result.face_centroids[static_cast<std::size_t>(i)] = mask.FaceWeight(i);
  }
  return result;
}

}  // namespace

EdgeMask edge_mask(float sharpness) {
  Mask mask(2, 0, 2);
  CatmarkScheme(options()).ComputeEdgeVertexMask(EdgeNeighborhood{sharpness}, mask);
  EdgeMask result{{mask.VertexWeight(0), mask.VertexWeight(1)}, {0, 0}};
  for (int i = 0; i < mask.GetNumFaceWeights(); ++i) {
    result.face_centroids[static_cast<std::size_t>(i)] = mask.FaceWeight(i);
  }
  return result;
}

VertexMask vertex_mask(float sharpness, std::span<const float> edges, std::size_t n_faces) {
  check_valence(edges.size());
  Mask mask(1, edges.size(), n_faces);
  CatmarkScheme(options()).ComputeVertexVertexMask(VertexNeighborhood{sharpness, edges, n_faces},
                                                   mask);
  return to_vertex_mask(mask, edges.size(), n_faces);
}

VertexMask vertex_limit_mask(float sharpness, std::span<const float> edges, std::size_t n_faces) {
  check_valence(edges.size());
  Mask mask(1, edges.size(), n_faces);
  const auto rule = Crease(options()).DetermineVertexVertexRule(
      sharpness, static_cast<int>(edges.size()), edges.data());
  CatmarkScheme(options()).ComputeVertexLimitMask(VertexNeighborhood{sharpness, edges, n_faces},
                                                  mask, rule);
  return to_vertex_mask(mask, edges.size(), n_faces);
}

float refined_sharpness(float sharpness) {
  return Crease(options()).SubdivideUniformSharpness(sharpness);
}

}  // namespace espalier::osd
