#pragma once

/// The inventory of ready-made lattices, besides boxes and wedge cylinders: swept sections, rings,
/// spheres and limbs. All functions throw ParameterError naming what is out of range.

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "lattice/build/cell_mesh.h"

namespace espalier {

/// A round bar whose section is a square of cells in rings: no wedges, no line of many cells.
struct OGridOptions {
  glm::dvec3 from{0, 0, 0};  ///< centre of the first end
  glm::dvec3 to{0, 1, 0};    ///< centre of the second end
  double radius = 0.5;       ///< of the volume at the first end
  double end_radius = 0;     ///< at the second end; 0: the same
  int core = 2;              ///< cells across the square
  int rings = 1;             ///< cells from the square to the side
  int layers = 4;            ///< along the axis
};
[[nodiscard]] CellMesh make_o_grid(const OGridOptions& options);

/// A pipe.
struct AnnulusOptions {
  glm::dvec3 from{0, 0, 0};
  glm::dvec3 to{0, 1, 0};
  double radius = 0.5;         ///< of the volume
  double inner_radius = 0.25;  ///< of the hole
  int sectors = 8;             ///< cells round the axis
  int rings = 1;               ///< cells from the hole to the side
  int layers = 4;              ///< along the axis
};
[[nodiscard]] CellMesh make_annulus(const AnnulusOptions& options);

/// A closed ring of wedges round a circle.
struct TorusOptions {
  glm::dvec3 center{0, 0, 0};
  glm::dvec3 axis{0, 1, 0};   ///< across the ring
  double radius = 1;          ///< of the circle in the tube's middle
  double tube_radius = 0.25;  ///< of the volume round that circle
  int sectors = 8;            ///< wedges round the tube
  int segments = 12;          ///< cells along the ring
};
[[nodiscard]] CellMesh make_torus(const TorusOptions& options);

/// A star of kites, extruded.
struct StarOptions {
  glm::dvec3 from{0, 0, 0};
  glm::dvec3 to{0, 0, 1};
  double radius = 1;          ///< of the control points at its tips
  double inner_radius = 0.5;  ///< of those between
  int tips = 5;
  int layers = 1;
};
[[nodiscard]] CellMesh make_star(const StarOptions& options);

/// Two disks joined by a bar, extruded.
struct BarbellOptions {
  glm::dvec3 from{-1, 0, 0};  ///< middle of the first disk, at the near side
  glm::dvec3 to{1, 0, 0};     ///< middle of the second
  glm::dvec3 by{0, 0, 1};     ///< extrusion, across the way
  double radius = 0.5;        ///< of the disks
  double bar_radius = 0.15;   ///< half the bar's width
  int cells = 4;              ///< along the bar
  int layers = 1;             ///< along the extrusion
};
[[nodiscard]] CellMesh make_barbell(const BarbellOptions& options);

/// A ball: a cube of cells with shells round it.
struct SphereOptions {
  glm::dvec3 center{0, 0, 0};
  double radius = 0.5;  ///< of the volume, to about 1 %
  int cells = 2;        ///< across the cube
  int rings = 1;        ///< shells
};
[[nodiscard]] CellMesh make_sphere(const SphereOptions& options);

/// Wedges along a chain of bones; at a joint the section halves the angle.
struct LimbOptions {
  std::vector<glm::dvec3> joints;  ///< two or more
  std::vector<double> radii;       ///< of the volume at each joint
  int sectors = 8;                 ///< wedges round
  int layers = 3;                  ///< along each bone
};
[[nodiscard]] CellMesh make_limb(const LimbOptions& options);

}  // namespace espalier
