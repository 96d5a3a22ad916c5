#include "tests/support/far_oracle.h"

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <memory>

namespace espalier::test {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

/// A point as OpenSubdiv interpolates it.
struct FarPoint {
  glm::dvec3 at{0};
  void Clear() { at = glm::dvec3(0); }
  void AddWithWeight(const FarPoint& other, double weight) { at += weight * other.at; }
};

}  // namespace

struct FarOracle::Data {
  std::unique_ptr<Far::TopologyRefiner> refiner;
};

FarOracle::FarOracle(int n_vertices, const CompressedRows<std::int32_t>& faces,
                     const Creases& creases, int levels, bool is_corner_sharp)
    : data_(new Data) {
  std::vector<int> sizes;
  for (std::size_t face = 0; face < faces.n_rows(); ++face) {
    sizes.push_back(static_cast<int>(faces[face].size()));
  }
  Far::TopologyDescriptor descriptor;
  descriptor.numVertices = n_vertices;
  descriptor.numFaces = static_cast<int>(sizes.size());
  descriptor.numVertsPerFace = sizes.data();
  descriptor.vertIndicesPerFace = faces.values().data();
  descriptor.numCreases = static_cast<int>(creases.edges.size());
  descriptor.creaseVertexIndexPairs =
      creases.edges.empty() ? nullptr : creases.edges.front().data();
  descriptor.creaseWeights = creases.edge_sharpness.data();
  descriptor.numCorners = static_cast<int>(creases.vertices.size());
  descriptor.cornerVertexIndices = creases.vertices.data();
  descriptor.cornerWeights = creases.vertex_sharpness.data();
  Sdc::Options options;
  options.SetVtxBoundaryInterpolation(is_corner_sharp ? Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER
                                                      : Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  data_->refiner.reset(Factory::Create(descriptor, Factory::Options(Sdc::SCHEME_CATMARK, options)));
  Far::TopologyRefiner::UniformOptions uniform(levels);
  uniform.fullTopologyInLastLevel = true;
  data_->refiner->RefineUniform(uniform);
}

FarOracle::~FarOracle() {
  delete data_;
}

std::vector<glm::dvec3> FarOracle::interpolate(int level,
                                               std::span<const glm::dvec3> points) const {
  std::vector<FarPoint> source(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    source[i].at = points[i];
  }
  std::vector<FarPoint> target(
      static_cast<std::size_t>(data_->refiner->GetLevel(level).GetNumVertices()));
  FarPoint* destination = target.data();
  Far::PrimvarRefinerReal<double>(*data_->refiner).Interpolate(level, source.data(), destination);
  std::vector<glm::dvec3> result;
  for (const FarPoint& point : target) {
    result.push_back(point.at);
  }
  return result;
}

std::vector<FarOracle::Element> FarOracle::elements(int level) const {
  const Far::TopologyLevel& topology = data_->refiner->GetLevel(level);
  std::vector<Element> elements;
  for (int vertex = 0; vertex < topology.GetNumVertices(); ++vertex) {
    elements.push_back({{vertex}, topology.GetVertexChildVertex(vertex)});
  }
  for (int edge = 0; edge < topology.GetNumEdges(); ++edge) {
    const Far::ConstIndexArray ends = topology.GetEdgeVertices(edge);
    elements.push_back({{ends[0], ends[1]}, topology.GetEdgeChildVertex(edge)});
  }
  for (int face = 0; face < topology.GetNumFaces(); ++face) {
    const Far::ConstIndexArray loop = topology.GetFaceVertices(face);
    elements.push_back(
        {std::vector<int>(loop.begin(), loop.end()), topology.GetFaceChildVertex(face)});
  }
  return elements;
}

}  // namespace espalier::test
