#include "deform/evaluate/evaluator.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <string>

#include "deform/evaluate/general_patch.h"
#include "lattice/core/error.h"
#include "lattice/core/parallel.h"
#include "lattice/core/streamed_copy.h"

namespace espalier {
namespace {

/// Where results go, as plain numbers; null where nothing is wanted.
template <class Real>
struct Targets {
  Real* points = nullptr;
  Real* gradients = nullptr;
  Real* determinants = nullptr;
  Real* normals = nullptr;
  Real* tangents = nullptr;

  [[nodiscard]] bool want_frames() const {
    return gradients != nullptr || determinants != nullptr || normals != nullptr ||
           tangents != nullptr;
  }
};

template <class Real>
Real* at(Real* array, std::size_t offset) {
  return array == nullptr ? nullptr : array + offset;
}

template <class Real>
const Real* begin_of(const AlignedVector<Real>& blocks, std::size_t n_rows, std::size_t block) {
  return blocks.empty() ? nullptr : &blocks[block * n_rows * kBlock];
}

/// Copies `n` numbers each of points that stand together to where they belong.
template <class Real>
void scatter(const Real* from, std::size_t n, std::span<const std::uint32_t> targets, Real* to) {
  if (to != nullptr) {
    for (std::size_t i = 0; i < targets.size(); ++i) {
      std::copy_n(from + n * i, n, to + n * targets[i]);
    }
  }
}

/// Writes `n` numbers each of `n_points` points that follow each other past the caches.
template <class Real>
void stream(const Real* from, std::size_t n, std::size_t first, std::size_t n_points, Real* to) {
  if (to != nullptr) {
    streamed_copy(from, n * n_points, to + n * first);
  }
}

/// Whether a frame of all points reads and writes more than the caches hold.
template <class Real>
bool is_streamed(const Targets<Real>& targets, const PointRuns<Real>& runs) {
  const auto written = [](const Real* array, std::size_t n) { return array != nullptr ? n : 0; };
  const std::size_t n_written = written(targets.points, 3) + written(targets.gradients, 9) +
                                written(targets.determinants, 1) + written(targets.normals, 3) +
                                written(targets.tangents, 3);
  const std::size_t n_read = runs.places.size() + (targets.want_frames() ? runs.slopes.size() : 0) +
                             (targets.normals != nullptr ? runs.normals.size() : 0) +
                             (targets.tangents != nullptr ? runs.tangents.size() : 0);
  return (n_read + n_written * runs.n_points) * sizeof(Real) > last_cache_bytes();
}

/// One frame's work on runs.
template <class Real>
class Frame {
 public:
  Frame(const Volume& volume, const EvaluationKernels<Real>& kernels, const PointRuns<Real>& runs,
        const VolumeMotion<Real>& motion, const Targets<Real>& targets, Scope scope)
      : volume_(volume),
        kernels_(kernels),
        runs_(runs),
        motion_(motion),
        targets_(targets),
        scope_(scope),
        is_streamed_(is_streamed(targets, runs)) {}

  void evaluate_chunk(std::size_t chunk) const {
    for (std::uint32_t i = runs_.chunks[chunk]; i < runs_.chunks[chunk + 1]; ++i) {
      const PointRun& run = runs_.runs[i];
      if (is_written(run)) {
        evaluate(run);
      }
    }
    if (is_streamed_) {
      finish_streaming();
    }
  }

 private:
  [[nodiscard]] bool is_written(const PointRun& run) const {
    const auto block = volume_.block(static_cast<std::size_t>(run.patch));
    return scope_ == Scope::All ||
           (scope_ == Scope::Moved ? motion_.is_any_moved(block) : motion_.has_any_changed(block));
  }

  void evaluate(const PointRun& run) const {
    Targets<Real> wanted = targets_;
    if (run.is_general || (run.is_pyramid && wanted.want_frames())) {
      if (!run.is_scattered) {
        if (!run.is_general) {
          wanted.points = nullptr;  // a kernel finds them below
        }
        evaluate_as_general(run, wanted);
      }
      wanted = {run.is_general ? nullptr : targets_.points};
    }
    if (wanted.points == nullptr && !wanted.want_frames()) {
      return;
    }
    alignas(64) Real powers[kMaxPowers];
    const AxisPolynomial<Real>* const axes[3] = {&runs_.polynomials[run.axes[0]],
                                                 &runs_.polynomials[run.axes[1]],
                                                 &runs_.polynomials[run.axes[2]]};
    kernels_.find_powers(motion_.values(),
                         volume_.block(static_cast<std::size_t>(run.patch)).data(), axes, powers);
    const auto kernel =
        (wanted.want_frames()
             ? kernels_.frames
             : kernels_.points)[axes[0]->degree - 1][axes[1]->degree - 1][axes[2]->degree - 1];
    if (run.is_scattered || is_streamed_) {
      evaluate_in_parts(run, wanted, powers, kernel);
    } else {
      PatchPoints<Real> points = part(run, 0, run.n_points, offset(wanted, run.first_point));
      points.powers = powers;
      kernel(points);
    }
  }

  void evaluate_as_general(const PointRun& run, const Targets<Real>& wanted) const {
    thread_local BezierPatch moves;
    find_motion(volume_, motion_, static_cast<std::size_t>(run.patch), moves);
    PatchPoints<Real> points = part(run, 0, run.n_points, offset(wanted, run.first_point));
    if (!wanted.want_frames()) {
      points.slopes = nullptr;
    }
    evaluate_general(moves, std::span(runs_.exact_uvw).subspan(run.first_exact, run.n_points),
                     points);
  }

  /// By way of the first cache, a few blocks at a time.
  void evaluate_in_parts(const PointRun& run, const Targets<Real>& wanted, const Real* powers,
                         typename EvaluationKernels<Real>::Evaluate kernel) const {
    constexpr std::size_t kPart = 16 * kBlock;
    Real points[3 * kPart];
    Real gradients[9 * kPart];
    Real determinants[kPart];
    Real normals[3 * kPart];
    Real tangents[3 * kPart];
    const Targets<Real> here = {wanted.points != nullptr ? points : nullptr,
                                wanted.gradients != nullptr ? gradients : nullptr,
                                wanted.determinants != nullptr ? determinants : nullptr,
                                wanted.normals != nullptr ? normals : nullptr,
                                wanted.tangents != nullptr ? tangents : nullptr};
    for (std::size_t begin = 0; begin < run.n_points; begin += kPart) {
      const std::size_t n = std::min<std::size_t>(kPart, run.n_points - begin);
      PatchPoints<Real> some = part(run, begin, n, here);
      some.powers = powers;
      kernel(some);
      const auto deliver = [&](const Real* from, std::size_t width, Real* to) {
        if (run.is_scattered) {
          scatter(from, width, std::span(runs_.targets).subspan(run.first_target + begin, n), to);
        } else {
          stream(from, width, run.first_point + begin, n, to);
        }
      };
      deliver(points, 3, wanted.points);
      deliver(gradients, 9, wanted.gradients);
      deliver(determinants, 1, wanted.determinants);
      deliver(normals, 3, wanted.normals);
      deliver(tangents, 3, wanted.tangents);
    }
  }

  [[nodiscard]] static Targets<Real> offset(const Targets<Real>& targets, std::size_t first) {
    return {at(targets.points, 3 * first), at(targets.gradients, 9 * first),
            at(targets.determinants, first), at(targets.normals, 3 * first),
            at(targets.tangents, 3 * first)};
  }

  /// n points of a run from `begin` on, a multiple of kBlock.
  [[nodiscard]] PatchPoints<Real> part(const PointRun& run, std::size_t begin, std::size_t n,
                                       const Targets<Real>& to) const {
    const std::size_t block = run.first_block + begin / kBlock;
    return {.powers = nullptr,
            .n_points = n,
            .places = begin_of(runs_.places, kPlaceRows, block),
            .slopes = begin_of(runs_.slopes, kSlopeRows, block),
            .normals = begin_of(runs_.normals, kVectorRows, block),
            .tangents = begin_of(runs_.tangents, kVectorRows, block),
            .moved_points = to.points,
            .gradients = to.gradients,
            .determinants = to.determinants,
            .moved_normals = to.normals,
            .moved_tangents = to.tangents};
  }

  const Volume& volume_;
  const EvaluationKernels<Real>& kernels_;
  const PointRuns<Real>& runs_;
  const VolumeMotion<Real>& motion_;
  const Targets<Real>& targets_;
  Scope scope_;
  bool is_streamed_;
};

template <class Value, class Real>
Real* target(std::span<Value> span, std::size_t n_points, bool is_possible, const char* what,
             Real* (*numbers)(Value&)) {
  if (span.empty()) {
    return nullptr;
  }
  if (!is_possible) {
    throw ParameterError(std::string("the bound points were made without what ") + what + " need");
  }
  if (span.size() != n_points) {
    throw ParameterError("room for " + std::to_string(span.size()) + " " + what + " given for " +
                         std::to_string(n_points) + " points");
  }
  return numbers(span.front());
}

template <class Real>
Targets<Real> targets_of(const MovedPoints<Real>& moved, const PointRuns<Real>& runs) {
  using Vector = glm::vec<3, Real>;
  using Matrix = glm::mat<3, 3, Real>;
  const auto numbers = [](Vector& v) { return glm::value_ptr(v); };
  const bool has_frames = !runs.slopes.empty();
  const std::size_t n = runs.n_points;
  return {target<Vector, Real>(moved.points, n, true, "points", numbers),
          target<Matrix, Real>(moved.gradients, n, has_frames, "gradients",
                               [](Matrix& m) { return glm::value_ptr(m); }),
          target<Real, Real>(moved.determinants, n, has_frames, "determinants",
                             [](Real& d) { return &d; }),
          target<Vector, Real>(moved.normals, n, !runs.normals.empty(), "normals", numbers),
          target<Vector, Real>(moved.tangents, n, !runs.tangents.empty(), "tangents", numbers)};
}

}  // namespace

template <class Real>
Evaluator<Real>::Evaluator(const Volume& volume, const BoundPoints& points, InstructionSet set)
    : volume_(&volume),
      kernels_(&evaluation_kernels<Real>(set)),
      runs_(make_point_runs<Real>(volume, points)) {}

template <class Real>
void Evaluator<Real>::evaluate(const VolumeMotion<Real>& motion, const MovedPoints<Real>& moved,
                               Scope scope) const {
  if (motion.displacements().size() != volume_->n_points()) {
    throw ParameterError("a motion of " + std::to_string(motion.displacements().size()) +
                         " points given for a volume of " + std::to_string(volume_->n_points()));
  }
  if (!motion.weights().empty() && !volume_->is_rational()) {
    throw ParameterError("a motion with weights given for a volume that is not rational");
  }
  if (runs_.runs.empty()) {
    return;
  }
  const Targets<Real> targets = targets_of(moved, runs_);
  const Frame<Real> frame(*volume_, *kernels_, runs_, motion, targets, scope);
  parallel_for(
      runs_.chunks.size() - 1, [&frame](std::size_t chunk) { frame.evaluate_chunk(chunk); }, 1);
}

template class Evaluator<float>;
template class Evaluator<double>;

}  // namespace espalier
