#include "deform/evaluate/displace.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "lattice/core/parallel.h"

namespace espalier {
namespace {

constexpr std::size_t kPointsPerRange = 4096;

bool is_moved(const Volume& volume, std::size_t patch, std::span<const glm::dvec3> displacements) {
  const auto block = volume.block(patch);
  return std::any_of(block.begin(), block.end(), [&](std::int32_t point) {
    return displacements[static_cast<std::size_t>(point)] != glm::dvec3(0);
  });
}

/// Calls visit(patch, begin, end) for the points [begin, end) of each patch that moves, in parallel
/// over points; a patch with many points may be visited in several parts. patches: of the points,
/// ascending. Make: a visitor for one thread.
template <class Make>
void for_each_moved_run(const Volume& volume, std::span<const std::int32_t> patches,
                        std::span<const glm::dvec3> displacements, const Make& make) {
  parallel_ranges(patches.size(), kPointsPerRange, [&](std::size_t begin, std::size_t end) {
    auto visit = make();
    for (std::size_t next = begin; begin < end; begin = next) {
      while (next < end && patches[next] == patches[begin]) {
        ++next;
      }
      const auto patch = static_cast<std::size_t>(patches[begin]);
      if (is_moved(volume, patch, displacements)) {
        visit(patch, begin, next);
      }
    }
  });
}

/// Calls take(point, move) for every point of a patch that moves; a move may be zero.
template <class Take>
void for_each_move(const Volume& volume, const Binding& binding,
                   std::span<const glm::dvec3> displacements, const Take& take) {
  for_each_moved_run(volume, binding.patches, displacements, [&] {
    return
        [&, moves = BezierPatch()](std::size_t patch, std::size_t begin, std::size_t end) mutable {
          volume.bezier(patch, displacements, moves);
          for (std::size_t i = begin; i < end; ++i) {
            take(static_cast<std::size_t>(binding.points[i]), moves.value(binding.uvw[i]));
          }
        };
  });
  const Fringe& fringe = binding.fringe;
  for_each_moved_run(volume, fringe.patches, displacements, [&] {
    return
        [&, moves = BezierPatch()](std::size_t patch, std::size_t begin, std::size_t end) mutable {
          volume.bezier(patch, displacements, moves);
          for (std::size_t i = begin; i < end; ++i) {
            take(static_cast<std::size_t>(fringe.points[i]),
                 fringe.weights[i] * moves.value(fringe.uvw[i]));
          }
        };
  });
}

/// By the product rule: ∂(weight · move)/∂x for the fringe's points.
void add_fringe_gradients(const Volume& volume, const Fringe& fringe,
                          std::span<const glm::dvec3> displacements,
                          std::vector<glm::dmat3>& gradients) {
  for_each_moved_run(volume, fringe.patches, displacements, [&] {
    return
        [&, moves = BezierPatch()](std::size_t patch, std::size_t begin, std::size_t end) mutable {
          volume.bezier(patch, displacements, moves);
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
                                         std::span<const glm::dvec3> displacements) {
  std::vector<glm::dvec3> points(rest_points.begin(), rest_points.end());
  for_each_move(volume, binding, displacements, [&](std::size_t point, const glm::dvec3& move) {
    if (move != glm::dvec3(0)) {
      points[point] += move;
    }
  });
  return points;
}

std::vector<glm::dvec3> point_displacements(const Volume& volume, const Binding& binding,
                                            std::span<const glm::dvec3> displacements) {
  std::vector<glm::dvec3> moves(binding.status.size(), glm::dvec3(0));
  for_each_move(volume, binding, displacements,
                [&](std::size_t point, const glm::dvec3& move) { moves[point] = move; });
  return moves;
}

std::vector<glm::dmat3> deformation_gradients(const Volume& volume, const Binding& binding,
                                              std::span<const glm::dvec3> displacements) {
  std::vector<glm::dmat3> gradients(binding.status.size(), glm::dmat3(1));
  for_each_moved_run(volume, binding.patches, displacements, [&] {
    return [&, moves = BezierPatch(), rest = BezierPatch()](std::size_t patch, std::size_t begin,
                                                            std::size_t end) mutable {
      volume.bezier(patch, displacements, moves);
      volume.bezier(patch, volume.rest_points(), rest);
      for (std::size_t i = begin; i < end; ++i) {
        const glm::dmat3 by_parameters = moves.derivative(binding.uvw[i]);
        if (by_parameters != glm::dmat3(0)) {
          gradients[static_cast<std::size_t>(binding.points[i])] =
              glm::dmat3(1) + by_parameters * glm::inverse(rest.derivative(binding.uvw[i]));
        }
      }
    };
  });
  add_fringe_gradients(volume, binding.fringe, displacements, gradients);
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
