#pragma once

/// A lattice as something else than its control points: refined, its volume's boundary, its cells.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "lattice/volume/boundary_surface.h"
#include "viewer/interact/session.h"
#include "viewer/render/drawing.h"
#include "viewer/render/mesh_drawing.h"

namespace espalier::viewer {

/// A surface whose points follow control points.
class FollowingSurface {
 public:
  /// source: decides the topology. Throws as freezing and refining do.
  explicit FollowingSurface(const Lattice& lattice);

  /// Whether the surface of this lattice has the same topology.
  [[nodiscard]] bool is_for(const Lattice& lattice) const;
  /// controls: #controls. Hidden faces of a subdivision lattice are left out.
  [[nodiscard]] TriangleMesh at(const Session& session) const;

 private:
  Lattice source_;
  BoundarySurface surface_;
};

/// The lines of a lattice refined as often as the session shows it; a hierarchy's stay as they are.
class RefinedNet {
 public:
  RefinedNet(const Lattice& lattice, int levels);

  [[nodiscard]] bool is_for(const Lattice& lattice, int levels) const;
  [[nodiscard]] LineSet at(const Session& session) const;

 private:
  Lattice source_;
  int levels_;
  StencilTable points_;  // over control points
  std::vector<std::array<std::int32_t, 2>> edges_;
};

/// The visible cells, smaller, as solids; those selected in a mesh of their own.
struct ShrunkCells {
  TriangleMesh cells;
  TriangleMesh selected;
};
[[nodiscard]] ShrunkCells shrunk_cells(const Session& session);

/// Whether volumes of the two lattices differ only in where their control points are.
[[nodiscard]] bool is_same_structure(const Lattice& a, const Lattice& b);

}  // namespace espalier::viewer
