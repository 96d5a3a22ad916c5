// Certificates of frozen volumes.

#include "deform/injectivity/injectivity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "deform/injectivity/dominance.h"
#include "deform/injectivity/pose_checks.h"
#include "deform/injectivity/rational_patch.h"
#include "lattice/core/error.h"
#include "lattice/core/parallel.h"
#include "lattice/volume/bezier_evaluator.h"

namespace espalier {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kUnit = std::numeric_limits<double>::epsilon();
constexpr std::size_t kRestBoxes = 200;
/// A patch whose determinant may be zero is flat if rounding is so small beside the box of its
/// derivatives; else its sign is not known.
constexpr double kFlatness = 1e-6;
constexpr double kThinness = 1e-12;

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

/// What a determinant may be: the longest derivatives along the axes of a patch multiplied; 0 where
/// one is nothing beside another.
double box_of_derivatives(const BezierPatch& patch) {
  glm::dvec3 longest(0);
  std::size_t stride = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const int degree = patch.degree[static_cast<std::size_t>(axis)];
    const auto size = static_cast<std::size_t>(degree) + 1;
    for (std::size_t i = 0; i + stride < patch.points.size(); ++i) {
      if (i / stride % size + 1 < size) {
        const double step = glm::distance(patch.points[i], patch.points[i + stride]);
        longest[axis] = std::max(longest[axis], degree * step);
      }
    }
    stride *= size;
  }
  const double least = std::min({longest.x, longest.y, longest.z});
  const double most = std::max({longest.x, longest.y, longest.z});
  return least > kThinness * most ? longest.x * longest.y * longest.z : 0;
}

/// None if all are equal: equal weights cancel.
std::span<const double> differing(std::span<const double> weights) {
  const bool are_equal =
      std::all_of(weights.begin(), weights.end(), [&](double w) { return w == weights.front(); });
  return are_equal ? std::span<const double>() : weights;
}

bool is_any_moved(std::span<const std::int32_t> block, std::span<const glm::dvec3> moves) {
  return std::any_of(block.begin(), block.end(), [&](std::int32_t p) {
    return moves[static_cast<std::size_t>(p)] != glm::dvec3(0);
  });
}

}  // namespace

/// A volume's points somewhere, and what their coordinates and weights may be off by once they are
/// Bézier points.
struct InjectivityCheck::Frame {
  std::vector<glm::dvec3> points;
  std::span<const double> weights;  // #points, or empty: equal
  double point_error = 0;
  double weight_error = 0;
  glm::dvec3 centre{0};  // about which homogeneous points are taken: where the control points are

  [[nodiscard]] PatchErrors errors(double of_motion = 0) const {
    return {point_error, of_motion, weight_error};
  }
  [[nodiscard]] HomogeneousPatch homogeneous(const BezierPatch& patch,
                                             std::vector<glm::dvec4>& room) const {
    homogeneous_points(patch, centre, room);
    return {patch.degree, room, glm::dvec4(glm::dvec3(4 * point_error), weight_error)};
  }
};

/// What a thread works in.
struct InjectivityCheck::Workspace {
  DeterminantNets nets;
  BezierPatch rest;
  BezierPatch pose;
  BezierPatch motion;
  std::vector<glm::dvec4> start_points;
  std::vector<glm::dvec4> motion_points;
  BoundedPolynomial polynomial;
  std::array<BoundedPolynomial, 4> powers;
};

InjectivityCheck::Workspace& InjectivityCheck::workspace() {
  thread_local Workspace space;
  return space;
}

/// A place in workspace().rest, not seen in a mirror.
glm::dvec3 InjectivityCheck::rest_place(const glm::dvec3& uvw) const {
  glm::dvec3 place = workspace().rest.value(uvw);
  place.x = is_mirrored_ ? -place.x : place.x;
  return place;
}

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
  is_rest_certain_.assign(volume_->n_patches(), 0);
  if (volume_->n_patches() > 0) {
    is_mirrored_ = glm::determinant(
                       volume_->bezier(0, volume_->rest_points()).derivative(glm::dvec3(0.5))) < 0;
  }
  rest_ = std::make_shared<const Frame>(frame_of(volume_->rest_controls()));
  for (std::size_t i = 0; i < volume_->n_patches(); ++i) {
    check_rest(i);
  }
}

void InjectivityCheck::check_rest(std::size_t i) {
  Workspace& space = workspace();
  patch_of(i, *rest_, space.rest);
  if (dominant_step(space.rest, nullptr, rest_->errors()) > 0) {
    is_rest_certain_[i] = 1;
    return;
  }
  space.pose = space.rest;
  find_determinant(space.rest, *rest_, collapse_of(i, *rest_), space.polynomial);
  const auto [least, most] = std::minmax_element(space.polynomial.coefficients.begin(),
                                                 space.polynomial.coefficients.end());
  const double error = space.polynomial.error;
  const double size = rest_->weights.empty() ? box_of_derivatives(space.rest) : 0;
  const bool is_singular =
      *least >= -error && *most <= error && (size == 0 || !(error > kFlatness * size));
  const Positivity found = positivity(space.polynomial, kRestBoxes);
  if (found.verdict == Verdict::Folded || is_singular) {
    const glm::dvec3 place = rest_place(found.witness);
    throw LatticeError(fmt::format(
        "the lattice at rest is {} at ({}, {}, {}), in patch {} at (u, v, w) = ({}, {}, {}): it "
        "must be one-to-one at rest to tell where a pose folds",
        is_singular ? "singular" : "folded", place.x, place.y, place.z, i, found.witness.x,
        found.witness.y, found.witness.z));
  }
  is_rest_certain_[i] = found.verdict == Verdict::Certified ? 1 : 0;
}

InjectivityCheck::Frame InjectivityCheck::frame_of(const PosedControls& pose) const {
  Frame frame;
  frame.points = volume_->points(pose.points);
  frame.weights = differing(pose.weights.empty() ? volume_->weights() : pose.weights);
  frame.point_error =
      rounding_ * std::max(largest_coordinate(pose.points), largest_coordinate(frame.points));
  if (!frame.weights.empty()) {
    const double largest = *std::max_element(frame.weights.begin(), frame.weights.end());
    frame.point_error *= largest;
    frame.weight_error = rounding_ * largest;
    const Box box = box_of(frame.points);
    frame.centre = 0.5 * (box.min + box.max);
    frame.centre.x = is_mirrored_ ? -frame.centre.x : frame.centre.x;
  }
  return frame;
}

/// Patch i; seen in a mirror if that makes it right-handed at rest.
void InjectivityCheck::patch_of(std::size_t i, const Frame& frame, BezierPatch& out) const {
  volume_->bezier(i, frame.points, frame.weights, out);
  if (is_mirrored_) {
    for (glm::dvec3& p : out.points) {
      p.x = -p.x;
    }
  }
}

/// Of the derivative of a patch of the frame; of a rational one times its weight's fourth power.
void InjectivityCheck::find_determinant(const BezierPatch& patch, const Frame& frame,
                                        const Collapse& collapse, BoundedPolynomial& out) const {
  Workspace& space = workspace();
  if (frame.weights.empty()) {
    space.nets.determinant(patch, collapse, frame.point_error, out);
  } else {
    space.nets.rational_determinant(frame.homogeneous(patch, space.start_points), collapse, out);
  }
}

/// The factors that patch i has at rest and in the pose: workspace().rest and .pose are these.
Collapse InjectivityCheck::collapse_of(std::size_t i, const Frame& pose) const {
  if (pose.weights.empty() && rest_->weights.empty()) {
    return common_collapse(workspace().rest, workspace().pose);
  }
  return rational_collapse(*volume_, i, rest_->points, rest_->weights) &
         rational_collapse(*volume_, i, pose.points, pose.weights);
}

void InjectivityCheck::check_patch(std::size_t i, const Frame& pose, std::size_t most_boxes,
                                   LocalInjectivity& out) const {
  Workspace& space = workspace();
  ++out.n_patches;
  const auto block = volume_->block(i);
  const bool is_moved = std::any_of(block.begin(), block.end(), [&](std::int32_t point) {
    const auto p = static_cast<std::size_t>(point);
    return pose.points[p] != rest_->points[p] ||
           (!pose.weights.empty() && pose.weights[p] != volume_->weights()[p]);
  });
  if (!is_moved && is_rest_certain_[i] != 0) {
    return;
  }
  patch_of(i, pose, space.pose);
  if (dominant_step(space.pose, nullptr, pose.errors()) > 0) {
    return;
  }
  patch_of(i, *rest_, space.rest);
  const Collapse collapse = collapse_of(i, pose);
  find_determinant(space.pose, pose, collapse, space.polynomial);
  const Positivity found = positivity(space.polynomial, most_boxes);
  if (found.verdict == Verdict::Folded) {
    find_determinant(space.rest, *rest_, collapse, space.polynomial);
    const double ratio =
        weight_at(space.rest, found.witness) / weight_at(space.pose, found.witness);
    out.folds.push_back(
        {i, found.witness, rest_place(found.witness),
         found.value / value_at(space.polynomial, found.witness) * std::pow(ratio, 4)});
  }
  for (const ParameterBox& box : found.undecided) {
    out.undecided.push_back({i, box, rest_place(0.5 * (box.low + box.high))});
  }
}

LocalInjectivity InjectivityCheck::local(const PosedControls& pose, std::size_t most_boxes) const {
  std::vector<std::int32_t> all(volume_->n_patches());
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i] = static_cast<std::int32_t>(i);
  }
  return local(pose, all, most_boxes);
}

LocalInjectivity InjectivityCheck::local(const PosedControls& pose,
                                         std::span<const std::int32_t> patches,
                                         std::size_t most_boxes) const {
  require_coordinates("pose", pose.points, volume_->n_controls());
  require_weights(pose.weights, *volume_);
  const Frame posed = frame_of(pose);
  constexpr std::size_t kGrain = 64;
  std::vector<LocalInjectivity> parts((patches.size() + kGrain - 1) / kGrain);
  parallel_ranges(patches.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      check_patch(static_cast<std::size_t>(patches[i]), posed, most_boxes, parts[i / kGrain]);
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

/// How the points move, with the weights of the start: homogeneous points move by w · motion.
InjectivityCheck::Frame InjectivityCheck::motion_of(std::span<const glm::dvec3> motion,
                                                    const Frame& start) const {
  Frame moves;
  moves.points = volume_->stencils().apply(motion);
  moves.weights = start.weights;
  moves.point_error = rounding_ * largest_coordinate(motion);
  if (!moves.weights.empty()) {
    moves.point_error *= *std::max_element(moves.weights.begin(), moves.weights.end());
  }
  return moves;
}

/// Of patch i, into workspace().powers.
void InjectivityCheck::find_moving_determinant(std::size_t i, const Frame& start,
                                               const Frame& moves, bool is_parallel) const {
  Workspace& space = workspace();
  patch_of(i, start, space.pose);
  patch_of(i, moves, space.motion);
  if (start.weights.empty()) {
    Collapse collapse = common_collapse(space.pose, space.motion);
    if (collapse != Collapse()) {  // most patches collapse nowhere, at rest or not
      patch_of(i, *rest_, space.rest);
      collapse = collapse_of(i, start) & common_collapse(space.motion, space.motion);
    }
    space.nets.moving_determinant(
        {space.pose, space.motion, is_parallel, start.point_error, moves.point_error}, collapse,
        space.powers);
    return;
  }
  patch_of(i, *rest_, space.rest);
  const Collapse collapse =
      collapse_of(i, start) & rational_collapse(*volume_, i, moves.points, moves.weights);
  const HomogeneousPatch homogeneous = start.homogeneous(space.pose, space.start_points);
  HomogeneousPatch motion = moves.homogeneous(space.motion, space.motion_points);
  for (glm::dvec4& p : space.motion_points) {
    p.w = 0;
  }
  motion.error.w = 0;
  space.nets.moving_rational_determinant(homogeneous, motion, is_parallel, collapse, space.powers);
}

SafeStep InjectivityCheck::largest_step(const PosedControls& pose,
                                        std::span<const glm::dvec3> motion,
                                        const SafeStepOptions& options) const {
  require_coordinates("pose", pose.points, volume_->n_controls());
  require_coordinates("motion", motion, volume_->n_controls());
  require_weights(pose.weights, *volume_);
  const Frame start = frame_of(pose);
  const Frame moves = motion_of(motion, start);
  const bool one_direction = is_parallel(motion);

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
  for (std::size_t i = 0; i < volume_->n_patches(); ++i) {
    if (is_any_moved(volume_->block(i), moves.points)) {
      patch_of(i, start, space.pose);
      patch_of(i, moves, space.motion);
      jobs.push_back({dominant_step(space.pose, &space.motion, start.errors(moves.point_error)),
                      i,
                      false,
                      {},
                      0});
    }
  }
  std::make_heap(jobs.begin(), jobs.end(), is_later);

  SafeStep result;
  double upper = options.most_step;
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
    find_moving_determinant(job.patch, start, moves, one_direction);
    job.box.shape = space.powers[0].shape;
    job.box.n_powers = one_direction ? 2 : 4;
    for (std::size_t k = 0; k < job.box.n_powers; ++k) {
      job.box.coefficients[k] = space.powers[k].coefficients;
      job.box.errors[k] = space.powers[k].error;
    }
    add(std::move(job));
  }
  result.step = options.most_step;
  return result;
}

}  // namespace espalier
