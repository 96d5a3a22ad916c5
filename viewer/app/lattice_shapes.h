#pragma once

/// A lattice as something else than its control points: refined, its volume's boundary, its cells.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <span>
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

/// The lines of a lattice refined as often as the session shows it: of a hierarchy those of the
/// levels that are shown, each as much finer, in their colours.
class RefinedNet {
 public:
  RefinedNet(const Lattice& lattice, int levels);

  [[nodiscard]] bool is_for(const Lattice& lattice, int levels) const;
  /// Throws as the operation that refines. O(1) as long as nothing moves.
  [[nodiscard]] const LineSet& at(const Session& session);

 private:
  void refine_at(std::span<const glm::dvec3> controls);

  Lattice source_;
  int levels_;
  StencilTable stencils_;  // over control points, of a subdivision lattice
  std::vector<std::array<std::int32_t, 2>> edges_;
  std::vector<std::int32_t> edge_levels_;  // of a hierarchy; else empty
  std::vector<glm::dvec3> points_;
  // What the lines are for.
  std::vector<glm::dvec3> controls_;
  DrawingFrame frame_;
  std::set<std::int32_t> hidden_levels_;
  LineSet lines_;
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
