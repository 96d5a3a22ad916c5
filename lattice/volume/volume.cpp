#include "lattice/volume/volume.h"

#include <cassert>
#include <string>
#include <utility>

#include "lattice/core/error.h"
#include "lattice/core/parallel.h"

namespace espalier {
namespace {

/// Coefficients become Bézier points along one axis. n_before: values between neighbours on the
/// axis; values: any number of lines, end to end.
template <class T>
void extract(const Extraction& extraction, std::size_t n_before, const std::vector<T>& values,
             std::vector<T>& out) {
  const auto n_in = static_cast<std::size_t>(extraction.n_coefficients);
  const auto n_out = static_cast<std::size_t>(extraction.degree + 1);
  const std::size_t n_blocks = values.size() / (n_in * n_before);
  out.resize(n_blocks * n_out * n_before);
  for (std::size_t block = 0; block < n_blocks; ++block) {
    const T* in = &values[block * n_in * n_before];
    for (std::size_t i = 0; i < n_out; ++i) {
      const double* row = &extraction.rows[i * n_in];
      T* line = &out[(block * n_out + i) * n_before];
      for (std::size_t a = 0; a < n_before; ++a) {
        T sum = row[0] * in[a];
        for (std::size_t k = 1; k < n_in; ++k) {
          sum += row[k] * in[k * n_before + a];
        }
        line[a] = sum;
      }
    }
  }
}

}  // namespace

Box Patch::reach() const {
  Box box{glm::dvec3(0), glm::dvec3(1)};
  for (int axis = 0; axis < 3 && is_leaf; ++axis) {
    box.min[axis] -= is_on_boundary(2 * axis) ? 0 : kLeafReach;
    box.max[axis] += is_on_boundary(2 * axis + 1) ? 0 : kLeafReach;
  }
  if (is_pyramid) {
    box.max.z = 1;
  }
  return box;
}

Volume::Volume(VolumeTables tables, std::vector<glm::dvec3> rest_controls)
    : tables_(std::move(tables)),
      rest_controls_(std::move(rest_controls)),
      rest_points_(points(rest_controls_)),
      diagonal_(2 * box_of(tables_.offsets.empty() ? rest_controls_ : rest_points_).radius()) {
  assert(tables_.blocks.n_rows() == tables_.patches.size());
  assert(tables_.weights.empty() || tables_.weights.size() == n_points());
  for (const Extraction& extraction : tables_.extractions) {
    is_identity_.push_back(extraction == bezier_extraction(extraction.degree));
  }
}

std::vector<glm::dvec3> Volume::points(std::span<const glm::dvec3> controls) const {
  std::vector<glm::dvec3> result = tables_.stencils.apply(controls);
  for (std::size_t i = 0; i < tables_.offsets.size(); ++i) {
    result[i] += tables_.offsets[i];
  }
  return result;
}

std::vector<glm::dvec3> Volume::displacements(std::span<const glm::dvec3> pose) const {
  if (pose.size() != n_controls()) {
    throw ParameterError("the pose has " + std::to_string(pose.size()) +
                         " control points, the lattice " + std::to_string(n_controls()));
  }
  std::vector<glm::dvec3> moved(pose.begin(), pose.end());
  for (std::size_t i = 0; i < moved.size(); ++i) {
    moved[i] -= rest_controls_[i];
  }
  return tables_.stencils.apply(moved);
}

std::array<int, 3> Volume::degree(std::size_t i) const {
  const auto along = [&](std::size_t axis) {
    return tables_.extractions[patch(i).extractions[axis]].degree;
  };
  return {along(0), along(1), along(2)};
}

template <class T>
void Volume::extract_block(const Patch& patch, std::vector<T>& values) const {
  thread_local std::vector<T> extracted;
  std::size_t n_before = 1;
  for (const std::size_t index : patch.extractions) {
    const Extraction& extraction = tables_.extractions[index];
    if (!is_identity_[index]) {
      extract(extraction, n_before, values, extracted);
      values.assign(extracted.begin(), extracted.end());
    }
    n_before *= static_cast<std::size_t>(extraction.degree + 1);
  }
  assert(values.size() == n_before);
}

void Volume::bezier(std::size_t i, std::span<const glm::dvec3> values, BezierPatch& out) const {
  bezier(i, values, tables_.weights, out);
}

void Volume::bezier(std::size_t i, std::span<const glm::dvec3> values,
                    std::span<const double> weights, BezierPatch& out) const {
  const Patch& patch = tables_.patches[i];
  const std::span<const std::int32_t> points = tables_.blocks[i];
  out.is_pyramid = patch.is_pyramid;
  out.degree = degree(i);
  out.points.resize(points.size());
  out.weights.resize(weights.empty() ? 0 : points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto point = static_cast<std::size_t>(points[k]);
    if (weights.empty()) {
      out.points[k] = values[point];
    } else {
      out.weights[k] = weights[point];
      out.points[k] = weights[point] * values[point];
    }
  }
  extract_block(patch, out.points);
  if (!weights.empty()) {
    extract_block(patch, out.weights);
  }
}

BezierPatch Volume::bezier(std::size_t i, std::span<const glm::dvec3> values) const {
  BezierPatch patch;
  bezier(i, values, patch);
  return patch;
}

std::vector<Box> Volume::patch_boxes() const {
  std::vector<Box> boxes(n_patches());
  parallel_ranges(boxes.size(), 1024, [&](std::size_t begin, std::size_t end) {
    BezierPatch map;
    for (std::size_t i = begin; i < end; ++i) {
      bezier(i, rest_points_, map);
      boxes[i] = map.hull_box();
      if (patch(i).is_leaf) {
        const Box reach = patch(i).reach();
        boxes[i].add(map.part(reach.min, reach.max).hull_box());
      }
    }
  });
  return boxes;
}

std::size_t Volume::bytes() const {
  std::size_t sum =
      tables_.patches.capacity() * sizeof(Patch) + tables_.blocks.bytes() +
      tables_.stencils.bytes() + tables_.weights.capacity() * sizeof(double) +
      (rest_controls_.capacity() + rest_points_.capacity() + tables_.offsets.capacity()) *
          sizeof(glm::dvec3);
  for (const Extraction& extraction : tables_.extractions) {
    sum += extraction.rows.capacity() * sizeof(double);
  }
  return sum;
}

}  // namespace espalier
