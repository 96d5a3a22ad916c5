// Certificates of frozen volumes.

#include "deform/injectivity/injectivity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "deform/injectivity/dominance.h"
#include "lattice/core/error.h"
#include "lattice/core/parallel.h"
#include "lattice/core/text_scanner.h"
#include "lattice/volume/bezier_evaluator.h"

namespace espalier {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kUnit = std::numeric_limits<double>::epsilon();
constexpr std::size_t kRestBoxes = 200;

double largest_coordinate(std::span<const glm::dvec3> points) {
  double largest = 0;
  for (const glm::dvec3& p : points) {
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  return largest;
}

void require_finite(std::string_view what, std::span<const glm::dvec3> values,
                    std::size_t n_controls) {
  if (values.size() != n_controls) {
    throw ParameterError(fmt::format("the {} has {} control points, the lattice {}", what,
                                     values.size(), n_controls));
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const glm::dvec3& p = values[i];
    if (!(largest_coordinate({&p, 1}) <= kLargestCoordinate) || p != p) {
      throw ParameterError(fmt::format(
          "the {} has control point {} at ({}, {}, {}), must be finite, at most 1e18 in size", what,
          i, p.x, p.y, p.z));
    }
  }
}

double value_at(const BoundedPolynomial& polynomial, const glm::dvec3& uvw) {
  std::array<std::vector<double>, 3> bases;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const int degree = polynomial.shape.size[a] - 1;
    bases[a].resize(static_cast<std::size_t>(degree + 1));
    std::vector<double> slopes(bases[a].size());
    bernstein_basis(degree, uvw[axis], bases[a].data(), slopes.data());
  }
  double value = 0;
  const double* at = polynomial.coefficients.data();
  for (const double w : bases[2]) {
    for (const double v : bases[1]) {
      for (const double u : bases[0]) {
        value += w * v * u * *at++;
      }
    }
  }
  return value;
}

/// What a thread works in.
struct Workspace {
  DeterminantNets nets;
  BezierPatch rest;
  BezierPatch pose;
  BoundedPolynomial polynomial;
};

Workspace& workspace() {
  thread_local Workspace space;
  return space;
}

/// Whether all are multiples of one vector, to the bit: the same vector, or none.
bool is_parallel(std::span<const glm::dvec3> motion) {
  glm::dvec3 common(0);
  for (const glm::dvec3& v : motion) {
    if (v != glm::dvec3(0)) {
      if (common != glm::dvec3(0) && v != common) {
        return false;
      }
      common = v;
    }
  }
  return true;
}

/// Equal weights cancel.
void require_polynomial(const Volume& volume) {
  const auto weights = volume.weights();
  if (std::any_of(weights.begin(), weights.end(), [&](double w) { return w != weights.front(); })) {
    throw LatticeError(
        "the lattice has weights that differ: only lattices with equal weights can be certified");
  }
}

}  // namespace

InjectivityCheck::InjectivityCheck(std::shared_ptr<const Volume> volume)
    : volume_(std::move(volume)) {
  // A point sums up its row of stencils, then three rows of extractions.
  const StencilTable& stencils = volume_->stencils();
  double largest = 1;
  double longest = 1;
  for (std::size_t i = 0; i < stencils.n_rows(); ++i) {
    double sum = 0;
    for (const double weight : stencils[i].weights) {
      sum += std::abs(weight);
    }
    largest = std::max(largest, sum);
    longest = std::max(longest, static_cast<double>(stencils[i].weights.size()));
  }
  double extracted = 1;
  for (const Extraction& extraction : volume_->extractions()) {
    for (int i = 0; i <= extraction.degree; ++i) {
      double sum = 0;
      for (int k = 0; k < extraction.n_coefficients; ++k) {
        sum += std::abs(extraction.row(i, k));
      }
      extracted = std::max(extracted, sum);
    }
    longest = std::max(longest, static_cast<double>(extraction.n_coefficients));
  }
  rounding_ = 4 * kUnit * (longest + 4) * largest * extracted * extracted * extracted;
  rest_error_ = rounding(volume_->rest_controls());
  is_rest_certain_.assign(volume_->n_patches(), 0);

  require_polynomial(*volume_);
  Workspace& space = workspace();
  for (std::size_t i = 0; i < volume_->n_patches(); ++i) {
    volume_->bezier(i, volume_->rest_points(), space.rest);
    if (i == 0) {
      is_mirrored_ = glm::determinant(space.rest.derivative(glm::dvec3(0.5))) < 0;
    }
    patch_of(i, volume_->rest_points(), space.rest);
    if (dominant_step(space.rest, nullptr, rest_error_, 0) > 0) {
      is_rest_certain_[i] = 1;
      continue;
    }
    space.nets.determinant(space.rest, common_collapse(space.rest, space.rest), rest_error_,
                           space.polynomial);
    const auto [least, most] = std::minmax_element(space.polynomial.coefficients.begin(),
                                                   space.polynomial.coefficients.end());
    const bool is_singular = *least >= -space.polynomial.error && *most <= space.polynomial.error;
    const Positivity found = positivity(space.polynomial, kRestBoxes);
    if (found.verdict == Verdict::Folded || is_singular) {
      throw LatticeError(
          fmt::format("the lattice at rest is {} in patch {} at (u, v, w) = ({}, {}, {}): it must "
                      "be one-to-one "
                      "at rest to tell where a pose folds",
                      is_singular ? "singular" : "folded", i, found.witness.x, found.witness.y,
                      found.witness.z));
    }
    is_rest_certain_[i] = found.verdict == Verdict::Certified ? 1 : 0;
  }
}

/// What a coordinate of a Bézier point may be off by.
double InjectivityCheck::rounding(std::span<const glm::dvec3> controls) const {
  return rounding_ * largest_coordinate(controls);
}

/// Patch i; seen in a mirror if that makes it right-handed at rest.
void InjectivityCheck::patch_of(std::size_t i, std::span<const glm::dvec3> points,
                                BezierPatch& out) const {
  volume_->bezier(i, points, out);
  if (is_mirrored_) {
    for (glm::dvec3& p : out.points) {
      p.x = -p.x;
    }
  }
}

void InjectivityCheck::check_patch(std::size_t i, std::span<const glm::dvec3> points,
                                   double input_error, std::size_t most_boxes,
                                   LocalInjectivity& out) const {
  Workspace& space = workspace();
  ++out.n_patches;
  const std::span<const glm::dvec3> rest_points = volume_->rest_points();
  const auto block = volume_->block(i);
  const bool is_moved = std::any_of(block.begin(), block.end(), [&](std::int32_t p) {
    return points[static_cast<std::size_t>(p)] != rest_points[static_cast<std::size_t>(p)];
  });
  if (!is_moved && is_rest_certain_[i] != 0) {
    return;
  }
  patch_of(i, points, space.pose);
  if (dominant_step(space.pose, nullptr, input_error, 0) > 0) {
    return;
  }
  patch_of(i, rest_points, space.rest);
  const Collapse collapse = common_collapse(space.rest, space.pose);
  space.nets.determinant(space.pose, collapse, input_error, space.polynomial);
  const Positivity found = positivity(space.polynomial, most_boxes);
  if (found.verdict == Verdict::Folded) {
    space.nets.determinant(space.rest, collapse, rest_error_, space.polynomial);
    glm::dvec3 place = space.rest.value(found.witness);
    place.x = is_mirrored_ ? -place.x : place.x;
    out.folds.push_back(
        {i, found.witness, place, found.value / value_at(space.polynomial, found.witness)});
  }
  for (const ParameterBox& box : found.undecided) {
    out.undecided.push_back({i, box});
  }
}

LocalInjectivity InjectivityCheck::local(std::span<const glm::dvec3> pose,
                                         std::size_t most_boxes) const {
  std::vector<std::int32_t> all(volume_->n_patches());
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i] = static_cast<std::int32_t>(i);
  }
  return local(pose, all, most_boxes);
}

LocalInjectivity InjectivityCheck::local(std::span<const glm::dvec3> pose,
                                         std::span<const std::int32_t> patches,
                                         std::size_t most_boxes) const {
  require_finite("pose", pose, volume_->n_controls());
  const std::vector<glm::dvec3> points = volume_->points(pose);
  const double input_error = rounding(pose);
  constexpr std::size_t kGrain = 64;
  std::vector<LocalInjectivity> parts((patches.size() + kGrain - 1) / kGrain);
  parallel_ranges(patches.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      check_patch(static_cast<std::size_t>(patches[i]), points, input_error, most_boxes,
                  parts[i / kGrain]);
    }
  });
  LocalInjectivity result;
  for (const LocalInjectivity& part : parts) {
    result.n_patches += part.n_patches;
    result.folds.insert(result.folds.end(), part.folds.begin(), part.folds.end());
    result.undecided.insert(result.undecided.end(), part.undecided.begin(), part.undecided.end());
  }
  if (!result.folds.empty()) {
    result.verdict = Verdict::Folded;
  } else if (!result.undecided.empty()) {
    result.verdict = Verdict::Undecided;
  }
  return result;
}

SafeStep InjectivityCheck::largest_step(std::span<const glm::dvec3> pose,
                                        std::span<const glm::dvec3> motion,
                                        const SafeStepOptions& options) const {
  require_finite("pose", pose, volume_->n_controls());
  require_finite("motion", motion, volume_->n_controls());
  const std::vector<glm::dvec3> points = volume_->points(pose);
  const std::vector<glm::dvec3> moves = volume_->points(motion);
  const bool one_direction = is_parallel(motion);
  const double start_error = rounding(pose);
  const double motion_error = rounding(motion);

  /// What is left to look at: a patch, or, once it has been expanded, a box of it.
  struct Job {
    double lower;
    std::size_t patch;
    bool is_expanded;
    MovingBox box;
    int axis;
  };
  const auto is_later = [](const Job& a, const Job& b) { return a.lower > b.lower; };
  std::vector<Job> jobs;
  Workspace& space = workspace();
  BezierPatch moving;
  for (std::size_t i = 0; i < volume_->n_patches(); ++i) {
    const auto block = volume_->block(i);
    if (std::any_of(block.begin(), block.end(), [&](std::int32_t p) {
          return moves[static_cast<std::size_t>(p)] != glm::dvec3(0);
        })) {
      patch_of(i, points, space.pose);
      patch_of(i, moves, moving);
      jobs.push_back(
          {dominant_step(space.pose, &moving, start_error, motion_error), i, false, {}, 0});
    }
  }
  std::make_heap(jobs.begin(), jobs.end(), is_later);

  SafeStep result;
  double upper = options.most_step;
  std::array<BoundedPolynomial, 4> powers;
  const auto add = [&](Job job) {
    const PositiveRange range = range_of(job.box, job.axis);
    if (range.is_negative) {
      throw LatticeError(fmt::format(
          "the pose is folded before anything moves, in patch {} at (u, v, w) = ({}, {}, {})",
          job.patch, range.limit.x, range.limit.y, range.limit.z));
    }
    if (range.upper < upper) {
      upper = range.upper;
      result.patch = job.patch;
      result.uvw = range.limit;
    }
    job.lower = std::max(job.lower, range.lower);
    job.is_expanded = true;
    jobs.push_back(std::move(job));
    std::push_heap(jobs.begin(), jobs.end(), is_later);
  };
  for (std::size_t n_boxes = 0; !jobs.empty(); ++n_boxes) {
    const double lower = jobs.front().lower;
    if (lower >= (1 - options.tolerance) * upper || lower == kInfinity ||
        n_boxes >= options.most_boxes) {
      result.is_tight = n_boxes < options.most_boxes;
      result.step = std::min(lower, options.most_step);
      return result;
    }
    std::pop_heap(jobs.begin(), jobs.end(), is_later);
    Job job = std::move(jobs.back());
    jobs.pop_back();
    if (job.is_expanded) {
      Job high{job.lower, job.patch, true, {}, 0};
      halve(job.box, job.axis, high.box);
      add(std::move(job));
      add(std::move(high));
      continue;
    }
    patch_of(job.patch, points, space.pose);
    patch_of(job.patch, moves, moving);
    patch_of(job.patch, volume_->rest_points(), space.rest);
    Collapse collapse = common_collapse(space.rest, space.pose);
    const Collapse of_motion = common_collapse(moving, moving);
    for (std::size_t a = 0; a < 3; ++a) {
      collapse.factors[a] = static_cast<std::uint8_t>(collapse.factors[a] & of_motion.factors[a]);
    }
    space.nets.moving_determinant({space.pose, moving, one_direction, start_error, motion_error},
                                  collapse, powers);
    job.box.shape = powers[0].shape;
    job.box.n_powers = one_direction ? 2 : 4;
    for (std::size_t k = 0; k < job.box.n_powers; ++k) {
      job.box.coefficients[k] = powers[k].coefficients;
      job.box.errors[k] = powers[k].error;
    }
    add(std::move(job));
  }
  result.step = options.most_step;
  return result;
}

}  // namespace espalier
