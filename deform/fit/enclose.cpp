#include "deform/fit/enclose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <memory>
#include <optional>

#include "deform/fit/node_check.h"
#include "lattice/core/parallel.h"
#include "lattice/subdivision/freeze.h"
#include "lattice/topology/sharpness.h"
#include "lattice/topology/validate.h"
#include "lattice/volume/point_locator.h"

namespace espalier {
namespace {

constexpr int kLevels = 2;             // of refinement that stand for the volume
constexpr int kRelaxSteps = 4;         // each half the way to the mean of the neighbours
constexpr double kFarthest = 0.45;     // that relaxing may move a vertex, in steps
constexpr double kLeastVolume = 1e-3;  // determinant of a refined cell, of its volume in the grid

std::size_t n_sharp_edges(const CellComplex& complex, VertexId vertex, const Sharpness& sharpness) {
  const auto edges = complex.edges(vertex);
  return static_cast<std::size_t>(std::count_if(
      edges.begin(), edges.end(), [&](EdgeId edge) { return sharpness.edges[edge] > 0; }));
}

bool is_sharp_throughout(const CellComplex& complex, VertexId vertex, const Sharpness& sharpness) {
  return std::ranges::all_of(complex.edges(vertex), [&](EdgeId edge) {
    return !complex.is_boundary(edge) || sharpness.edges[edge] > 0;
  });
}

/// Makes the boundary edges at a vertex sharp; those that were not.
std::vector<EdgeId> sharpen(const CellComplex& complex, VertexId vertex, Sharpness& sharpness) {
  std::vector<EdgeId> changed;
  for (const EdgeId edge : complex.edges(vertex)) {
    if (complex.is_boundary(edge) && sharpness.edges[edge] == 0) {
      sharpness.edges[edge] = kInfiniteSharpness;
      changed.push_back(edge);
    }
  }
  return changed;
}

/// Makes the boundary edges at some vertices sharp, and at those where that makes corners. Where
/// another sharp edge ends, a third one makes a corner, which may fold just as well.
void sharpen_corners(const CellComplex& complex, std::vector<VertexId> waiting,
                     Sharpness& sharpness) {
  while (!waiting.empty()) {
    const VertexId vertex = waiting.back();
    waiting.pop_back();
    for (const EdgeId edge : sharpen(complex, vertex, sharpness)) {
      const VertexId end = complex.other_end(edge, vertex);
      if (n_sharp_edges(complex, end, sharpness) > 2) {
        waiting.push_back(end);
      }
    }
  }
}

SubdivisionLattice lattice_of(const GridCells& cells) {
  SubdivisionLattice lattice;
  lattice.complex = std::make_shared<const CellComplex>(cells.mesh.cells);
  lattice.rest = cells.mesh.points;
  lattice.sharpness = automatic_sharpness(*lattice.complex);
  std::vector<VertexId> waiting;
  for (const VertexId vertex : lattice.complex->vertices()) {
    if (cells.is_sharp[vertex.index()] != 0) {
      waiting.push_back(vertex);
    }
  }
  sharpen_corners(*lattice.complex, std::move(waiting), lattice.sharpness);
  return lattice;
}

/// Where the vertices would like to be: among their neighbours, those of the boundary on it.
std::vector<glm::dvec3> relaxed_points(const GridCells& cells, const CellComplex& complex,
                                       double step) {
  std::vector<glm::dvec3> points = cells.mesh.points;
  for (int i = 0; i < kRelaxSteps; ++i) {
    const std::vector<glm::dvec3> before = points;
    for (const VertexId vertex : complex.vertices()) {
      const bool is_boundary = complex.is_boundary(vertex);
      glm::dvec3 sum(0);
      double n = 0;
      for (const EdgeId edge : complex.edges(vertex)) {
        if (!is_boundary || complex.is_boundary(edge)) {
          sum += before[complex.other_end(edge, vertex).index()];
          n += 1;
        }
      }
      if (cells.is_fixed[vertex.index()] == 0) {
        points[vertex.index()] = 0.5 * before[vertex.index()] + 0.5 * sum / n;
      }
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 move = points[i] - cells.mesh.points[i];
    const double length = glm::length(move);
    if (length > kFarthest * step) {
      points[i] = cells.mesh.points[i] + move * (kFarthest * step / length);
    }
  }
  return points;
}

/// The smallest determinant at a corner of a trilinear patch.
double least_determinant(const Volume& volume, std::size_t patch) {
  const auto block = volume.block(patch);
  const auto at = [&](unsigned corner) {
    return volume.rest_points()[static_cast<std::size_t>(block[corner])];
  };
  double least = std::numeric_limits<double>::infinity();
  for (unsigned corner = 0; corner < 8; ++corner) {
    glm::dmat3 edges;
    for (unsigned axis = 0; axis < 3; ++axis) {
      const unsigned low = corner & ~(1U << axis);
      edges[static_cast<int>(axis)] = at(low | 1U << axis) - at(low);
    }
    least = std::min(least, glm::determinant(edges));
  }
  return least;
}

class Encloser {
 public:
  Encloser(const GridCells& cells, const GridFrame& frame, std::span<const glm::dvec3> probes)
      : cells_(cells),
        frame_(frame),
        probes_(probes),
        lattice_(lattice_of(cells)),
        relaxed_(relaxed_points(cells, *lattice_.complex, frame.step)),
        share_(relaxed_.size(), 1.0),
        is_waiting_(probes.size(), 1) {
    cell_of_.assign(frame.n_elements(), -1);
    for (std::size_t cell = 0; cell < cells.elements.size(); ++cell) {
      cell_of_[cells.elements[cell]] = static_cast<std::int32_t>(cell);
    }
  }

  Enclosure run(const Progress& progress) {
    for (int round = 0;; ++round) {
      progress.update("wrap", 0.3 + 0.6 * round / (round + 4.0));
      place();
      is_lowered_.assign(share_.size(), 0);
      lacking_.clear();
      const bool is_sound =
          lower_folded_cells() && lower_lost_probes() && lower_defects() && mend_nodes();
      if (is_sound || !lacking_.empty()) {
        return {std::move(lattice_), std::move(lacking_)};
      }
      wake_probes();
    }
  }

 private:
  void place() {
    for (std::size_t i = 0; i < share_.size(); ++i) {
      const glm::dvec3& home = cells_.mesh.points[i];
      lattice_.rest[i] = share_[i] == 0 ? home : home + (relaxed_[i] - home) * share_[i];
    }
    if (!tables_) {
      tables_ = uniform_tables(lattice_, kLevels);
    }
    volume_ = Volume(*tables_, lattice_.rest);
  }

  /// Takes vertices of a cell, or, if these are home, of its neighbours, nearer home; each once a
  /// round. False: all are home.
  bool lower(std::size_t cell) {
    const CellComplex& complex = *lattice_.complex;
    const auto vertices = complex.vertices(CellId{static_cast<std::int32_t>(cell)});
    if (lower(vertices)) {
      return true;
    }
    bool is_lower = false;
    for (const VertexId vertex : vertices) {
      for (const CellId neighbour : complex.cells(vertex)) {
        is_lower = lower(complex.vertices(neighbour)) || is_lower;
      }
    }
    return is_lower;
  }

  bool lower(std::span<const VertexId> vertices) {
    bool is_lower = false;
    for (const VertexId vertex : vertices) {
      double& share = share_[vertex.index()];
      if (is_lowered_[vertex.index()] == 0 && share > 0) {
        share = share > 0.25 ? share / 2 : 0;
        is_lowered_[vertex.index()] = 1;
      }
      is_lower = is_lower || is_lowered_[vertex.index()] != 0;
    }
    return is_lower;
  }

  /// A cell that even at home is not as it must be.
  void give_up(std::size_t cell) {
    const ElementPlace place = frame_.place(cells_.elements[cell]);
    for (int corner = 0; corner < 8; ++corner) {
      lacking_.push_back(
          frame_.index({place[0] + (corner & 1) * 2 - 1, place[1] + (corner >> 1 & 1) * 2 - 1,
                        place[2] + (corner >> 2) * 2 - 1}));
    }
  }

  /// These return whether there was nothing to lower.
  bool lower_folded_cells() {
    constexpr std::size_t kChildren = std::size_t{1} << 3 * kLevels;  // in the order of the cells
    const double least = kLeastVolume * std::pow(frame_.step, 3) / kChildren;
    std::vector<char> is_folded(cells_.elements.size(), 0);
    parallel_for(
        is_folded.size(),
        [&](std::size_t cell) {
          for (std::size_t child = cell * kChildren; child < (cell + 1) * kChildren; ++child) {
            if (least_determinant(volume_, child) < least) {
              is_folded[cell] = 1;
            }
          }
        },
        64);
    return lower_all(is_folded);
  }

  bool lower_all(const std::vector<char>& is_wrong) {
    bool is_sound = true;
    for (std::size_t cell = 0; cell < is_wrong.size(); ++cell) {
      if (is_wrong[cell] != 0) {
        is_sound = false;
        if (!lower(cell)) {
          give_up(cell);
        }
      }
    }
    return is_sound;
  }

  bool lower_lost_probes() {
    const PointLocator locator(volume_);
    std::vector<std::size_t> waiting;
    for (std::size_t i = 0; i < probes_.size(); ++i) {
      if (is_waiting_[i] != 0) {
        waiting.push_back(i);
      }
    }
    parallel_for(
        waiting.size(),
        [&](std::size_t k) {
          const PointStatus status = locator.locate(probes_[waiting[k]]).status;
          is_waiting_[waiting[k]] =
              status == PointStatus::Inside || status == PointStatus::Border ? 0 : 1;
        },
        256);
    bool is_sound = true;
    for (const std::size_t i : waiting) {
      if (is_waiting_[i] != 0) {
        is_sound = false;
        bring_back(probes_[i]);
      }
    }
    return is_sound;
  }

  void bring_back(const glm::dvec3& probe) {
    const ElementPlace place = frame_.cell_at(probe);
    const std::int32_t cell = cell_of_[frame_.index(place)];
    if (cell >= 0 && lower(static_cast<std::size_t>(cell))) {
      return;
    }
    const glm::dvec3 from_middle = probe - frame_.center(place);
    ElementPlace node = place;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      node[axis] += from_middle[static_cast<int>(axis)] < 0 ? -1 : 1;
    }
    lacking_.push_back(frame_.index(node));
  }

  bool lower_defects() {
    std::vector<char> is_wrong(cells_.elements.size(), 0);
    const CellComplex& complex = *lattice_.complex;
    for (const Defect& defect : find_geometric_defects(complex, lattice_.rest)) {
      const auto index = static_cast<std::int32_t>(defect.index);
      if (defect.element == "cell") {
        is_wrong[static_cast<std::size_t>(index)] = 1;
      } else if (defect.element == "face") {
        for (const int side : {0, 1}) {
          if (const CellId cell = complex.cell(HalfFaceId(FaceId{index}, side)); cell.is_valid()) {
            is_wrong[cell.index()] = 1;
          }
        }
      } else {
        std::fill(is_wrong.begin(), is_wrong.end(), 1);
      }
    }
    return lower_all(is_wrong);
  }

  /// Where refined cells fold at creases: all edges there become sharp, or else vertices go home.
  bool mend_nodes() {
    if (!nodes_) {
      nodes_.emplace(lattice_);
    }
    const CellComplex& complex = *lattice_.complex;
    const std::vector<char> is_folded = nodes_->folded(lattice_.rest);
    std::vector<VertexId> smooth;
    std::vector<char> is_wrong(cells_.elements.size(), 0);
    for (const VertexId vertex : complex.vertices()) {
      if (is_folded[vertex.index()] == 0) {
        continue;
      }
      if (!is_sharp_throughout(complex, vertex, lattice_.sharpness)) {
        smooth.push_back(vertex);
        continue;
      }
      for (const CellId cell : complex.cells(vertex)) {
        is_wrong[cell.index()] = 1;
      }
    }
    if (smooth.empty()) {
      return lower_all(is_wrong);
    }
    sharpen_corners(complex, std::move(smooth), lattice_.sharpness);
    tables_.reset();
    nodes_.reset();
    std::fill(is_waiting_.begin(), is_waiting_.end(), char{1});
    return false;
  }

  /// Probes whose surroundings moved are looked at again.
  void wake_probes() {
    const CellComplex& complex = *lattice_.complex;
    std::vector<char> is_near(is_lowered_);
    for (int ring = 0; ring < 2; ++ring) {
      std::vector<char> is_nearer = is_near;
      for (const CellId cell : complex.cells()) {
        const auto vertices = complex.vertices(cell);
        if (std::any_of(vertices.begin(), vertices.end(),
                        [&](VertexId v) { return is_near[v.index()] != 0; })) {
          for (const VertexId vertex : vertices) {
            is_nearer[vertex.index()] = 1;
          }
        }
      }
      is_near = std::move(is_nearer);
    }
    for (std::size_t i = 0; i < probes_.size(); ++i) {
      const std::int32_t cell = cell_of_[frame_.index(frame_.cell_at(probes_[i]))];
      if (cell < 0) {
        is_waiting_[i] = 1;
        continue;
      }
      for (const VertexId vertex : complex.vertices(CellId{cell})) {
        is_waiting_[i] |= is_near[vertex.index()];
      }
    }
  }

  const GridCells& cells_;
  const GridFrame& frame_;
  std::span<const glm::dvec3> probes_;
  SubdivisionLattice lattice_;
  std::vector<glm::dvec3> relaxed_;    // #vertices
  std::vector<double> share_;          // #vertices: of the way from home to relaxed
  std::vector<char> is_lowered_;       // #vertices: in this round
  std::vector<char> is_waiting_;       // #probes: not known to be inside
  std::vector<std::int32_t> cell_of_;  // #elements
  std::vector<std::size_t> lacking_;
  std::optional<VolumeTables> tables_;  // of the lattice's cells and sharpness
  std::optional<NodeCheck> nodes_;      // of the same
  Volume volume_;
};

}  // namespace

Enclosure enclose(const GridCells& cells, const GridFrame& frame,
                  std::span<const glm::dvec3> probes, const Progress& progress) {
  return Encloser(cells, frame, probes).run(progress);
}

}  // namespace espalier
