#include "viewer/interact/influence_heat.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>

#include "deform/evaluate/weights.h"
#include "lattice/core/parallel.h"

namespace espalier::viewer {

InfluenceHeat::InfluenceHeat(const Volume& volume, std::shared_ptr<const Binding> binding)
    : binding_(std::move(binding)), weights_(control_weights(volume, *binding_)) {}

std::vector<double> InfluenceHeat::of(const Selection& controls) const {
  std::vector<char> is_selected(weights_.n_controls(), 0);
  for (const std::int32_t control : controls) {
    is_selected[static_cast<std::size_t>(control)] = 1;
  }
  std::vector<double> sums(weights_.n_rows(), 0.0);
  parallel_for(sums.size(), [&](std::size_t point) {
    const StencilTable::Row row = weights_[point];
    for (std::size_t i = 0; i < row.indices.size(); ++i) {
      if (is_selected[static_cast<std::size_t>(row.indices[i])] != 0) {
        sums[point] += row.weights[i];
      }
    }
  });
  return sums;
}

glm::vec3 heat_color(double weight) {
  static constexpr std::array<glm::vec3, 5> kColors = {glm::vec3{0.16F, 0.22F, 0.70F},
                                                       {0.10F, 0.62F, 0.85F},
                                                       {0.25F, 0.78F, 0.35F},
                                                       {0.96F, 0.86F, 0.22F},
                                                       {0.90F, 0.22F, 0.18F}};
  const double place = 4 * std::clamp(weight, 0.0, 1.0);
  const auto low = std::min<std::size_t>(3, static_cast<std::size_t>(place));
  return glm::mix(kColors.at(low), kColors.at(low + 1),
                  static_cast<float>(place - static_cast<double>(low)));
}

}  // namespace espalier::viewer
