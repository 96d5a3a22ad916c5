#include "viewer/app/lattice_shapes.h"

#include <algorithm>
#include <cmath>

#include "deform/evaluate/volume_boundary.h"
#include "deform/scene/operations.h"
#include "lattice/subdivision/refine.h"
#include "lattice/subdivision/subdivision_boundary.h"
#include "viewer/app/lattice_marks.h"

namespace espalier::viewer {
namespace {

constexpr glm::vec3 kSurface{0.55F, 0.68F, 0.88F};
constexpr glm::vec3 kCell{0.45F, 0.55F, 0.70F};
constexpr glm::vec3 kSelectedCell{0.98F, 0.72F, 0.25F};
constexpr glm::vec3 kRefined{0.62F, 0.74F, 0.95F};
constexpr float kSurfaceOpacity = 0.35F;
constexpr double kShrink = 0.72;

bool is_same_structure(const SubdivisionLattice& a, const SubdivisionLattice& b) {
  return a.complex == b.complex && a.sharpness == b.sharpness && a.scheme == b.scheme;
}
bool is_same_structure(const TensorLattice& a, const TensorLattice& b) {
  return a.axes == b.axes && a.weights == b.weights && a.rest == b.rest;
}
bool is_same_structure(const ThbLattice& a, const ThbLattice& b) {
  return a.hierarchy == b.hierarchy;
}

BoundarySurface surface_of(const Lattice& lattice) {
  const auto* subdivision = lattice.as<SubdivisionLattice>();
  return subdivision != nullptr ? boundary_surface(*subdivision)
                                : boundary_surface(lattice.freeze());
}

/// The lattice refined, posed by its control points.
Lattice refined_at(const Lattice& lattice, std::span<const glm::dvec3> controls, int levels) {
  const std::string name = "lattice";
  const Scene scene = with_lattice(
      Scene(), name, lattice.with_pose(std::vector<glm::dvec3>(controls.begin(), controls.end())));
  const Arguments arguments({{"input", name}, {"levels", std::int64_t{levels}}, {"output", name}});
  return lattice_in(apply({"refine", arguments}, scene), name);
}

}  // namespace

bool is_same_structure(const Lattice& a, const Lattice& b) {
  return a.visit([&](const auto& held) {
    const auto* other = b.as<std::decay_t<decltype(held)>>();
    return other != nullptr && is_same_structure(held, *other);
  });
}

FollowingSurface::FollowingSurface(const Lattice& lattice)
    : source_(lattice), surface_(surface_of(lattice)) {}

bool FollowingSurface::is_for(const Lattice& lattice) const {
  return is_same_structure(lattice, source_);
}

TriangleMesh FollowingSurface::at(const Session& session) const {
  const std::vector<glm::dvec3> points = surface_.points.apply(session.shown_points());
  const bool has_faces = source_.as<SubdivisionLattice>() != nullptr;
  CompressedRows<std::int32_t> quads;
  for (std::size_t i = 0; i < surface_.quads.n_rows(); ++i) {
    const auto face = static_cast<std::size_t>(surface_.faces[i]);
    if (!has_faces || session.visible().faces[face]) {
      quads.push_back(surface_.quads[i]);
    }
  }
  return draw_mesh(points, quads,
                   {.frame = session.view().frame, .color = kSurface, .opacity = kSurfaceOpacity});
}

RefinedNet::RefinedNet(const Lattice& lattice, int levels) : source_(lattice), levels_(levels) {
  const auto* subdivision = lattice.as<SubdivisionLattice>();
  if (subdivision == nullptr) {
    return;
  }
  std::vector<Refinement> refinements = refine(*subdivision, levels);
  stencils_ = std::move(refinements.front().stencils);
  for (std::size_t i = 1; i < refinements.size(); ++i) {
    stencils_ = compose(stencils_, refinements[i].stencils);
  }
  const CellComplex& complex = *refinements.back().complex;
  for (const EdgeId edge : complex.edges()) {
    if (complex.is_boundary(edge)) {
      edges_.push_back({complex.vertices(edge)[0].value, complex.vertices(edge)[1].value});
    }
  }
}

bool RefinedNet::is_for(const Lattice& lattice, int levels) const {
  return levels == levels_ && is_same_structure(lattice, source_);
}

/// What knots are inserted into has other lines only where it is another lattice.
void RefinedNet::refine_at(std::span<const glm::dvec3> controls) {
  if (source_.as<SubdivisionLattice>() != nullptr) {
    points_ = stencils_.apply(controls);
    return;
  }
  const Lattice fine = refined_at(source_, controls, levels_);
  points_.assign(fine.posed_points().begin(), fine.posed_points().end());
  if (edges_.empty()) {
    edges_ = fine.net();
    if (const auto* thb = fine.as<ThbLattice>()) {
      for (const auto& ends : edges_) {
        edge_levels_.push_back(thb->hierarchy->controls()[static_cast<std::size_t>(ends[0])].level);
      }
    }
  }
}

const LineSet& RefinedNet::at(const Session& session) {
  const std::span<const glm::dvec3> controls = session.shown_points();
  const DrawingFrame& frame = session.view().frame;
  const std::set<std::int32_t>& hidden = session.show().hidden_levels;
  const bool is_still = std::ranges::equal(controls, controls_);
  if (is_still && frame == frame_ && hidden == hidden_levels_) {
    return lines_;
  }
  if (!is_still) {
    refine_at(controls);
    controls_.assign(controls.begin(), controls.end());
  }
  frame_ = frame;
  hidden_levels_ = hidden;
  lines_ = LineSet();
  lines_.width = std::clamp(60 / std::sqrt(static_cast<float>(edges_.size() + 1)), 0.5F, 1.2F);
  lines_.hidden_opacity = 0.15F;
  for (std::size_t edge = 0; edge < edges_.size(); ++edge) {
    if (!edge_levels_.empty() && hidden.contains(std::max(0, edge_levels_[edge] - levels_))) {
      continue;
    }
    for (const std::int32_t end : edges_[edge]) {
      lines_.points.emplace_back(frame.to_drawing(points_[static_cast<std::size_t>(end)]));
    }
    lines_.colors.push_back(edge_levels_.empty() ? kRefined : level_color(edge_levels_[edge]));
  }
  return lines_;
}

ShrunkCells shrunk_cells(const Session& session) {
  const LatticeElements& elements = session.elements();
  const std::span<const glm::dvec3> points = session.shown_points();
  const bool has_cells = session.element_kind() == ElementKind::Cell;
  std::array<std::vector<glm::dvec3>, 2> corners;
  std::array<CompressedRows<std::int32_t>, 2> faces;
  for (std::size_t cell = 0; cell < elements.cells.n_rows(); ++cell) {
    if (!session.visible().cells[cell]) {
      continue;
    }
    glm::dvec3 middle(0.0);
    for (const std::int32_t vertex : elements.cells[cell]) {
      middle += points[static_cast<std::size_t>(vertex)] / double(elements.cells[cell].size());
    }
    const bool is_chosen =
        has_cells && session.selection().contains(static_cast<std::int32_t>(cell));
    auto& at = corners.at(is_chosen ? 1 : 0);
    for (const std::int32_t face : elements.cell_faces[cell]) {
      std::vector<std::int32_t> loop;
      for (const std::int32_t vertex : elements.faces[static_cast<std::size_t>(face)]) {
        loop.push_back(static_cast<std::int32_t>(at.size()));
        at.push_back(middle + kShrink * (points[static_cast<std::size_t>(vertex)] - middle));
      }
      faces.at(is_chosen ? 1 : 0).push_back(loop);
    }
  }
  const DrawingFrame& frame = session.view().frame;
  return {draw_mesh(corners[0], faces[0], {.frame = frame, .color = kCell}),
          draw_mesh(corners[1], faces[1], {.frame = frame, .color = kSelectedCell})};
}

}  // namespace espalier::viewer
