#pragma once

/// The named lattices that tests run over.

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "lattice/build/cell_mesh.h"
#include "lattice/core/compressed_rows.h"
#include "lattice/subdivision/subdivision_lattice.h"

namespace espalier::test {

/// A flat polygon mesh to extrude.
struct Section {
  std::string name;
  std::vector<glm::dvec3> points;  // z = 0
  CompressedRows<std::int32_t> faces;
};

[[nodiscard]] Section grid_section(int nx, int ny);
/// n triangles round a centre.
[[nodiscard]] Section wheel_section(int n);
/// n quadrilaterals round a centre, then a ring of 2n more: an inner vertex of valence n.
[[nodiscard]] Section flower_section(int n);
/// A pentagon with a ring of five quadrilaterals.
[[nodiscard]] Section pentagon_section();
/// Four squares with a ring of eight quadrilaterals: four inner vertices of valence 3 on the rim.
[[nodiscard]] Section o_grid_section();
/// Three squares round a concave corner, refined once.
[[nodiscard]] Section l_section();
/// n triangles round a point of the straight side.
[[nodiscard]] Section half_disk_section(int n);
/// All of the above with valences 3, 5 and 6.
[[nodiscard]] std::vector<Section> irregular_sections();

/// The section extruded along z by 1 a layer, automatic tags.
[[nodiscard]] SubdivisionLattice prism(const Section& section, int layers,
                                       Scheme scheme = Scheme::CatmullClark);

/// A valid lattice from cells, automatic tags.
[[nodiscard]] SubdivisionLattice lattice_from(CellMesh mesh, Scheme scheme = Scheme::CatmullClark);
/// Cells from loops of vertices, in any winding.
[[nodiscard]] CellMesh mesh_from_loops(
    std::vector<glm::dvec3> points,
    const std::vector<std::vector<std::vector<std::int32_t>>>& cells);

[[nodiscard]] SubdivisionLattice tetrahedron();
/// A unit cube with a pyramid on its top: vertex 8 is the apex, of valence 4 in its cell.
[[nodiscard]] SubdivisionLattice pyramid_on_cube();
/// One unit cube split into six tetrahedra round its diagonal.
[[nodiscard]] SubdivisionLattice six_tetrahedra();
/// Two unit cubes that share only the edge x = y = 1, or only the vertex (1, 1, 1).
[[nodiscard]] SubdivisionLattice cubes_sharing_edge();
[[nodiscard]] SubdivisionLattice cubes_sharing_vertex();
/// A lattice with a node: six cubes round one, each glued to a face.
[[nodiscard]] SubdivisionLattice plus_of_cubes();

struct NamedLattice {
  std::string name;
  SubdivisionLattice lattice;
};
/// Grid, wedge cylinder, flowers, pentagon, star, pyramid, tetrahedra, touching cubes, creased.
[[nodiscard]] std::vector<NamedLattice> lattice_families();

/// `points` moved by reproducible noise of at most `size` a coordinate.
[[nodiscard]] std::vector<glm::dvec3> jittered(std::vector<glm::dvec3> points, double size,
                                               unsigned seed);

}  // namespace espalier::test
