#include "lattice/osd/refine_surface.h"

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>

#include "lattice/core/error.h"

namespace espalier::osd {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

constexpr double kMostFaces = 50e6;

/// A point as OpenSubdiv interpolates it.
struct SurfacePoint {
  glm::dvec3 at{0};
  void Clear() { at = glm::dvec3(0); }
  void AddWithWeight(const SurfacePoint& other, double weight) { at += weight * other.at; }
};

void check(const CompressedRows<std::int32_t>& faces, int levels) {
  if (faces.empty()) {
    throw ParameterError("refine: the mesh has no faces");
  }
  double n_faces = static_cast<double>(faces.n_values());
  for (int level = 1; level < levels; ++level) {
    n_faces *= 4;
  }
  if (n_faces > kMostFaces) {
    throw ParameterError("refine: more than 50 million faces; refine fewer times");
  }
  for (std::size_t face = 0; face < faces.n_rows(); ++face) {
    std::vector<std::int32_t> loop(faces[face].begin(), faces[face].end());
    std::sort(loop.begin(), loop.end());
    const auto twice = std::adjacent_find(loop.begin(), loop.end());
    if (twice != loop.end()) {
      throw ParameterError("refine: face " + std::to_string(face) + " contains point " +
                           std::to_string(*twice) + " twice");
    }
  }
}

std::unique_ptr<Far::TopologyRefiner> make_refiner(int n_points, const std::vector<int>& sizes,
                                                   const std::vector<int>& corners, int levels) {
  Far::TopologyDescriptor descriptor;
  descriptor.numVertices = n_points;
  descriptor.numFaces = static_cast<int>(sizes.size());
  descriptor.numVertsPerFace = sizes.data();
  descriptor.vertIndicesPerFace = corners.data();
  Sdc::Options options;
  options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  std::unique_ptr<Far::TopologyRefiner> refiner(
      Factory::Create(descriptor, Factory::Options(Sdc::SCHEME_CATMARK, options)));
  if (!refiner) {
    throw ParameterError("refine: OpenSubdiv cannot order the faces of this mesh");
  }
  Far::TopologyRefiner::UniformOptions uniform(levels);
  uniform.fullTopologyInLastLevel = false;
  refiner->RefineUniform(uniform);
  return refiner;
}

}  // namespace

RefinedSurface refine_surface(std::span<const glm::dvec3> points,
                              const CompressedRows<std::int32_t>& faces, int levels) {
  check(faces, levels);
  std::vector<int> number(points.size(), -1);
  for (const std::int32_t point : faces.values()) {
    number[static_cast<std::size_t>(point)] = 0;
  }
  std::vector<SurfacePoint> level_points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (number[i] == 0) {
      number[i] = static_cast<int>(level_points.size());
      level_points.push_back({points[i]});
    }
  }
  std::vector<int> sizes;
  std::vector<int> corners;
  for (std::size_t face = 0; face < faces.n_rows(); ++face) {
    sizes.push_back(static_cast<int>(faces[face].size()));
    for (const std::int32_t point : faces[face]) {
      corners.push_back(number[static_cast<std::size_t>(point)]);
    }
  }
  const auto refiner = make_refiner(static_cast<int>(level_points.size()), sizes, corners, levels);
  const Far::PrimvarRefinerReal<double> interpolator(*refiner);
  for (int level = 1; level <= levels; ++level) {
    std::vector<SurfacePoint> refined(
        static_cast<std::size_t>(refiner->GetLevel(level).GetNumVertices()));
    SurfacePoint* target = refined.data();
    interpolator.Interpolate(level, level_points.data(), target);
    level_points = std::move(refined);
  }
  RefinedSurface surface;
  for (const SurfacePoint& point : level_points) {
    surface.points.push_back(point.at);
  }
  const Far::TopologyLevel& last = refiner->GetLevel(levels);
  for (int face = 0; face < last.GetNumFaces(); ++face) {
    const Far::ConstIndexArray loop = last.GetFaceVertices(face);
    surface.faces.push_back(std::span(loop.begin(), static_cast<std::size_t>(loop.size())));
  }
  return surface;
}

}  // namespace espalier::osd
