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
void extract(const Extraction& extraction, std::size_t n_before,
             const std::vector<glm::dvec3>& values, std::vector<glm::dvec3>& out) {
  const auto n_in = static_cast<std::size_t>(extraction.n_coefficients);
  const auto n_out = static_cast<std::size_t>(extraction.degree + 1);
  const std::size_t n_blocks = values.size() / (n_in * n_before);
  out.resize(n_blocks * n_out * n_before);
  for (std::size_t block = 0; block < n_blocks; ++block) {
    const glm::dvec3* in = &values[block * n_in * n_before];
    for (std::size_t i = 0; i < n_out; ++i) {
      const double* row = &extraction.rows[i * n_in];
      glm::dvec3* line = &out[(block * n_out + i) * n_before];
      for (std::size_t a = 0; a < n_before; ++a) {
        glm::dvec3 sum = row[0] * in[a];
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
      diagonal_(2 * box_of(rest_controls_).radius()) {
  assert(tables_.blocks.n_rows() == tables_.patches.size());
  for (const Extraction& extraction : tables_.extractions) {
    is_identity_.push_back(extraction == bezier_extraction(extraction.degree));
  }
}

std::vector<glm::dvec3> Volume::points(std::span<const glm::dvec3> controls) const {
  return tables_.stencils.apply(controls);
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
  return points(moved);
}

std::array<int, 3> Volume::degree(std::size_t i) const {
  const auto along = [&](std::size_t axis) {
    return tables_.extractions[patch(i).extractions[axis]].degree;
  };
  return {along(0), along(1), along(2)};
}

void Volume::bezier(std::size_t i, std::span<const glm::dvec3> values, BezierPatch& out) const {
  const Patch& patch = tables_.patches[i];
  const std::span<const std::int32_t> points = tables_.blocks[i];
  out.is_pyramid = patch.is_pyramid;
  out.points.resize(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    out.points[k] = values[static_cast<std::size_t>(points[k])];
  }
  thread_local std::vector<glm::dvec3> extracted;
  std::size_t n_before = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t index = patch.extractions[axis];
    const Extraction& extraction = tables_.extractions[index];
    if (!is_identity_[index]) {
      extract(extraction, n_before, out.points, extracted);
      out.points.assign(extracted.begin(), extracted.end());
    }
    out.degree[axis] = extraction.degree;
    n_before *= static_cast<std::size_t>(extraction.degree + 1);
  }
  assert(out.points.size() == n_before);
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
  std::size_t sum = tables_.patches.capacity() * sizeof(Patch) + tables_.blocks.bytes() +
                    tables_.stencils.bytes() +
                    (rest_controls_.capacity() + rest_points_.capacity()) * sizeof(glm::dvec3);
  for (const Extraction& extraction : tables_.extractions) {
    sum += extraction.rows.capacity() * sizeof(double);
  }
  return sum;
}

}  // namespace espalier
