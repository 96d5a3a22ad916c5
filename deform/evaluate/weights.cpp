/// The chain of linear maps from control points to bound points: stencils, extraction, Bernstein
/// polynomials.

#include "deform/evaluate/weights.h"

#include <array>
#include <cstdint>
#include <vector>

namespace espalier {
namespace {

/// The Bernstein polynomials of a degree at t.
std::vector<double> bernstein_values(int degree, double t) {
  std::vector<double> values = {1};
  for (int n = 1; n <= degree; ++n) {
    values.push_back(0);
    for (std::size_t i = values.size() - 1; i > 0; --i) {
      values[i] = (1 - t) * values[i] + t * values[i - 1];
    }
    values[0] *= 1 - t;
  }
  return values;
}

/// How the value at t depends on the coefficients of one axis.
std::vector<double> coefficient_weights(const Extraction& extraction, double t) {
  const std::vector<double> values = bernstein_values(extraction.degree, t);
  std::vector<double> weights(static_cast<std::size_t>(extraction.n_coefficients), 0.0);
  for (int point = 0; point <= extraction.degree; ++point) {
    for (int k = 0; k < extraction.n_coefficients; ++k) {
      weights[static_cast<std::size_t>(k)] +=
          values[static_cast<std::size_t>(point)] * extraction.row(point, k);
    }
  }
  return weights;
}

/// Adds `weight` times the stencil of one of the volume's points.
void add_stencil(const StencilTable::Row& stencil, double weight, StencilRow& row) {
  for (std::size_t k = 0; k < stencil.indices.size(); ++k) {
    row.add(stencil.indices[k], weight * stencil.weights[k]);
  }
}

/// The row of a place in a patch; of a rational patch, w B / Σ w B instead of B.
void add_place(const Volume& volume, std::size_t patch, const glm::dvec3& uvw, StencilRow& row) {
  std::array<std::vector<double>, 3> axes;
  for (int a = 0; a < 3; ++a) {
    const auto axis = static_cast<std::size_t>(a);
    axes[axis] =
        coefficient_weights(volume.extractions()[volume.patch(patch).extractions[axis]], uvw[a]);
  }
  const std::span<const double> weights = volume.weights();
  const auto for_each_point = [&](const auto& visit) {
    auto point = volume.block(patch).begin();
    for (const double w : axes[2]) {
      for (const double v : axes[1]) {
        for (const double u : axes[0]) {
          const auto at = static_cast<std::size_t>(*point++);
          visit(at, weights.empty() ? u * v * w : u * v * w * weights[at]);
        }
      }
    }
  };
  double sum = 1;
  if (!weights.empty()) {
    sum = 0;
    for_each_point([&](std::size_t, double weight) { sum += weight; });
  }
  for_each_point([&](std::size_t point, double weight) {
    if (weight != 0) {
      add_stencil(volume.stencils()[point], weight / sum, row);
    }
  });
}

}  // namespace

StencilTable control_weights(const Volume& volume, const Binding& binding) {
  constexpr std::int32_t kNowhere = -1;
  std::vector<std::int32_t> held(binding.status.size(), kNowhere);  // place in the binding's arrays
  for (std::size_t i = 0; i < binding.points.size(); ++i) {
    held[static_cast<std::size_t>(binding.points[i])] = static_cast<std::int32_t>(i);
  }
  return StencilTable::build(
      binding.status.size(), volume.n_controls(), [&](std::size_t point, StencilRow& row) {
        if (held[point] != kNowhere) {
          const auto i = static_cast<std::size_t>(held[point]);
          add_place(volume, static_cast<std::size_t>(binding.patches[i]), binding.uvw[i], row);
        }
      });
}

}  // namespace espalier
