#include "deform/evaluate/displace.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "deform/evaluate/evaluator.h"
#include "lattice/core/parallel.h"

namespace espalier {
namespace {

constexpr std::size_t kPointsPerRange = 4096;

VolumeMotion<double> motion_of(const Volume& volume, std::span<const glm::dvec3> displacements,
                               std::span<const double> pose_weights) {
  return pose_weights.empty()
             ? VolumeMotion<double>(displacements)
             : VolumeMotion<double>(displacements, {volume.weights(), pose_weights});
}

/// Calls visit(patch, begin, end) for the points [begin, end) of each patch that moves, in parallel
/// over points; a patch with many points may be visited in several parts. patches: of the points,
/// ascending. Make: a visitor for one thread.
template <class Make>
void for_each_moved_run(const Volume& volume, std::span<const std::int32_t> patches,
                        const VolumeMotion<double>& motion, const Make& make) {
  parallel_ranges(patches.size(), kPointsPerRange, [&](std::size_t begin, std::size_t end) {
    auto visit = make();
    for (std::size_t next = begin; begin < end; begin = next) {
      while (next < end && patches[next] == patches[begin]) {
        ++next;
      }
      const auto patch = static_cast<std::size_t>(patches[begin]);
      if (motion.is_any_moved(volume.block(patch))) {
        visit(patch, begin, next);
      }
    }
  });
}

/// Places of a binding or its fringe, those in moved patches, as an evaluator takes them.
struct MovedPlaces {
  std::vector<std::size_t> indices;  ///< into the arrays that they come from
  std::vector<std::int32_t> patches;
  std::vector<glm::dvec3> uvw;
};

/// Calls work(places) for ranges of the places in moved patches, in parallel. patches, uvw: of all
/// places, ascending.
template <class Work>
void for_each_moved_range(const Volume& volume, std::span<const std::int32_t> patches,
                          std::span<const glm::dvec3> uvw, const VolumeMotion<double>& motion,
                          const Work& work) {
  parallel_ranges(patches.size(), kPointsPerRange, [&](std::size_t begin, std::size_t end) {
    MovedPlaces places;
    for (std::size_t next = begin; begin < end; begin = next) {
      while (next < end && patches[next] == patches[begin]) {
        ++next;
      }
      if (motion.is_any_moved(volume.block(static_cast<std::size_t>(patches[begin])))) {
        for (std::size_t i = begin; i < next; ++i) {
          places.indices.push_back(i);
          places.patches.push_back(patches[i]);
          places.uvw.push_back(uvw[i]);
        }
      }
    }
    if (!places.indices.empty()) {
      work(places);
    }
  });
}

/// Calls take(index, move) for every place in a moved patch; a move may be zero.
template <class Take>
void for_each_move(const Volume& volume, std::span<const std::int32_t> patches,
                   std::span<const glm::dvec3> uvw, const VolumeMotion<double>& motion,
                   const Take& take) {
  for_each_moved_range(volume, patches, uvw, motion, [&](const MovedPlaces& places) {
    std::vector<glm::dvec3> moves(places.indices.size());
    Evaluator<double>(volume, {places.patches, places.uvw, {}}).evaluate(motion, {.points = moves});
    for (std::size_t i = 0; i < moves.size(); ++i) {
      take(places.indices[i], moves[i]);
    }
  });
}

/// Calls take(point, move) for every bound point in a moved patch.
template <class Take>
void for_each_move(const Volume& volume, const Binding& binding, const VolumeMotion<double>& motion,
                   const Take& take) {
  for_each_move(volume, binding.patches, binding.uvw, motion,
                [&](std::size_t i, const glm::dvec3& move) {
                  take(static_cast<std::size_t>(binding.points[i]), move);
                });
  const Fringe& fringe = binding.fringe;
  for_each_move(volume, fringe.patches, fringe.uvw, motion,
                [&](std::size_t i, const glm::dvec3& move) {
                  take(static_cast<std::size_t>(fringe.points[i]), fringe.weights[i] * move);
                });
}

/// By the product rule: ∂(weight · move)/∂x for the fringe's points.
void add_fringe_gradients(const Volume& volume, const Fringe& fringe,
                          const VolumeMotion<double>& motion, std::vector<glm::dmat3>& gradients) {
  for_each_moved_run(volume, fringe.patches, motion, [&] {
    return
        [&, moves = BezierPatch()](std::size_t patch, std::size_t begin, std::size_t end) mutable {
          find_motion(volume, motion, patch, moves);
          for (std::size_t i = begin; i < end; ++i) {
            glm::dvec3 move;
            glm::dmat3 by_parameters;
            moves.evaluate(fringe.uvw[i], move, by_parameters);
            if (moves.is_pyramid) {
              by_parameters[0] *= 1 - fringe.uvw[i].z;
              by_parameters[1] *= 1 - fringe.uvw[i].z;
            }
            gradients[static_cast<std::size_t>(fringe.points[i])] +=
                glm::outerProduct(move, fringe.weight_slopes[i]) +
                fringe.weights[i] * by_parameters * fringe.uvw_slopes[i];
          }
        };
  });
}

}  // namespace

std::vector<glm::dvec3> displaced_points(const Volume& volume, const Binding& binding,
                                         std::span<const glm::dvec3> rest_points,
                                         std::span<const glm::dvec3> displacements,
                                         std::span<const double> pose_weights) {
  const VolumeMotion<double> motion = motion_of(volume, displacements, pose_weights);
  std::vector<glm::dvec3> points(rest_points.begin(), rest_points.end());
  for_each_move(volume, binding, motion, [&](std::size_t point, const glm::dvec3& move) {
    if (move != glm::dvec3(0)) {
      points[point] += move;
    }
  });
  return points;
}

std::vector<glm::dvec3> point_displacements(const Volume& volume, const Binding& binding,
                                            std::span<const glm::dvec3> displacements,
                                            std::span<const double> pose_weights) {
  const VolumeMotion<double> motion = motion_of(volume, displacements, pose_weights);
  std::vector<glm::dvec3> moves(binding.status.size(), glm::dvec3(0));
  for_each_move(volume, binding, motion,
                [&](std::size_t point, const glm::dvec3& move) { moves[point] = move; });
  return moves;
}

std::vector<glm::dmat3> deformation_gradients(const Volume& volume, const Binding& binding,
                                              std::span<const glm::dvec3> displacements,
                                              std::span<const double> pose_weights) {
  std::vector<glm::dmat3> gradients(binding.status.size(), glm::dmat3(1));
  const VolumeMotion<double> motion = motion_of(volume, displacements, pose_weights);
  for_each_moved_range(
      volume, binding.patches, binding.uvw, motion, [&](const MovedPlaces& places) {
        std::vector<glm::dmat3> found(places.indices.size());
        Evaluator<double>(volume,
                          {.patches = places.patches, .uvw = places.uvw, .has_gradients = true})
            .evaluate(motion, {.gradients = found});
        for (std::size_t i = 0; i < found.size(); ++i) {
          gradients[static_cast<std::size_t>(binding.points[places.indices[i]])] = found[i];
        }
      });
  add_fringe_gradients(volume, binding.fringe, motion, gradients);
  return gradients;
}

glm::dvec3 turned_normal(const glm::dmat3& J, const glm::dvec3& normal) {
  // The columns of cof(J) are the cross products of the columns of J.
  const glm::dvec3 turned = normal.x * glm::cross(J[1], J[2]) + normal.y * glm::cross(J[2], J[0]) +
                            normal.z * glm::cross(J[0], J[1]);
  const double length = glm::length(turned);
  return length > 0 ? turned / length : glm::dvec3(0);
}

}  // namespace espalier
