#include "deform/evaluate/point_runs.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <string>

#include "deform/evaluate/kernels.h"
#include "lattice/core/error.h"
#include "lattice/core/parallel.h"

namespace espalier {
namespace {

constexpr std::size_t kPointsPerChunk = 8192;
constexpr double kFarEnd = 1e-6;

void require_length(std::size_t n, std::size_t n_points, const char* what, bool may_be_empty) {
  if (n != n_points && !(may_be_empty && n == 0)) {
    throw ParameterError(std::to_string(n) + " " + what + " given for " + std::to_string(n_points) +
                         " points");
  }
}

void require_valid(const Volume& volume, const BoundPoints& points) {
  const std::size_t n = points.patches.size();
  require_length(points.uvw.size(), n, "places (uvw)", false);
  require_length(points.rest_points.size(), n, "rest points", true);
  require_length(points.normals.size(), n, "normals", true);
  require_length(points.tangents.size(), n, "tangents", true);
  for (std::size_t i = 0; i < n; ++i) {
    const std::int32_t patch = points.patches[i];
    if (patch < 0 || static_cast<std::size_t>(patch) >= volume.n_patches()) {
      throw ParameterError("point " + std::to_string(i) + " is in patch " + std::to_string(patch) +
                           ", the volume has " + std::to_string(volume.n_patches()));
    }
    if (i > 0 && patch < points.patches[i - 1]) {
      throw ParameterError("point " + std::to_string(i) + " is in patch " + std::to_string(patch) +
                           ", after one in patch " + std::to_string(points.patches[i - 1]) +
                           ": patches must ascend");
    }
  }
}

/// Bit a: the point lies at the end 1 of axis a.
unsigned far_ends(const glm::dvec3& uvw) {
  unsigned ends = 0;
  for (int axis = 0; axis < 3; ++axis) {
    ends |= std::abs(1 - uvw[axis]) <= kFarEnd ? 1u << axis : 0u;
  }
  return ends;
}

bool is_far(const PointRun& run, std::size_t axis) {
  return run.axes[axis] % 2 != 0;
}

/// Cuts the points into runs and the runs into chunks; no numbers yet.
template <class Real>
class RunMaker {
 public:
  RunMaker(const Volume& volume, const BoundPoints& points, PointRuns<Real>& made)
      : volume_(volume), points_(points), made_(made) {}

  void make() {
    const std::size_t n = points_.patches.size();
    made_.chunks = {0};
    for (std::size_t begin = 0; begin < n;) {
      const std::size_t limit = std::min(n, begin + kPointsPerChunk);
      std::size_t end = begin;
      while (end < limit && points_.patches[end] == points_.patches[begin]) {
        ++end;
      }
      add_patch(begin, end);
      begin = end;
    }
    close_chunk();
  }
  [[nodiscard]] std::size_t n_blocks() const { return n_blocks_; }

 private:
  void add_patch(std::size_t begin, std::size_t end) {
    if (begin - chunk_begin_ >= kPointsPerChunk) {
      close_chunk();
      chunk_begin_ = begin;
    }
    PointRun run;
    run.patch = points_.patches[begin];
    const Patch& patch = volume_.patch(static_cast<std::size_t>(run.patch));
    run.is_pyramid = patch.is_pyramid;
    run.is_general = volume_.is_rational();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      run.axes[axis] = static_cast<std::uint16_t>(2 * patch.extractions[axis]);
      run.is_general |= !is_kernel_axis(volume_.extractions()[patch.extractions[axis]]);
    }
    run.first_point = static_cast<std::uint32_t>(begin);
    run.first_exact = static_cast<std::uint32_t>(made_.exact_uvw.size());
    if (run.is_general || run.is_pyramid) {
      made_.exact_uvw.insert(made_.exact_uvw.end(), points_.uvw.begin() + static_cast<long>(begin),
                             points_.uvw.begin() + static_cast<long>(end));
    }
    add_run(run, end - begin);
    if (!run.is_general) {
      add_far_runs(run, begin, end);
    }
  }

  void add_far_runs(const PointRun& near_run, std::size_t begin, std::size_t end) {
    unsigned present = 0;  // bit e: some point has the ends e
    for (std::size_t i = begin; i < end; ++i) {
      present |= 1u << far_ends(points_.uvw[i]);
    }
    for (unsigned ends = 1; ends < 8; ++ends) {
      if ((present >> ends & 1u) == 0) {
        continue;
      }
      PointRun run = near_run;
      run.is_scattered = true;
      run.first_target = static_cast<std::uint32_t>(made_.targets.size());
      for (std::size_t axis = 0; axis < 3; ++axis) {
        run.axes[axis] = static_cast<std::uint16_t>(near_run.axes[axis] + (ends >> axis & 1u));
      }
      for (std::size_t i = begin; i < end; ++i) {
        if (far_ends(points_.uvw[i]) == ends) {
          made_.targets.push_back(static_cast<std::uint32_t>(i));
        }
      }
      add_run(run, made_.targets.size() - run.first_target);
    }
  }

  void add_run(PointRun run, std::size_t n_points) {
    run.n_points = static_cast<std::uint32_t>(n_points);
    run.first_block = static_cast<std::uint32_t>(n_blocks_);
    n_blocks_ += (n_points + kBlock - 1) / kBlock;
    made_.runs.push_back(run);
  }

  void close_chunk() {
    if (made_.runs.size() > made_.chunks.back()) {
      made_.chunks.push_back(static_cast<std::uint32_t>(made_.runs.size()));
    }
  }

  const Volume& volume_;
  const BoundPoints& points_;
  PointRuns<Real>& made_;
  std::size_t n_blocks_ = 0;
  std::size_t chunk_begin_ = 0;
};

/// ∂x/∂(u,v,w) at rest. Where it has no inverse the volume's diagonal stands in for it, beside
/// which the slopes of any motion are small: there nearly nothing turns.
glm::dmat3 rest_slopes(const Volume& volume, const BezierPatch& rest, const glm::dvec3& uvw) {
  const glm::dmat3 R = rest.derivative(uvw);
  const glm::dmat3 inverse = glm::inverse(R);
  for (int b = 0; b < 3; ++b) {
    for (int a = 0; a < 3; ++a) {
      if (!std::isfinite(inverse[b][a])) {
        return glm::dmat3(volume.diagonal());
      }
    }
  }
  return R;
}

/// Writes `row_values` as the column of a point in its block.
template <class Real, std::size_t N>
void put(AlignedVector<Real>& blocks, std::size_t first_block, std::size_t point,
         const std::array<double, N>& row_values) {
  Real* const block = &blocks[(first_block + point / kBlock) * N * kBlock];
  for (std::size_t row = 0; row < N; ++row) {
    block[row * kBlock + point % kBlock] = static_cast<Real>(row_values[row]);
  }
}

/// Writes what gradients, normals and tangents of point i need.
template <class Real>
void fill_slopes(const BoundPoints& points, const PointRun& run, std::size_t at, std::size_t i,
                 glm::dmat3 R, PointRuns<Real>& made) {
  for (int axis = 0; axis < 3; ++axis) {
    R[axis] *= is_far(run, static_cast<std::size_t>(axis)) ? -1 : 1;
  }
  const double inverse_determinant = 1 / glm::determinant(R);
  put<Real, kSlopeRows>(made.slopes, run.first_block, at,
                        {R[0].x, R[0].y, R[0].z, R[1].x, R[1].y, R[1].z, R[2].x, R[2].y, R[2].z,
                         inverse_determinant});
  if (!points.normals.empty()) {
    const glm::dvec3 n = glm::transpose(R) * points.normals[i] * inverse_determinant;
    put<Real, kVectorRows>(made.normals, run.first_block, at, {n.x, n.y, n.z});
  }
  if (!points.tangents.empty()) {
    const glm::dvec3 t = glm::inverse(R) * points.tangents[i];
    put<Real, kVectorRows>(made.tangents, run.first_block, at, {t.x, t.y, t.z});
  }
}

/// Writes the numbers of one run; the last block is filled up with its last point.
template <class Real>
void fill_run(const Volume& volume, const BoundPoints& points, const PointRun& run,
              PointRuns<Real>& made) {
  BezierPatch rest;
  if (!made.slopes.empty()) {
    volume.bezier(static_cast<std::size_t>(run.patch), volume.rest_points(), rest);
  }
  const std::size_t n_filled = (run.n_points + kBlock - 1) / kBlock * kBlock;
  for (std::size_t at = 0; at < n_filled; ++at) {
    const std::size_t in_run = std::min<std::size_t>(at, run.n_points - 1);
    const std::size_t i =
        run.is_scattered ? made.targets[run.first_target + in_run] : run.first_point + in_run;
    glm::dvec3 place = points.uvw[i];
    for (int axis = 0; axis < 3; ++axis) {
      place[axis] = is_far(run, static_cast<std::size_t>(axis)) ? 1 - place[axis] : place[axis];
    }
    const glm::dvec3 x = points.rest_points.empty() ? glm::dvec3(0) : points.rest_points[i];
    put<Real, kPlaceRows>(made.places, run.first_block, at,
                          {place.x, place.y, place.z, x.x, x.y, x.z});
    if (!made.slopes.empty()) {
      fill_slopes(points, run, at, i, rest_slopes(volume, rest, points.uvw[i]), made);
    }
  }
}

}  // namespace

template <class Real>
std::size_t PointRuns<Real>::bytes() const {
  return runs.capacity() * sizeof(PointRun) +
         (chunks.capacity() + targets.capacity()) * sizeof(std::uint32_t) +
         exact_uvw.capacity() * sizeof(glm::dvec3) +
         polynomials.capacity() * sizeof(AxisPolynomial<Real>) +
         (places.capacity() + slopes.capacity() + normals.capacity() + tangents.capacity()) *
             sizeof(Real);
}

template <class Real>
PointRuns<Real> make_point_runs(const Volume& volume, const BoundPoints& points) {
  require_valid(volume, points);
  PointRuns<Real> made;
  made.n_points = points.patches.size();
  made.polynomials = axis_polynomials<Real>(volume.extractions());
  RunMaker<Real> maker(volume, points, made);
  maker.make();
  const std::size_t n_rows = maker.n_blocks() * kBlock;
  made.places.resize(n_rows * kPlaceRows);
  made.normals.resize(points.normals.empty() ? 0 : n_rows * kVectorRows);
  made.tangents.resize(points.tangents.empty() ? 0 : n_rows * kVectorRows);
  if (points.has_gradients || !points.normals.empty() || !points.tangents.empty()) {
    made.slopes.resize(n_rows * kSlopeRows);
  }
  parallel_for(
      made.runs.size(), [&](std::size_t i) { fill_run(volume, points, made.runs[i], made); }, 16);
  return made;
}

template struct PointRuns<float>;
template struct PointRuns<double>;
template PointRuns<float> make_point_runs(const Volume&, const BoundPoints&);
template PointRuns<double> make_point_runs(const Volume&, const BoundPoints&);

}  // namespace espalier
