#include "lattice/volume/rest_patches.h"

#include <algorithm>

#include "lattice/core/parallel.h"

namespace espalier {
namespace {

constexpr std::size_t kTrilinear = 8;

std::size_t n_bezier_points(const Volume& volume, std::size_t i) {
  const auto [p, q, r] = volume.degree(i);
  return static_cast<std::size_t>((p + 1) * (q + 1) * (r + 1));
}

}  // namespace

RestPatches::RestPatches(const Volume& volume, double slack)
    : volume_(&volume), kept_(volume.n_patches(), -1) {
  std::size_t n_points = 0;
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    if (const std::size_t n = n_bezier_points(volume, i); n > kTrilinear) {
      kept_[i] = static_cast<std::int32_t>(first_.size());
      first_.push_back(n_points);
      n_points += n;
    }
  }
  points_.resize(n_points);
  weights_.resize(volume.is_rational() ? n_points : 0);
  frames_.resize(first_.size());
  parallel_ranges(kept_.size(), 256, [&](std::size_t begin, std::size_t end) {
    BezierPatch patch;
    for (std::size_t i = begin; i < end; ++i) {
      if (kept_[i] >= 0) {
        const auto k = static_cast<std::size_t>(kept_[i]);
        volume.bezier(i, volume.rest_points(), patch);
        std::copy(patch.points.begin(), patch.points.end(),
                  points_.begin() + static_cast<std::ptrdiff_t>(first_[k]));
        std::copy(patch.weights.begin(), patch.weights.end(),
                  weights_.begin() + static_cast<std::ptrdiff_t>(first_[k]));
        frames_[k] = PatchFrame(patch, slack, volume.patch(i).reach());
      }
    }
  });
}

BezierView RestPatches::view(std::size_t i, BezierPatch& scratch) const {
  if (kept_[i] < 0) {
    volume_->bezier(i, volume_->rest_points(), scratch);
    return scratch;
  }
  const std::size_t first = first_[static_cast<std::size_t>(kept_[i])];
  const std::size_t n = n_bezier_points(*volume_, i);
  const std::span<const double> weights(weights_);
  return {volume_->degree(i),
          {&points_[first], n},
          volume_->patch(i).is_pyramid,
          weights.empty() ? weights : weights.subspan(first, n)};
}

}  // namespace espalier
