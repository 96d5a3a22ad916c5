#include "deform/model/normals.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "deform/model/pairs.h"

namespace espalier {
namespace {

bool is_same_direction(const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 d = a - b;
  return glm::dot(d, d) <= kSameNormal * kSameNormal;
}

/// Gathers unit vectors; one within kSameNormal of an earlier one joins it. O(1) a vector.
class DirectionSet {
 public:
  void clear() {
    directions_.clear();
    next_in_cell_.clear();
    if (!first_in_cell_.empty()) {
      first_in_cell_ = {};  // clear() would cost as much as the largest set so far, every time
    }
  }

  /// Index of the direction that `direction` joins or becomes.
  std::int32_t add(const glm::dvec3& direction) {
    const std::int32_t found =
        directions_.size() <= kFew ? find_among_few(direction) : find_in_cells(direction);
    if (found >= 0) {
      return found;
    }
    directions_.push_back(direction);
    if (directions_.size() > kFew) {
      while (next_in_cell_.size() < directions_.size()) {
        add_to_cell(static_cast<std::int32_t>(next_in_cell_.size()));
      }
    }
    return static_cast<std::int32_t>(directions_.size()) - 1;
  }

  [[nodiscard]] std::span<const glm::dvec3> directions() const { return directions_; }

 private:
  static constexpr std::size_t kFew = 8;
  // A ball of radius kSameNormal meets at most two cells per axis.
  static constexpr double kCellSize = 2.001 * kSameNormal;

  [[nodiscard]] static std::uint64_t cell_key(const glm::dvec3& place) {
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto cell = static_cast<std::int64_t>(std::floor(place[axis] / kCellSize));
      key = (key << 21) | (static_cast<std::uint64_t>(cell) & 0x1FFFFF);
    }
    return key;
  }

  void add_to_cell(std::int32_t index) {
    const auto [cell, is_new] = first_in_cell_.try_emplace(cell_key(directions_[index]), -1);
    next_in_cell_.push_back(cell->second);
    cell->second = index;
  }

  [[nodiscard]] std::int32_t find_among_few(const glm::dvec3& direction) const {
    for (std::size_t i = 0; i < directions_.size(); ++i) {
      if (is_same_direction(directions_[i], direction)) {
        return static_cast<std::int32_t>(i);
      }
    }
    return -1;
  }

  /// The earliest within reach, so that the result does not depend on the cells.
  [[nodiscard]] std::int32_t find_in_cells(const glm::dvec3& direction) const {
    std::int32_t found = -1;
    for (int octant = 0; octant < 8; ++octant) {
      const glm::dvec3 side(octant & 1, (octant >> 1) & 1, octant >> 2);
      const auto cell = first_in_cell_.find(cell_key(direction + kCellSize * (side - 0.5)));
      for (std::int32_t i = cell == first_in_cell_.end() ? -1 : cell->second; i >= 0;
           i = next_in_cell_[i]) {
        if ((found < 0 || i < found) && is_same_direction(directions_[i], direction)) {
          found = i;
        }
      }
    }
    return found;
  }

  std::vector<glm::dvec3> directions_;
  std::unordered_map<std::uint64_t, std::int32_t> first_in_cell_;  // in use beyond kFew
  std::vector<std::int32_t> next_in_cell_;
};

CompressedRows<std::int32_t> pairs_of_normals(const Model& model) {
  std::vector<std::int32_t> normal_of_pair;
  normal_of_pair.reserve(model.pairs().size());
  for (const PointNormal& pair : model.pairs()) {
    normal_of_pair.push_back(pair.normal);
  }
  return rows_by_key(normal_of_pair, model.normals().size());
}

}  // namespace

glm::dvec3 unit_or_zero(glm::dvec3 v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(largest > 0) || !std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) {
    return glm::dvec3(0);
  }
  v /= largest;
  return v / glm::length(v);
}

NormalPlan split_normals(const Model& model, std::span<const glm::dvec3> pair_normals) {
  NormalPlan plan;
  plan.value_of_pair.assign(pair_normals.size(), 0);
  const CompressedRows<std::int32_t> pairs_of = pairs_of_normals(model);
  DirectionSet directions;
  std::vector<glm::dvec3> values;
  for (std::size_t normal = 0; normal < pairs_of.n_rows(); ++normal) {
    directions.clear();
    const glm::dvec3 old_direction = unit_or_zero(model.normals()[normal]);
    directions.add(old_direction);  // first, so that what has not turned finds it
    bool is_old_used = pairs_of[normal].empty();
    for (const std::int32_t pair : pairs_of[normal]) {
      const glm::dvec3 direction = unit_or_zero(pair_normals[pair]);
      plan.value_of_pair[pair] = direction == glm::dvec3(0) ? 0 : directions.add(direction);
      is_old_used |= plan.value_of_pair[pair] == 0;
    }
    values.assign(directions.directions().begin(), directions.directions().end());
    values.front() = model.normals()[normal];
    if (!is_old_used) {
      values.erase(values.begin());
      for (const std::int32_t pair : pairs_of[normal]) {
        --plan.value_of_pair[pair];
      }
    }
    plan.values.push_back(values);
  }
  return plan;
}

NormalPlan average_normals(const Model& model, std::span<const glm::dvec3> pair_normals) {
  NormalPlan plan;
  plan.value_of_pair.assign(pair_normals.size(), 0);
  const CompressedRows<std::int32_t> pairs_of = pairs_of_normals(model);
  std::vector<glm::dvec3> values(model.normals().begin(), model.normals().end());
  for (std::size_t normal = 0; normal < values.size(); ++normal) {
    glm::dvec3 sum(0);
    for (const std::int32_t pair : pairs_of[normal]) {
      sum += unit_or_zero(pair_normals[pair]);
    }
    const glm::dvec3 direction = unit_or_zero(sum);
    if (direction != glm::dvec3(0) && !is_same_direction(direction, unit_or_zero(values[normal]))) {
      values[normal] = direction;
    }
  }
  if (!values.empty()) {
    plan.values = CompressedRows<glm::dvec3>::uniform(1, std::move(values));
  }
  return plan;
}

}  // namespace espalier
