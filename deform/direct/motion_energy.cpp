// The smallest motion [HHK92]: coordinates are the control points' own, divided by √mobility.

#include "deform/direct/motion_energy.h"

#include <cmath>
#include <limits>
#include <string>

#include "lattice/core/error.h"

namespace espalier {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// Only control points that some row sees and that may move have a coordinate.
class SmallestMotion final : public MotionEnergy {
 public:
  SmallestMotion(const StencilTable& rows, std::span<const double> mobilities)
      : place_(rows.n_controls(), kNone) {
    for (std::size_t i = 0; i < rows.n_rows(); ++i) {
      for (const std::int32_t control : rows[i].indices) {
        const auto c = static_cast<std::size_t>(control);
        const double mobility = mobilities.empty() ? 1.0 : mobilities[c];
        if (place_[c] == kNone && mobility > 0) {
          place_[c] = controls_.size();
          controls_.push_back(c);
          scales_.push_back(std::sqrt(mobility));
        }
      }
    }
  }

  [[nodiscard]] std::size_t n_controls() const override { return place_.size(); }

  [[nodiscard]] DenseMatrix columns(const StencilTable& rows) const override {
    DenseMatrix result{controls_.size(), rows.n_rows()};
    require_solvable(result);
    result.values.assign(result.n_rows * result.n_columns, 0.0);
    for (std::size_t i = 0; i < rows.n_rows(); ++i) {
      const StencilTable::Row row = rows[i];
      for (std::size_t k = 0; k < row.indices.size(); ++k) {
        const std::size_t place = place_[static_cast<std::size_t>(row.indices[k])];
        if (place != kNone) {
          result.values[i * result.n_rows + place] = row.weights[k] * scales_[place];
        }
      }
    }
    return result;
  }

  [[nodiscard]] DenseMatrix free_columns(const StencilTable& /*rows*/) const override { return {}; }

  [[nodiscard]] std::vector<glm::dvec3> motion(std::span<const glm::dvec3> y,
                                               std::span<const glm::dvec3> /*a*/) const override {
    std::vector<glm::dvec3> result(place_.size(), glm::dvec3(0));
    for (std::size_t i = 0; i < controls_.size(); ++i) {
      result[controls_[i]] = scales_[i] * y[i];
    }
    return result;
  }

 private:
  std::vector<std::size_t> place_;     // #controls: among those with a coordinate, or kNone
  std::vector<std::size_t> controls_;  // that have one
  std::vector<double> scales_;         // the same: √mobility
};

}  // namespace

void require_mobilities(std::span<const double> mobilities, std::size_t n_controls) {
  if (mobilities.size() != n_controls) {
    throw ParameterError("there are " + std::to_string(mobilities.size()) + " mobilities for " +
                         std::to_string(n_controls) + " control points: give one for each");
  }
  for (std::size_t i = 0; i < n_controls; ++i) {
    if (!(mobilities[i] >= 0 && std::isfinite(mobilities[i]))) {
      throw ParameterError("the mobility of control point " + std::to_string(i) + " is " +
                           std::to_string(mobilities[i]) + ", must be 0 or more");
    }
  }
}

std::shared_ptr<const MotionEnergy> smallest_motion(const StencilTable& rows,
                                                    std::span<const double> mobilities) {
  if (!mobilities.empty()) {
    require_mobilities(mobilities, rows.n_controls());
  }
  return std::make_shared<const SmallestMotion>(rows, mobilities);
}

}  // namespace espalier
