#include "tests/support/bfr_oracle.h"

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <array>
#include <glm/gtc/type_ptr.hpp>

namespace espalier::test {
namespace {

namespace Bfr = OpenSubdiv::Bfr;
namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

using Surface = Bfr::Surface<double>;

std::unique_ptr<Far::TopologyRefiner> refiner_of(int n_vertices,
                                                 const CompressedRows<std::int32_t>& faces) {
  std::vector<int> sizes;
  for (std::size_t face = 0; face < faces.n_rows(); ++face) {
    sizes.push_back(static_cast<int>(faces[face].size()));
  }
  Far::TopologyDescriptor descriptor;
  descriptor.numVertices = n_vertices;
  descriptor.numFaces = static_cast<int>(sizes.size());
  descriptor.numVertsPerFace = sizes.data();
  descriptor.vertIndicesPerFace = faces.values().data();
  Sdc::Options options;
  options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  return std::unique_ptr<Far::TopologyRefiner>(
      Factory::Create(descriptor, Factory::Options(Sdc::SCHEME_CATMARK, options)));
}

}  // namespace

struct BfrOracle::Data {
  std::unique_ptr<Far::TopologyRefiner> refiner;
  std::vector<Surface> surfaces;
};

BfrOracle::BfrOracle(int n_vertices, const CompressedRows<std::int32_t>& faces)
    : data_(std::make_unique<Data>()) {
  data_->refiner = refiner_of(n_vertices, faces);
  Bfr::SurfaceFactory::Options options;
  options.SetApproxLevelSmooth(10);
  const Bfr::RefinerSurfaceFactory<> factory(*data_->refiner, options);
  data_->surfaces.resize(faces.n_rows());
  for (std::size_t face = 0; face < faces.n_rows(); ++face) {
    factory.InitVertexSurface(static_cast<int>(face), &data_->surfaces[face]);
  }
}

BfrOracle::BfrOracle(BfrOracle&&) noexcept = default;
BfrOracle::~BfrOracle() = default;

std::vector<glm::dvec2> BfrOracle::exact_parameters(int face) const {
  const Bfr::Parameterization parameterization =
      data_->surfaces[static_cast<std::size_t>(face)].GetParameterization();
  const bool is_quadrilateral = parameterization.GetType() == Bfr::Parameterization::QUAD;
  const int n_parts = is_quadrilateral ? 1 : parameterization.GetFaceSize();
  const double near = is_quadrilateral ? 1.0 / 64 : 1.0 / 32;
  const std::array<double, 7> places = {0, near, 0.2, 0.5, 0.7, 1 - near, 1};
  std::vector<glm::dvec2> result;
  for (int part = 0; part < n_parts; ++part) {
    for (const double u : places) {
      for (const double v : places) {
        glm::dvec2 place(u, v);
        if (!is_quadrilateral) {
          const glm::dvec2 in_part = place;
          parameterization.ConvertNormalizedSubFaceToCoord(part, glm::value_ptr(in_part),
                                                           glm::value_ptr(place));
        }
        result.push_back(place);
      }
    }
  }
  return result;
}

std::vector<glm::dvec3> BfrOracle::limits(int face, std::span<const glm::dvec2> parameters,
                                          std::span<const glm::dvec3> points) const {
  const Surface& surface = data_->surfaces[static_cast<std::size_t>(face)];
  std::vector<glm::dvec3> patch_points(static_cast<std::size_t>(surface.GetNumPatchPoints()));
  surface.PreparePatchPoints(glm::value_ptr(points[0]), 3, glm::value_ptr(patch_points[0]), 3);
  std::vector<glm::dvec3> result;
  for (const glm::dvec2& place : parameters) {
    glm::dvec3 limit;
    surface.Evaluate(glm::value_ptr(place), glm::value_ptr(patch_points[0]), 3,
                     glm::value_ptr(limit));
    result.push_back(limit);
  }
  return result;
}

}  // namespace espalier::test
