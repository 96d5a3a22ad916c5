#include "lattice/topology/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "lattice/core/error.h"
#include "lattice/topology/defect_collection.h"
#include "lattice/topology/geometric_check.h"
#include "lattice/topology/intersection.h"
#include "lattice/topology/structure_check.h"

namespace espalier {
namespace {

/// Lengths below this part of the lattice's diagonal count as zero.
constexpr double kLengthRounding = 1e-9;

/// Closed rings of cells round an edge.
struct Rings {
  int n = 0;
  std::size_t fewest_faces = 0;
};

Rings count_rings(const CellComplex& complex, EdgeId edge) {
  const auto half_faces = complex.half_faces(edge);
  Rings rings;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < half_faces.size(); ++i) {
    const CellId behind = complex.cell(half_faces[i]);
    if (behind.is_valid() && behind != complex.cell(half_faces[begin].opposite())) {
      continue;  // the fan goes on
    }
    if (behind.is_valid()) {
      const std::size_t n_faces = i + 1 - begin;
      rings.fewest_faces = rings.n == 0 ? n_faces : std::min(rings.fewest_faces, n_faces);
      ++rings.n;
    }
    begin = i + 1;
  }
  return rings;
}

void append(std::vector<Defect>& defects, std::vector<Defect> more) {
  std::move(more.begin(), more.end(), std::back_inserter(defects));
}

/// Cells that no defect so far concerns: neither their own nor one of an edge without length.
IdVector<CellId, bool> find_sound_cells(const CellComplex& complex,
                                        std::span<const glm::dvec3> points, double tolerance,
                                        const std::vector<Defect>& defects) {
  IdVector<CellId, bool> is_sound(complex.n_cells(), true);
  for (const Defect& defect : defects) {
    if (defect.element == "cell") {
      is_sound[CellId{static_cast<std::int32_t>(defect.index)}] = false;
    }
  }
  for (const EdgeId edge : complex.edges()) {
    const auto& ends = complex.vertices(edge);
    const glm::dvec3 along = points[ends[1].index()] - points[ends[0].index()];
    if (std::max({std::abs(along.x), std::abs(along.y), std::abs(along.z)}) <= tolerance) {
      for (const HalfFaceId half_face : complex.half_faces(edge)) {
        for (const HalfFaceId side : {half_face, half_face.opposite()}) {
          if (complex.cell(side).is_valid()) {
            is_sound[complex.cell(side)] = false;
          }
        }
      }
    }
  }
  return is_sound;
}

}  // namespace

std::vector<Defect> find_edge_defects(const CellComplex& complex) {
  std::vector<Defect> defects;
  const auto check = [&](std::size_t i) {
    std::vector<Defect> found;
    const EdgeId edge{static_cast<std::int32_t>(i)};
    const Rings rings = count_rings(complex, edge);
    const std::int32_t a = complex.vertices(edge)[0].value;
    const std::int32_t b = complex.vertices(edge)[1].value;
    if (rings.n > 0 && rings.fewest_faces < 3) {
      found.push_back(make_edge_defect(
          DefectKind::TooFewFacesAtEdge, a, b,
          fmt::format("is an inner edge with {} faces, needs three or more", rings.fewest_faces)));
    }
    if (rings.n + complex.n_open_fans(edge) > 1 && rings.n > 0) {
      found.push_back(make_edge_defect(DefectKind::EdgeEnclosedTwice, a, b,
                                       "is enclosed by a ring of cells and has more cells"));
    }
    return found;
  };
  collect_defects(complex.n_edges(), check, defects);
  return defects;
}

std::vector<Defect> find_geometric_defects(const CellComplex& complex,
                                           std::span<const glm::dvec3> points,
                                           const Progress& progress) {
  if (points.size() != complex.n_vertices()) {
    throw ParameterError(fmt::format("find_geometric_defects: {} points for {} vertices",
                                     points.size(), complex.n_vertices()));
  }
  progress.update("checking the lattice's geometry", 0);
  std::vector<Defect> defects = find_bad_coordinates(points);
  if (!defects.empty()) {
    return defects;
  }
  const std::vector<glm::dvec3> normalized = normalized_points(points);
  append(defects, find_zero_length_edges(complex, normalized, kLengthRounding));
  append(defects, find_self_touching_cells(complex, normalized, kLengthRounding));
  append(defects, find_inverted_cells(complex, normalized));
  progress.update("checking the lattice's geometry", 0.2);
  const auto is_sound = find_sound_cells(complex, normalized, kLengthRounding, defects);
  append(defects, find_vertices_inside(complex, normalized, kLengthRounding));
  append(defects,
         find_intersecting_cells(complex, normalized, is_sound, kLengthRounding, progress));
  progress.update("checking the lattice's geometry", 1);
  return defects;
}

std::shared_ptr<const CellComplex> valid_complex(Polyhedra polyhedra,
                                                 std::span<const glm::dvec3> points,
                                                 const Progress& progress) {
  auto complex = std::make_shared<const CellComplex>(std::move(polyhedra));
  std::vector<Defect> defects = find_edge_defects(*complex);
  if (defects.empty()) {
    defects = find_geometric_defects(*complex, points, progress);
  }
  throw_if_defective(defects);
  return complex;
}

std::vector<Defect> validate(const Polyhedra& polyhedra, std::span<const glm::dvec3> points,
                             const Progress& progress) {
  std::vector<Defect> defects = find_structural_defects(polyhedra);
  if (!defects.empty()) {
    return defects;
  }
  const CellComplex complex(polyhedra);
  defects = find_edge_defects(complex);
  append(defects, find_geometric_defects(complex, points, progress));
  return defects;
}

}  // namespace espalier
