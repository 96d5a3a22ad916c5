#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "lattice/core/box.h"
#include "lattice/core/error.h"
#include "lattice/subdivision/cell_class.h"
#include "lattice/subdivision/freeze.h"
#include "lattice/subdivision/isolation.h"
#include "lattice/subdivision/refine.h"
#include "lattice/subdivision/section.h"
#include "lattice/subdivision/sub_complex.h"
#include "lattice/subdivision/volume_builder.h"

namespace espalier {
namespace {

/// What a leaf's map misses of the true one in a cell of size 1, before any refinement: as measured
/// at nodes of hexahedra, at creases of finite sharpness, in pyramids.
constexpr double kLeafError = 0.1;
constexpr double kCreaseLeafError = 0.4;
constexpr double kPyramidLeafError = 1;
constexpr double kRefinementRate = 0.25;
/// What it misses of ∂x'/∂x at inner nodes, and how that falls a level.
constexpr double kLeafGradientError = 0.3;
constexpr double kGradientRefinementRate = 0.7;

int levels_for(double tolerance, double leaf_error, int most) {
  const double levels = levels_within(tolerance, leaf_error, kRefinementRate);
  return std::clamp(static_cast<int>(levels), 1, most);
}

/// The stack of quadrilaterals round a line cell: the mesh across, and its vertices in every layer
/// along.
struct Stack {
  CompressedRows<std::int32_t> faces;
  std::vector<std::vector<VertexId>> layers;
  bool natural_begin = false;
  bool natural_end = false;
  std::array<int, 4> levels{};  ///< of isolation at the corners of the first face

  /// What its section depends on.
  [[nodiscard]] std::vector<std::int32_t> key() const {
    std::vector<std::int32_t> key(levels.begin(), levels.end());
    key.insert(key.end(), faces.values().begin(), faces.values().end());
    return key;
  }
};

/// One level of the lattice, and what freezes it.
class LevelFreezer {
 public:
  LevelFreezer(const CellComplex& complex, const Sharpness& sharpness, Scheme scheme,
               const LeafAccuracy& accuracy, VolumeBuilder& volume)
      : complex_(complex),
        sharpness_(sharpness),
        scheme_(scheme),
        accuracy_(accuracy),
        volume_(volume),
        hexahedra_(complex),
        classifier_(hexahedra_, sharpness, scheme) {}

  /// Whether the cell could be frozen as it is.
  bool freeze_exactly(CellId cell) {
    const CellClass found = classifier_.classify(cell);
    switch (found.kind) {
      case CellClass::Kind::Regular:
        add_regular(cell);
        return true;
      case CellClass::Kind::Line:
        add_line(cell, found.axis);
        return true;
      default:
        return false;
    }
  }

  /// The largest error of the leaves that cells would be without further refinement, at size 1.
  [[nodiscard]] double leaf_error(std::span<const CellId> cells) const {
    double largest = kLeafError;
    for (const CellId cell : cells) {
      if (!hexahedra_.is_hexahedron(cell)) {
        return kPyramidLeafError;
      }
      if (std::ranges::any_of(complex_.vertices(cell),
                              [&](VertexId vertex) { return is_at_crease(vertex); })) {
        largest = kCreaseLeafError;
      }
    }
    return largest;
  }

  /// Freezes what refinement has left.
  void freeze_leaves(std::span<const CellId> cells) {
    std::vector<CellId> others;
    std::ranges::copy_if(cells, std::back_inserter(others),
                         [&](CellId cell) { return !hexahedra_.is_hexahedron(cell); });
    const std::vector<VertexCombination> apexes =
        others.empty() ? std::vector<VertexCombination>()
                       : limits_of_cell_points(complex_, sharpness_, scheme_, others);
    auto apex = apexes.begin();
    for (const CellId cell : cells) {
      if (hexahedra_.is_hexahedron(cell)) {
        add_trilinear(cell);
      } else {
        add_pyramids(cell, volume_.add_point(*apex++));
      }
    }
  }

 private:
  /// Whether the vertex or an edge there has a finite sharpness.
  [[nodiscard]] bool is_at_crease(VertexId vertex) const {
    const auto is_finite = [](float sharpness) {
      return sharpness > 0 && sharpness < kInfiniteSharpness;
    };
    return is_finite(sharpness_.vertices[vertex]) ||
           std::ranges::any_of(complex_.edges(vertex),
                               [&](EdgeId edge) { return is_finite(sharpness_.edges[edge]); });
  }

  [[nodiscard]] std::uint8_t boundary_faces(const Frame& frame) const {
    unsigned bits = 0;
    for (int face = 0; face < 6; ++face) {
      if (complex_.is_boundary(hexahedra_.side(frame, face / 2, face % 2).face())) {
        bits |= 1u << face;
      }
    }
    return static_cast<std::uint8_t>(bits);
  }

  void add_regular(CellId cell) {
    const Frame frame = hexahedra_.frame(cell);
    const RegularBlock block = regular_block(hexahedra_, frame);
    Patch patch;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      patch.extractions[axis] = volume_.extraction(
          uniform_cubic_extraction(block.natural_begin[axis], block.natural_end[axis]));
    }
    patch.boundary_faces = boundary_faces(frame);
    std::vector<std::int32_t> points;
    for (const VertexId vertex : block.points) {
      points.push_back(volume_.vertex_point(vertex));
    }
    volume_.add_patch(patch, points);
  }

  /// The frame of a line cell turned so that its line runs along w.
  [[nodiscard]] Frame along_w(CellId cell, int axis) const {
    const Frame own = hexahedra_.frame(cell);
    Frame turned{cell, {}};
    for (std::size_t c = 0; c < 8; ++c) {
      // Turning the axes round keeps the orientation.
      const std::size_t u = c & 1;
      const std::size_t v = c >> 1 & 1;
      const std::size_t w = c >> 2;
      const auto a = static_cast<std::size_t>(axis);
      const std::size_t from = w << a | u << (a + 1) % 3 | v << (a + 2) % 3;
      turned.corners[c] = own.corners[from];
    }
    return turned;
  }

  /// The cells round the four line edges of a frame, that cell first.
  [[nodiscard]] std::vector<Frame> cells_of_section(const Frame& centre) const {
    std::vector<Frame> frames = {centre};
    std::vector<Frame> open = {centre};
    while (!open.empty()) {
      const Frame frame = open.back();
      open.pop_back();
      for (int side = 0; side < 4; ++side) {
        const auto next = hexahedra_.step(frame, side / 2, side % 2);
        if (next && touches(*next, centre) &&
            std::ranges::none_of(frames, [&](const Frame& f) { return f.cell == next->cell; })) {
          frames.push_back(*next);
          open.push_back(*next);
        }
      }
    }
    return frames;
  }

  /// Whether two cells of a section share a line edge.
  [[nodiscard]] static bool touches(const Frame& a, const Frame& b) {
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        if (a.corners[i] == b.corners[j] && a.corners[i + 4] == b.corners[j + 4]) {
          return true;
        }
      }
    }
    return false;
  }

  /// The line edge of a frame at corner i of its first face, in the order of that face's loop.
  [[nodiscard]] EdgeId line_edge(const Frame& frame, std::size_t i) const {
    const std::size_t c = std::array{0u, 1u, 3u, 2u}[i];
    return complex_.find_edge(frame.corners[c], frame.corners[c + 4]);
  }

  /// Two or fewer cells at a boundary are regular: their rates are not used.
  [[nodiscard]] IsolationRates rates_along(EdgeId line) const {
    return isolation_rates(static_cast<int>(complex_.n_cells(line)), complex_.is_boundary(line));
  }

  [[nodiscard]] Stack stack_of(const Frame& centre) const {
    Stack stack;
    stack.natural_begin = complex_.is_boundary(hexahedra_.side(centre, 2, 0).face());
    stack.natural_end = complex_.is_boundary(hexahedra_.side(centre, 2, 1).face());
    const int first = stack.natural_begin ? 0 : -1;
    const int last = stack.natural_end ? 1 : 2;
    stack.layers.resize(static_cast<std::size_t>(last - first + 1));
    std::map<VertexId, std::int32_t> number;
    for (const Frame& frame : cells_of_section(centre)) {
      const auto below =
          stack.natural_begin ? std::optional<Frame>() : hexahedra_.step(frame, 2, 0);
      const auto above = stack.natural_end ? std::optional<Frame>() : hexahedra_.step(frame, 2, 1);
      std::vector<std::int32_t> loop;
      for (const std::size_t c : {0u, 1u, 3u, 2u}) {
        const auto [found, is_new] =
            number.emplace(frame.corners[c], static_cast<std::int32_t>(number.size()));
        loop.push_back(found->second);
        if (!is_new) {
          continue;
        }
        std::size_t layer = 0;
        if (!stack.natural_begin) {
          stack.layers[layer++].push_back(below->corners[c]);
        }
        stack.layers[layer++].push_back(frame.corners[c]);
        stack.layers[layer++].push_back(frame.corners[c + 4]);
        if (!stack.natural_end) {
          stack.layers[layer].push_back(above->corners[c + 4]);
        }
      }
      stack.faces.push_back(loop);
    }
    for (std::size_t i = 0; i < 4; ++i) {
      stack.levels[i] = isolation_levels(rates_along(line_edge(centre, i)), accuracy_);
    }
    return stack;
  }

  /// The frame turned round w so that like sections are cut alike.
  [[nodiscard]] std::pair<Frame, Stack> normalised(Frame frame) const {
    std::pair<Frame, Stack> best = {frame, stack_of(frame)};
    for (int turn = 1; turn < 4; ++turn) {
      frame.corners = {frame.corners[1], frame.corners[3], frame.corners[0], frame.corners[2],
                       frame.corners[5], frame.corners[7], frame.corners[4], frame.corners[6]};
      Stack stack = stack_of(frame);
      if (stack.key() < best.second.key()) {
        best = {frame, std::move(stack)};
      }
    }
    return best;
  }

  const Section& section_of(const Stack& stack) {
    std::unique_ptr<const Section>& section = sections_[stack.key()];
    if (!section) {
      section = std::make_unique<const Section>(isolate_section(
          static_cast<std::int32_t>(stack.layers[0].size()), stack.faces, stack.levels));
    }
    return *section;
  }

  /// The points of a section over one layer of its mesh, added once.
  const std::vector<std::int32_t>& layer_points(const Section& section,
                                                const std::vector<VertexId>& layer) {
    auto& points = layer_points_[{&section, layer}];
    if (points.empty()) {
      for (std::size_t i = 0; i < section.points.n_rows(); ++i) {
        const StencilTable::Row row = section.points[i];
        VertexCombination combination;
        for (std::size_t k = 0; k < row.indices.size(); ++k) {
          combination.emplace_back(layer[static_cast<std::size_t>(row.indices[k])], row.weights[k]);
        }
        points.push_back(volume_.add_point(combination));
      }
    }
    return points;
  }

  /// Tells the volume where leaves may not be as small as the gradient's tolerance asks.
  void note_gradient_error(const Frame& frame, const Stack& stack) {
    for (std::size_t i = 0; i < 4; ++i) {
      const IsolationRates rates = rates_along(line_edge(frame, i));
      const double error = leaf_gradient_error(rates, stack.levels[i]);
      if (rates.gradient < 1 && error > accuracy_.gradient_tolerance) {
        volume_.add_gradient_error(error);
      }
    }
  }

  void add_line(CellId cell, int axis) {
    const auto [frame, stack] = normalised(along_w(cell, axis));
    note_gradient_error(frame, stack);
    const Section& section = section_of(stack);
    const std::uint8_t cell_boundary = boundary_faces(frame);
    std::vector<const std::vector<std::int32_t>*> layers;
    for (const std::vector<VertexId>& layer : stack.layers) {
      layers.push_back(&layer_points(section, layer));
    }
    const std::uint16_t along =
        volume_.extraction(uniform_cubic_extraction(stack.natural_begin, stack.natural_end));
    for (std::size_t i = 0; i < section.patches.size(); ++i) {
      const Section::Patch& part = section.patches[i];
      Patch patch;
      for (std::size_t a = 0; a < 2; ++a) {
        patch.extractions[a] = volume_.extraction(
            part.is_leaf ? bezier_extraction(1)
                         : uniform_cubic_extraction(part.natural_begin[a], part.natural_end[a]));
      }
      patch.extractions[2] = along;
      patch.is_leaf = part.is_leaf;
      patch.boundary_faces = part_boundary(part, cell_boundary);
      std::vector<std::int32_t> block;
      for (const auto* layer : layers) {
        for (const std::int32_t point : section.blocks[i]) {
          block.push_back((*layer)[static_cast<std::size_t>(point)]);
        }
      }
      volume_.add_patch(patch, block);
    }
  }

  /// The sides of a part that lie on the cell's boundary sides.
  static std::uint8_t part_boundary(const Section::Patch& part, std::uint8_t cell_boundary) {
    unsigned inner = 0;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      inner |= part.low[axis] > 0 ? 1u << (2 * axis) : 0u;
      inner |= part.low[axis] + part.size < 1 ? 2u << (2 * axis) : 0u;
    }
    return static_cast<std::uint8_t>(cell_boundary & ~inner);
  }

  /// A vertex where it converges to, or where it is if that is not known.
  std::int32_t limit_point(VertexId vertex) {
    const auto found = limit_points_.find(vertex);
    if (found != limit_points_.end()) {
      return found->second;
    }
    auto limit = limit_position(hexahedra_, sharpness_, scheme_, vertex);
    const std::int32_t point = limit ? volume_.add_point(*limit) : volume_.vertex_point(vertex);
    limit_points_.emplace(vertex, point);
    return point;
  }

  void add_trilinear(CellId cell) {
    const Frame frame = hexahedra_.frame(cell);
    const std::uint16_t linear = volume_.extraction(bezier_extraction(1));
    Patch patch{{linear, linear, linear}, boundary_faces(frame), false, true};
    std::vector<std::int32_t> block;
    for (const VertexId corner : frame.corners) {
      block.push_back(limit_point(corner));
    }
    volume_.add_patch(patch, block);
  }

  void add_pyramids(CellId cell, std::int32_t apex) {
    const std::uint16_t linear = volume_.extraction(bezier_extraction(1));
    for (const HalfFaceId base : complex_.half_faces(cell)) {
      const std::vector<VertexId> corners = loop(complex_, base);
      Patch patch{{linear, linear, linear}, 0, true, true};
      patch.boundary_faces = complex_.is_boundary(base.face()) ? 1u << 4 : 0u;
      std::vector<std::int32_t> block(8, apex);
      block[0] = limit_point(corners[0]);
      block[1] = limit_point(corners[3]);
      block[2] = limit_point(corners[1]);
      block[3] = limit_point(corners[2]);
      volume_.add_patch(patch, block);
    }
  }

  const CellComplex& complex_;
  const Sharpness& sharpness_;
  Scheme scheme_;
  LeafAccuracy accuracy_;
  VolumeBuilder& volume_;
  Hexahedra hexahedra_;
  CellClassifier classifier_;
  std::map<std::vector<std::int32_t>, std::unique_ptr<const Section>> sections_;
  std::map<std::pair<const Section*, std::vector<VertexId>>, std::vector<std::int32_t>>
      layer_points_;
  std::map<VertexId, std::int32_t> limit_points_;
};

StencilTable identity(std::size_t n) {
  return StencilTable::build(
      n, n, [](std::size_t i, StencilRow& row) { row.add(static_cast<std::int32_t>(i), 1.0); });
}

void check(const AdaptiveOptions& options) {
  if (!(options.tolerance >= 1e-12 && options.tolerance <= 0.1)) {
    throw ParameterError("freeze: the tolerance must be 1e-12 to 0.1");
  }
  if (options.gradient_tolerance != 0 &&
      !(options.gradient_tolerance >= 1e-12 && options.gradient_tolerance <= 1)) {
    throw ParameterError("freeze: the gradient tolerance must be 1e-12 to 1");
  }
  if (options.most_levels < 1 || options.most_levels > 8) {
    throw ParameterError("freeze: levels is " + std::to_string(options.most_levels) +
                         ", must be 1 to 8");
  }
}

double gradient_tolerance(const AdaptiveOptions& options) {
  return options.gradient_tolerance > 0 ? options.gradient_tolerance
                                        : kGradientToleranceFactor * options.tolerance;
}

/// The largest coordinate of a lattice's rest points, in lengths of its shortest edge.
double coordinate_scale(const SubdivisionLattice& lattice) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const EdgeId edge : lattice.complex->edges()) {
    const auto ends = lattice.complex->vertices(edge);
    shortest = std::min(
        shortest, glm::distance(lattice.rest[ends[0].index()], lattice.rest[ends[1].index()]));
  }
  const Box box = box_of(lattice.rest);
  const glm::dvec3 farthest = glm::max(glm::abs(box.min), glm::abs(box.max));
  return std::max({farthest.x, farthest.y, farthest.z}) / shortest;
}

/// What is asked of the leaves in cells of a level: as cells shrink, so do their errors. The cells
/// of the first refinement may still be all there is of a polygon.
LeafAccuracy accuracy_of(const AdaptiveOptions& options, double scale, int level) {
  const int halvings = std::max(0, level - 1);
  return {options.tolerance / std::pow(kRefinementRate, halvings),
          gradient_tolerance(options) / std::pow(kGradientRefinementRate, halvings),
          std::ldexp(scale, level)};
}

/// Tells the volume what its leaves miss. error: what is missed of x'.
void tell_errors(VolumeBuilder& volume, const AdaptiveOptions& options, double error, int level) {
  if (error > 2 * options.tolerance) {
    volume.set_freeze_error(error);
  }
  const double gradient = kLeafGradientError * std::pow(kGradientRefinementRate, level);
  if (gradient > gradient_tolerance(options)) {
    volume.add_gradient_error(gradient);
  }
}

}  // namespace

Volume freeze_adaptive(const SubdivisionLattice& lattice, const AdaptiveOptions& options,
                       const Progress& progress) {
  check(options);
  const double scale = coordinate_scale(lattice);
  int n_levels = options.most_levels;
  VolumeBuilder volume;
  auto complex = lattice.complex;
  Sharpness sharpness = with_touching_elements(*complex, lattice.sharpness);
  auto rows = std::make_shared<const StencilTable>(identity(complex->n_vertices()));
  std::vector<CellId> cells;
  for (const CellId cell : complex->cells()) {
    cells.push_back(cell);
  }
  for (int level = 0; !cells.empty(); ++level) {
    progress.update("freeze", static_cast<double>(level) / (n_levels + 1));
    volume.begin_level(rows);
    LevelFreezer freezer(*complex, sharpness, lattice.scheme, accuracy_of(options, scale, level),
                         volume);
    std::vector<CellId> rest;
    for (const CellId cell : cells) {
      if (freezer.freeze_exactly(cell)) {
        continue;
      }
      rest.push_back(cell);
    }
    if (level == 1) {  // from here on cells are of the same kinds at all levels
      n_levels = levels_for(options.tolerance, freezer.leaf_error(rest), options.most_levels);
    }
    if (level == n_levels || 4 * rows->n_weights() > options.most_weights) {
      if (!rest.empty()) {
        tell_errors(volume, options, freezer.leaf_error(rest) * std::pow(kRefinementRate, level),
                    level);
      }
      freezer.freeze_leaves(rest);
      break;
    }
    if (rest.empty()) {
      break;
    }
    const std::vector<CellId> around = with_neighbours(*complex, rest);
    const SubComplex sub = cut_out(*complex, sharpness, around);
    Refinement refinement = refine(sub.complex, sub.sharpness, lattice.scheme);
    rows = std::make_shared<const StencilTable>(
        compose(rows_of(*rows, sub.vertices), refinement.stencils));
    cells.clear();
    for (const CellId cell : refinement.complex->cells()) {
      // with_neighbours() keeps the cells to be refined in front.
      if (refinement.parents.parent(cell).index() < rest.size()) {
        cells.push_back(cell);
      }
    }
    complex = refinement.complex;
    sharpness = std::move(refinement.sharpness);
  }
  progress.update("freeze", 1.0);
  return std::move(volume).build(lattice.rest);
}

}  // namespace espalier
