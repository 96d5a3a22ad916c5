// Tensor lattices on boxes, their volumes, and their refinement.

#include "lattice/tensor/tensor_lattice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "lattice/core/error.h"
#include "lattice/core/text_scanner.h"
#include "lattice/tensor/flatness.h"

namespace espalier {
namespace {

constexpr std::array<std::string_view, 3> kKinds = {"bezier", "bspline", "nurbs"};

std::size_t as_size(int i) {
  return static_cast<std::size_t>(i);
}

std::size_t n_controls_of(const std::array<TensorAxis, 3>& axes) {
  std::size_t n = 1;
  for (const TensorAxis& axis : axes) {
    n *= as_size(axis.n_controls());
    if (n > kMostControls) {
      throw ParameterError(fmt::format("{} × {} × {} control points, at most {} are supported",
                                       axes[0].n_controls(), axes[1].n_controls(),
                                       axes[2].n_controls(), kMostControls));
    }
  }
  return n;
}

/// The control points' places along an axis, the box's sides at −1 and 1.
std::vector<double> places_along(const TensorAxis& axis, BoxFilling filling) {
  std::vector<double> places = axis.greville();
  const bool is_volume = filling == BoxFilling::Volume;
  const double low = is_volume ? axis.begin() : places.front();
  const double high = is_volume ? axis.end() : places.back();
  for (double& place : places) {
    place = axis.n_controls() == 1 ? 0 : 2 * (place - low) / (high - low) - 1;
  }
  if (filling == BoxFilling::ControlPoints && axis.n_controls() > 1) {
    places.front() = -1;
    places.back() = 1;
  }
  return places;
}

/// The axis that closes to a ring; -1 if none does.
int periodic_axis(const std::array<TensorAxis, 3>& axes) {
  int result = -1;
  for (int axis = 0; axis < 3; ++axis) {
    if (axes[as_size(axis)].ends() == Ends::Periodic && axes[as_size(axis)].n_controls() > 1) {
      if (result >= 0) {
        throw ParameterError("two periodic axes fit no box: place the rest points freely");
      }
      result = axis;
    }
  }
  return result;
}

/// A place in the box bent round the ring's axis. Clockwise, so that the next axis points outward
/// in a right-handed frame.
glm::dvec3 bent_to_ring(const glm::dvec3& t, int around, double turn) {
  const int outward = (around + 1) % 3;
  const double angle = -2 * std::numbers::pi * turn;
  const double radius = 0.75 + 0.25 * t[outward];
  glm::dvec3 bent = t;
  bent[around] = radius * std::cos(angle);
  bent[outward] = radius * std::sin(angle);
  return bent;
}

template <class T>
std::vector<T> along_axis(std::span<const T> values, const std::array<int, 3>& counts, int axis,
                          const SparseRows& rows) {
  std::size_t stride = 1;
  for (int a = 0; a < axis; ++a) {
    stride *= as_size(counts[as_size(a)]);
  }
  const std::size_t n = as_size(counts[as_size(axis)]);
  const std::size_t n_blocks = values.size() / (n * stride);
  std::vector<T> result;
  result.reserve(n_blocks * rows.size() * stride);
  for (std::size_t block = 0; block < n_blocks; ++block) {
    for (const SparseRow& row : rows) {
      for (std::size_t offset = 0; offset < stride; ++offset) {
        T sum(0);
        for (const auto& [index, weight] : row) {
          sum += weight * values[(block * n + static_cast<std::size_t>(index)) * stride + offset];
        }
        result.push_back(sum);
      }
    }
  }
  return result;
}

/// New control points on an axis; with weights, new weights too.
void refine_points(std::vector<glm::dvec3>& points, std::vector<double>& weights,
                   const std::array<int, 3>& counts, int axis, const SparseRows& rows) {
  if (weights.empty()) {
    points = along_axis<glm::dvec3>(points, counts, axis, rows);
    return;
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] *= weights[i];
  }
  points = along_axis<glm::dvec3>(points, counts, axis, rows);
  weights = along_axis<double>(weights, counts, axis, rows);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] /= weights[i];
  }
}

TensorLattice with_axis(const TensorLattice& lattice, int axis, const RefinedAxis& refined) {
  TensorLattice result = lattice;
  result.axes[as_size(axis)] = refined.axis;
  static_cast<void>(n_controls_of(result.axes));
  const std::array<int, 3> counts = lattice.counts();
  if (!lattice.pose.empty() || !lattice.pose_weights.empty()) {
    const auto points = lattice.posed_points();
    const auto weights = lattice.posed_weights();
    result.pose.assign(points.begin(), points.end());
    result.pose_weights.assign(weights.begin(), weights.end());
    refine_points(result.pose, result.pose_weights, counts, axis, refined.controls);
  }
  refine_points(result.rest, result.weights, counts, axis, refined.controls);
  if (result.pose_weights == result.weights) {
    result.pose_weights.clear();
  }
  const bool is_bezier = std::all_of(result.axes.begin(), result.axes.end(),
                                     [](const TensorAxis& a) { return a.is_bezier(); });
  if (result.kind == TensorKind::Bezier && !is_bezier) {
    result.kind = TensorKind::BSpline;
  }
  return result;
}

/// Control points of an axis as the volume's points have them: those of an axis with one are
/// doubled.
struct FrozenAxis {
  std::vector<AxisSpan> spans;
  int n_points = 2;
  bool is_doubled = false;
  bool is_ring = false;
};

FrozenAxis frozen(const TensorAxis& axis) {
  FrozenAxis result;
  if (axis.n_controls() == 1) {
    result.spans = {{0, 1, {0, 1}, bezier_extraction(1)}};
    result.is_doubled = true;
    return result;
  }
  result.spans = axis.spans();
  result.n_points = axis.n_controls();
  result.is_ring = axis.ends() == Ends::Periodic;
  return result;
}

/// The directions in which nothing varies: perpendicular to those in which the points do.
glm::dvec3 default_thickness(const TensorLattice& lattice, int axis) {
  const Box box = box_of(lattice.rest);
  const double length = box.radius() > 0 ? 2 * box.radius() : 1;
  const std::array<int, 3> counts = lattice.counts();
  const auto chord = [&](int along) {
    std::size_t stride = 1;
    for (int a = 0; a < along; ++a) {
      stride *= as_size(counts[as_size(a)]);
    }
    return lattice.rest[stride * as_size(counts[as_size(along)] - 1)] - lattice.rest[0];
  };
  const int next = (axis + 1) % 3;
  const int last = (axis + 2) % 3;
  glm::dvec3 result(0);
  result[axis] = 1;
  if (counts[as_size(next)] > 1 && counts[as_size(last)] > 1) {
    result = glm::cross(chord(next), chord(last));
  } else if (counts[as_size(next)] > 1 || counts[as_size(last)] > 1) {
    const bool is_next = counts[as_size(next)] > 1;
    const glm::dvec3 line = chord(is_next ? next : last);
    glm::dvec3 other(0);  // the coordinate axis that is farthest from the line
    const glm::dvec3 size = glm::abs(line);
    other[size.x <= size.y && size.x <= size.z ? 0 : size.y <= size.z ? 1 : 2] = 1;
    const glm::dvec3 across = glm::normalize(glm::cross(line, other));
    // The lower of the two free axes, in cyclic order after the line, takes `across`.
    result = is_next ? glm::cross(glm::normalize(line), across) : across;
  }
  const double size = glm::length(result);
  return size > 0 ? length / size * result : length * glm::dvec3(axis == 0, axis == 1, axis == 2);
}

/// Where the volume's points are doubled: half the thickness either way.
std::vector<glm::dvec3> offsets_of(const TensorLattice& lattice,
                                   const std::array<FrozenAxis, 3>& axes) {
  std::vector<glm::dvec3> offsets = {glm::dvec3(0)};
  bool has_offsets = false;
  for (int axis = 0; axis < 3; ++axis) {
    const FrozenAxis& frozen_axis = axes[as_size(axis)];
    glm::dvec3 thickness(0);
    if (frozen_axis.is_doubled) {
      has_offsets = true;
      thickness = lattice.thickness[as_size(axis)];
      if (thickness == glm::dvec3(0)) {
        thickness = default_thickness(lattice, axis);
      }
    }
    const std::vector<glm::dvec3> before = std::move(offsets);
    offsets = {};
    for (int i = 0; i < frozen_axis.n_points; ++i) {
      const double side = frozen_axis.is_doubled ? i - 0.5 : 0;
      for (const glm::dvec3& offset : before) {
        offsets.push_back(offset + side * thickness);
      }
    }
  }
  return has_offsets ? offsets : std::vector<glm::dvec3>();
}

/// The control point that each of the volume's points is.
std::vector<std::int32_t> controls_of_points(const TensorLattice& lattice,
                                             const std::array<FrozenAxis, 3>& axes) {
  const std::array<int, 3> counts = lattice.counts();
  std::vector<std::int32_t> controls;
  for (int k = 0; k < axes[2].n_points; ++k) {
    for (int j = 0; j < axes[1].n_points; ++j) {
      for (int i = 0; i < axes[0].n_points; ++i) {
        controls.push_back(
            std::min(i, counts[0] - 1) +
            counts[0] * (std::min(j, counts[1] - 1) + counts[1] * std::min(k, counts[2] - 1)));
      }
    }
  }
  return controls;
}

/// The extractions of all axes, each once, and which one each span has.
struct SharedExtractions {
  std::vector<Extraction> table;
  std::array<std::vector<std::uint16_t>, 3> of_spans;
};

SharedExtractions shared_extractions(const std::array<FrozenAxis, 3>& axes) {
  SharedExtractions shared;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const AxisSpan& span : axes[axis].spans) {
      // Inside a uniform axis all are equal: the newest are asked first.
      const auto found = std::find(shared.table.rbegin(), shared.table.rend(), span.extraction);
      auto index = static_cast<std::size_t>(shared.table.rend() - found);
      if (found == shared.table.rend()) {
        shared.table.push_back(span.extraction);
        index = shared.table.size();
      }
      if (index > 65536) {
        throw LatticeError("its knots have more than 65536 spans that all differ");
      }
      shared.of_spans[axis].push_back(static_cast<std::uint16_t>(index - 1));
    }
  }
  return shared;
}

void add_patches(const std::array<FrozenAxis, 3>& axes, VolumeTables& tables) {
  SharedExtractions shared = shared_extractions(axes);
  const auto boundary = [&](int axis, std::size_t span) {
    const FrozenAxis& along = axes[as_size(axis)];
    const bool is_first = span == 0 && !along.is_ring;
    const bool is_last = span + 1 == along.spans.size() && !along.is_ring;
    return (is_first ? 1 << 2 * axis : 0) | (is_last ? 2 << 2 * axis : 0);
  };
  std::vector<std::int32_t> block;
  for (std::size_t k = 0; k < axes[2].spans.size(); ++k) {
    for (std::size_t j = 0; j < axes[1].spans.size(); ++j) {
      for (std::size_t i = 0; i < axes[0].spans.size(); ++i) {
        Patch patch;
        patch.extractions = {shared.of_spans[0][i], shared.of_spans[1][j], shared.of_spans[2][k]};
        patch.boundary_faces =
            static_cast<std::uint8_t>(boundary(0, i) | boundary(1, j) | boundary(2, k));
        block.clear();
        for (const std::int32_t w : axes[2].spans[k].controls) {
          for (const std::int32_t v : axes[1].spans[j].controls) {
            for (const std::int32_t u : axes[0].spans[i].controls) {
              block.push_back(u + axes[0].n_points * (v + axes[1].n_points * w));
            }
          }
        }
        tables.patches.push_back(patch);
        tables.blocks.push_back(block);
      }
    }
  }
  tables.extractions = std::move(shared.table);
}

void require_points(std::span<const glm::dvec3> points, std::size_t n, std::string_view name) {
  if (points.size() != n) {
    throw LatticeError(
        fmt::format("has {} {} points, its counts ask for {}", points.size(), name, n));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!(std::abs(points[i][axis]) <= kLargestCoordinate)) {
        throw LatticeError(fmt::format("{} point {} has a coordinate {}, not a number up to 1e18",
                                       name, i, points[i][axis]));
      }
    }
  }
}

void require_weights(std::span<const double> weights, std::size_t n, std::string_view name) {
  if (weights.size() != n) {
    throw LatticeError(fmt::format("has {} {}, its counts ask for {}", weights.size(), name, n));
  }
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (!(weights[i] > 0 && std::isfinite(weights[i]))) {
      throw LatticeError(fmt::format("{}[{}] is {}, must be positive", name, i, weights[i]));
    }
  }
}

}  // namespace

std::string_view name_of(TensorKind kind) {
  return kKinds[static_cast<std::size_t>(kind)];
}

std::optional<TensorKind> tensor_kind_named(std::string_view name) {
  for (const TensorKind kind : {TensorKind::Bezier, TensorKind::BSpline, TensorKind::Nurbs}) {
    if (name == name_of(kind)) {
      return kind;
    }
  }
  return std::nullopt;
}

std::size_t TensorLattice::n_controls() const {
  return n_controls_of(axes);
}

TensorLattice make_tensor_lattice(TensorKind kind, const std::array<TensorAxis, 3>& axes,
                                  const OrientedBox& box, BoxFilling filling) {
  TensorLattice lattice;
  lattice.kind = kind;
  lattice.axes = axes;
  lattice.rest.reserve(n_controls_of(axes));
  for (int axis = 0; axis < 3; ++axis) {
    if (!(box.half_sizes[axis] > 0 && std::isfinite(box.half_sizes[axis]))) {
      throw ParameterError(fmt::format("the box has no thickness along {}: its half size is {}",
                                       "uvw"[axis], box.half_sizes[axis]));
    }
    if (kind == TensorKind::Bezier && !axes[as_size(axis)].is_bezier()) {
      throw ParameterError(
          fmt::format("a Bézier lattice of degree {} has {} control points along {}, not {}",
                      axes[as_size(axis)].degree(), axes[as_size(axis)].degree() + 1, "uvw"[axis],
                      axes[as_size(axis)].n_controls()));
    }
    if (axes[as_size(axis)].n_controls() == 1) {
      lattice.thickness[as_size(axis)] = 2 * box.half_sizes[axis] * box.axes[axis];
    }
  }
  const int ring = periodic_axis(axes);
  const auto u = places_along(axes[0], filling);
  const auto v = places_along(axes[1], filling);
  const auto w = places_along(axes[2], filling);
  for (std::size_t k = 0; k < w.size(); ++k) {
    for (std::size_t j = 0; j < v.size(); ++j) {
      for (std::size_t i = 0; i < u.size(); ++i) {
        glm::dvec3 t(u[i], v[j], w[k]);
        if (ring >= 0) {
          const std::size_t step = ring == 0 ? i : ring == 1 ? j : k;
          t = bent_to_ring(t, ring, static_cast<double>(step) / axes[as_size(ring)].n_controls());
        }
        lattice.rest.push_back(box.at(t));
      }
    }
  }
  if (kind == TensorKind::Nurbs) {
    lattice.weights.assign(lattice.rest.size(), 1.0);
  }
  return lattice;
}

void require_valid(const TensorLattice& lattice) {
  const std::size_t n = lattice.n_controls();
  require_points(lattice.rest, n, "rest");
  if (!lattice.pose.empty()) {
    require_points(lattice.pose, n, "posed");
  }
  if (lattice.kind == TensorKind::Nurbs) {
    require_weights(lattice.weights, n, "weights");
    if (!lattice.pose_weights.empty()) {
      require_weights(lattice.pose_weights, n, "pose_weights");
    }
  } else if (!lattice.weights.empty() || !lattice.pose_weights.empty()) {
    throw LatticeError(fmt::format("is a {} lattice, which has no weights", name_of(lattice.kind)));
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (lattice.kind == TensorKind::Bezier && !lattice.axes[as_size(axis)].is_bezier()) {
      throw LatticeError(
          fmt::format("is a bezier lattice with knots inside along {}", "uvw"[axis]));
    }
    require_points(std::span(&lattice.thickness[as_size(axis)], 1), 1, "thickness");
  }
}

Volume freeze(const TensorLattice& lattice) {
  require_valid(lattice);
  const std::array<int, 3> counts = lattice.counts();
  if (std::find(counts.begin(), counts.end(), 1) == counts.end()) {
    require_thickness(lattice.rest);
  }
  const std::array<FrozenAxis, 3> axes = {frozen(lattice.axes[0]), frozen(lattice.axes[1]),
                                          frozen(lattice.axes[2])};
  VolumeTables tables;
  add_patches(axes, tables);
  const std::vector<std::int32_t> controls = controls_of_points(lattice, axes);
  tables.stencils =
      StencilTable::build(controls.size(), lattice.rest.size(),
                          [&](std::size_t i, StencilRow& row) { row.add(controls[i], 1.0); });
  tables.offsets = offsets_of(lattice, axes);
  for (std::size_t i = 0; i < controls.size() && !lattice.weights.empty(); ++i) {
    tables.weights.push_back(lattice.weights[static_cast<std::size_t>(controls[i])]);
  }
  return {std::move(tables), lattice.rest};
}

std::vector<double> point_weights(const Volume& volume, std::span<const double> weights) {
  std::vector<double> result;
  for (std::size_t i = 0; i < volume.n_points() && !weights.empty(); ++i) {
    const std::int32_t control = volume.stencils()[i].indices.front();
    result.push_back(weights[static_cast<std::size_t>(control)]);
  }
  return result;
}

PatchPlace place_of(const TensorLattice& lattice, const glm::dvec3& uvw) {
  PatchPlace place;
  std::size_t stride = 1;
  for (int a = 0; a < 3; ++a) {
    const TensorAxis& axis = lattice.axes[as_size(a)];
    const double length = axis.end() - axis.begin();
    const double u = axis.begin() + std::clamp(uvw[a], 0.0, 1.0) * length;
    const std::size_t i = axis.span_at(u);
    const AxisSpan& span = axis.spans()[i];
    place.uvw[a] = std::clamp((u - span.begin) / (span.end - span.begin), 0.0, 1.0);
    place.scale[a] = length / (span.end - span.begin);
    place.patch += stride * i;
    stride *= axis.spans().size();
  }
  return place;
}

TensorLattice refined(const TensorLattice& lattice) {
  TensorLattice result = lattice;
  for (int axis = 0; axis < 3; ++axis) {
    result = with_axis(result, axis, refined(result.axes[as_size(axis)]));
  }
  return result;
}

TensorLattice with_knots(const TensorLattice& lattice, int axis, std::span<const double> knots) {
  return with_axis(lattice, axis, with_knots(lattice.axes[as_size(axis)], knots));
}

TensorLattice elevated(const TensorLattice& lattice, int axis) {
  return with_axis(lattice, axis, elevated(lattice.axes[as_size(axis)]));
}

}  // namespace espalier
