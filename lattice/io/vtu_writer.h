#pragma once

/// VTK's XML files of unstructured grids (.vtu), for ParaView and everything else that reads VTK 9.
/// Numbers are written as the bytes they are, in base64: what is read back is exact.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "lattice/tensor/control_net.h"
#include "lattice/topology/cell_complex.h"
#include "lattice/volume/volume.h"

namespace espalier {

/// Where VTK expects the points of a Bézier hexahedron (vtkHigherOrderHexahedron, VTK 9): entry n
/// is the place of VTK's point n in our order, u fastest. First the corners, round w = 0 and then
/// round w = 1; then the inner points of the edges, round w = 0, round w = 1 and then along w; of
/// the faces u = 0, u = 1, v = 0, v = 1, w = 0, w = 1; of the cell. Edges run along their axis,
/// faces and the inside have the lower axis fastest. degree: at least 1.
[[nodiscard]] std::vector<std::int32_t> vtk_point_order(const std::array<int, 3>& degree);

/// A volume as Bézier hexahedra, one a patch in the same order, which VTK draws curved. points:
/// #points, those of the volume at rest or posed, model units; weights: #points, positive, or empty
/// for the volume's own, if any. Bézier points that coincide bit for bit are written once, so
/// neighbours hang together. Throws ParameterError for points or weights of another number, and for
/// a weight that is not positive. O(#Bézier points).
[[nodiscard]] std::string vtu_text(const Volume& volume, std::span<const glm::dvec3> points,
                                   std::span<const double> weights = {});

/// The cells of a lattice, in their order: hexahedra as such, the others as polyhedra. points:
/// #vertices. Throws ParameterError for another number. O(n).
[[nodiscard]] std::string vtu_text(const CellComplex& complex, std::span<const glm::dvec3> points);

/// The net of a lattice's control points: hexahedra, quadrilaterals, lines and vertices; of a
/// hierarchy with the level of each as CellData "Level". points: #controls. O(n).
[[nodiscard]] std::string vtu_text(const ControlNet& net, std::span<const glm::dvec3> points);

/// Whether a path's extension is .vtu, in any case.
[[nodiscard]] bool is_vtu_path(const std::string& path);

}  // namespace espalier
