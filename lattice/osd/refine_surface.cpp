#include "lattice/osd/refine_surface.h"

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/stencilTableFactory.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <string>

#include "lattice/core/error.h"
#include "lattice/osd/used_mesh.h"

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

using BoundaryRule = Sdc::Options::VtxBoundaryInterpolation;

std::unique_ptr<Far::TopologyRefiner> make_refiner(const UsedMesh& mesh, const SurfaceTags& tags,
                                                   BoundaryRule boundary, int levels) {
  const auto number = [&](std::int32_t point) {
    return mesh.numbers[static_cast<std::size_t>(point)];
  };
  std::vector<int> crease_ends;
  for (const auto& [a, b] : tags.edges) {
    crease_ends.insert(crease_ends.end(), {number(a), number(b)});
  }
  std::vector<int> corner_vertices;
  std::transform(tags.vertices.begin(), tags.vertices.end(), std::back_inserter(corner_vertices),
                 number);
  Far::TopologyDescriptor descriptor;
  descriptor.numVertices = static_cast<int>(mesh.points.size());
  descriptor.numFaces = static_cast<int>(mesh.sizes.size());
  descriptor.numVertsPerFace = mesh.sizes.data();
  descriptor.vertIndicesPerFace = mesh.corners.data();
  descriptor.numCreases = static_cast<int>(tags.edges.size());
  descriptor.creaseVertexIndexPairs = crease_ends.data();
  descriptor.creaseWeights = tags.edge_sharpness.data();
  descriptor.numCorners = static_cast<int>(corner_vertices.size());
  descriptor.cornerVertexIndices = corner_vertices.data();
  descriptor.cornerWeights = tags.vertex_sharpness.data();
  Sdc::Options options;
  options.SetVtxBoundaryInterpolation(boundary);
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

CompressedRows<std::int32_t> faces_of(const Far::TopologyLevel& level) {
  CompressedRows<std::int32_t> faces;
  for (int face = 0; face < level.GetNumFaces(); ++face) {
    const Far::ConstIndexArray loop = level.GetFaceVertices(face);
    faces.push_back(std::span(loop.begin(), static_cast<std::size_t>(loop.size())));
  }
  return faces;
}

/// The face of level 0 that each face of a level lies in.
std::vector<std::int32_t> root_faces(const Far::TopologyRefiner& refiner, int level) {
  const Far::TopologyLevel& topology = refiner.GetLevel(level);
  std::vector<std::int32_t> roots(static_cast<std::size_t>(topology.GetNumFaces()));
  for (std::size_t face = 0; face < roots.size(); ++face) {
    int root = static_cast<int>(face);
    for (int at = level; at > 0; --at) {
      root = refiner.GetLevel(at).GetFaceParentFace(root);
    }
    roots[face] = root;
  }
  return roots;
}

}  // namespace

RefinedSurface refine_surface(std::span<const glm::dvec3> points,
                              const CompressedRows<std::int32_t>& faces, int levels) {
  check(faces, levels);
  const UsedMesh mesh = used_mesh(points.size(), faces);
  std::vector<SurfacePoint> level_points;
  for (const std::int32_t point : mesh.points) {
    level_points.push_back({points[static_cast<std::size_t>(point)]});
  }
  const auto refiner = make_refiner(mesh, {}, Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER, levels);
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
  surface.faces = faces_of(refiner->GetLevel(levels));
  return surface;
}

SurfaceRefinement surface_refinement(std::size_t n_points,
                                     const CompressedRows<std::int32_t>& faces,
                                     const SurfaceTags& tags, int levels) {
  check(faces, levels);
  const UsedMesh mesh = used_mesh(n_points, faces);
  const auto refiner = make_refiner(mesh, tags, Sdc::Options::VTX_BOUNDARY_EDGE_ONLY, levels);
  using Factory = Far::StencilTableFactoryReal<double>;
  Factory::Options options;
  options.generateOffsets = true;
  options.generateIntermediateLevels = false;
  const std::unique_ptr<const Far::StencilTableReal<double>> stencils(
      Factory::Create(*refiner, options));
  const auto fill = [&](std::size_t i, StencilRow& row) {
    const auto begin = static_cast<std::size_t>(stencils->GetOffsets()[i]);
    const auto end = begin + static_cast<std::size_t>(stencils->GetSizes()[i]);
    for (std::size_t k = begin; k < end; ++k) {
      const auto number = static_cast<std::size_t>(stencils->GetControlIndices()[k]);
      row.add(mesh.points[number], stencils->GetWeights()[k]);
    }
  };
  return {StencilTable::build(stencils->GetOffsets().size(), n_points, fill),
          faces_of(refiner->GetLevel(levels)), root_faces(*refiner, levels)};
}

}  // namespace espalier::osd
