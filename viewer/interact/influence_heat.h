#pragma once

/// How much the selected control points move each point of a model.

#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "deform/embed/embed.h"
#include "lattice/volume/stencil_table.h"
#include "lattice/volume/volume.h"
#include "viewer/interact/lattice_elements.h"

namespace espalier::viewer {

/// The weights of one binding, found once.
class InfluenceHeat {
 public:
  /// O(#weights of the patches).
  InfluenceHeat(const Volume& volume, std::shared_ptr<const Binding> binding);

  [[nodiscard]] bool is_for(const std::shared_ptr<const Binding>& binding) const {
    return binding == binding_;
  }
  /// #points: the sum of the weights of these control points, in [0, 1] but for round-off and
  /// rational patches; 0 where the lattice does not hold the point.
  [[nodiscard]] std::vector<double> of(const Selection& controls) const;

 private:
  std::shared_ptr<const Binding> binding_;
  StencilTable weights_;
};

/// From blue for 0 over green and yellow to red for 1; clamped.
[[nodiscard]] glm::vec3 heat_color(double weight);

}  // namespace espalier::viewer
