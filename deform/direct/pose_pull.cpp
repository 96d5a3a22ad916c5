#include "deform/direct/pose_pull.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "deform/direct/pull.h"
#include "deform/direct/smooth_motion.h"
#include "deform/direct/table_rows.h"
#include "deform/embed/embed.h"
#include "deform/injectivity/injectivity.h"
#include "lattice/core/error.h"
#include "lattice/tensor/thb_refine.h"

namespace espalier {
namespace {

/// Within which places are the same, and goals reached by refining: parts of the diagonal. Groups,
/// which may be bent in any way, are not followed to the last digit.
constexpr double kSamePlace = 1e-9;
constexpr double kReached = 1e-12;
constexpr double kReachedByGroups = 1e-6;
/// Beyond this part of the diagonal a pick misses.
constexpr double kMiss = 1e-9;
/// A certified step is one without a fold below it: stay below.
constexpr double kShortOfFold = 1 - 1e-6;

/// A lattice that may be refined, with what pulling it takes.
struct Stage {
  Lattice lattice;
  std::shared_ptr<const Volume> volume;
  std::vector<double> mobilities;
  std::vector<glm::dvec3> motion = {};
  std::vector<glm::dvec3> wanted = {};     // #points of the task; zero for those that are left out
  std::vector<glm::dvec3> residuals = {};  // the same
  std::vector<char> is_held = {};          // the same
};

/// Throws LatticeError naming a patch that is flat at rest.
void require_volume(const Volume& volume) {
  constexpr double kFlat = 1e-12;
  BezierPatch patch;
  for (std::size_t i = 0; i < volume.n_patches(); ++i) {
    volume.bezier(i, volume.rest_points(), patch);
    const glm::dmat3 J = patch.derivative(glm::dvec3(0.5));
    const double sides = glm::length(J[0]) * glm::length(J[1]) * glm::length(J[2]);
    if (!(std::abs(glm::determinant(J)) > kFlat * sides)) {
      const glm::dvec3 place = patch.value(glm::dvec3(0.5));
      throw LatticeError(fmt::format(
          "the lattice at rest is singular in patch {}, round ({}, {}, {}): a point there has no "
          "place in it",
          i, place.x, place.y, place.z));
    }
  }
}

/// How pulled points move with the pose as it is.
std::vector<glm::dvec3> current_moves(const Stage& stage, const StencilTable& rows) {
  const auto rest = stage.volume->rest_controls();
  std::vector<glm::dvec3> moves(stage.lattice.posed_points().begin(),
                                stage.lattice.posed_points().end());
  for (std::size_t i = 0; i < moves.size(); ++i) {
    moves[i] -= rest[i];
  }
  return rows.apply(moves);
}

glm::dvec3 wanted_move(const PullTask& task, const PulledPoint& point, const glm::dvec3& current) {
  switch (point.aim) {
    case Aim::Place:
      return point.goal - current;
    case Aim::Shift:
      return point.goal;
    default:
      return glm::dot(task.plane_point - current, task.plane_normal) * task.plane_normal;
  }
}

/// Solves for the rows of the points that are held.
PullMotion solved(const PullTask& task, const Stage& stage, const StencilTable& rows,
                  std::span<const std::size_t> held, const Progress& progress) {
  std::vector<std::size_t> free;
  std::vector<std::size_t> flat;
  std::vector<glm::dvec3> wanted;
  std::vector<double> distances;
  std::size_t n_of_groups = 0;
  for (const std::size_t i : held) {
    if (task.points[i].aim == Aim::Plane) {
      flat.push_back(i);
      distances.push_back(glm::dot(stage.wanted[i], task.plane_normal));
    } else {
      n_of_groups += task.points[i].aim == Aim::Shift ? 1 : 0;
      free.push_back(i);
      wanted.push_back(stage.wanted[i]);
    }
  }
  const StencilTable all = selected_rows(rows, held);
  const auto energy = task.is_smooth
                          ? smooth_motion(all, neighbour_differences(stage.lattice, *stage.volume),
                                          stage.mobilities)
                          : smallest_motion(all, stage.mobilities);
  if (flat.empty()) {
    return Pull(all, energy, n_of_groups, progress).motion(wanted);
  }
  return pull_with_plane(selected_rows(rows, free), n_of_groups, wanted,
                         {selected_rows(rows, flat), task.plane_normal}, distances, energy,
                         progress);
}

void solve(const PullTask& task, std::span<const glm::dvec3> model,
           std::span<const glm::dvec3> places, const Progress& progress, Stage& stage) {
  const StencilTable rows = rows_of(*stage.volume, task.points, model, task.symmetry, progress);
  const std::vector<glm::dvec3> moves = current_moves(stage, rows);
  const std::size_t n = task.points.size();
  stage.wanted.assign(n, glm::dvec3(0));
  stage.residuals.assign(n, glm::dvec3(0));
  stage.is_held.assign(n, 0);
  std::vector<std::size_t> held;
  for (std::size_t i = 0; i < n; ++i) {
    if (!rows[i].indices.empty()) {
      stage.is_held[i] = 1;
      stage.wanted[i] = wanted_move(task, task.points[i], places[i] + moves[i]);
      held.push_back(i);
    }
  }
  // Picks first, then groups, then those that go to the plane.
  std::stable_sort(held.begin(), held.end(), [&](std::size_t a, std::size_t b) {
    return task.points[a].aim < task.points[b].aim;
  });
  std::vector<PulledPoint> points;
  std::vector<glm::dvec3> held_places;
  std::vector<glm::dvec3> held_wanted;
  for (const std::size_t i : held) {
    points.push_back(task.points[i]);
    held_places.push_back(places[i]);
    held_wanted.push_back(stage.wanted[i]);
  }
  require_no_contradiction(points, held_places, held_wanted, task.plane_normal,
                           kSamePlace * stage.volume->diagonal());
  PullMotion pulled = solved(task, stage, rows, held, progress);
  stage.motion = std::move(pulled.motion);
  for (std::size_t i = 0; i < held.size(); ++i) {
    stage.residuals[held[i]] = pulled.residuals[i];
  }
}

/// The points that are farther from their goals than parts of the lattice's size: round-off is of
/// the size of places.
std::vector<std::size_t> missing(std::span<const PulledPoint> points, const Stage& stage,
                                 double of_picks) {
  double size = stage.volume->diagonal();
  for (const glm::dvec3& p : stage.volume->rest_controls()) {
    size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  size = std::max(size, longest(stage.wanted));
  std::vector<std::size_t> missed;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double reached = points[i].aim == Aim::Place ? of_picks : kReachedByGroups;
    if (glm::length(stage.residuals[i]) > reached * size) {
      missed.push_back(i);
    }
  }
  return missed;
}

/// One level more under points.
Stage refined(const Stage& stage, const PullTask& task, std::span<const glm::dvec3> model,
              std::span<const std::size_t> under) {
  const auto& before = *stage.lattice.as<ThbLattice>();
  std::vector<glm::dvec3> corners;
  for (const std::size_t i : under) {
    for (const auto& [corner, weight] : task.points[i].point.corners) {
      corners.push_back(task.points[i].is_image ? task.symmetry->image_of_place(model[corner])
                                                : model[corner]);
    }
  }
  const Binding binding = embed(*stage.volume, corners);
  ThbLattice after = refined_round(
      before,
      places_in_whole(*before.hierarchy, before.hierarchy->leaves(), binding.patches, binding.uvw));
  std::vector<double> mobilities;
  if (!stage.mobilities.empty()) {
    mobilities = carried_over(before, after, stage.mobilities);
  }
  Lattice lattice(std::move(after));
  auto volume = std::make_shared<const Volume>(lattice.freeze());
  return {std::move(lattice), std::move(volume), std::move(mobilities)};
}

/// How much farther control points move than any point is to.
double gain_of(const Stage& stage) {
  const double wanted = longest(stage.wanted);
  return wanted > 0 ? longest(stage.motion) / wanted : 0;
}

/// The points to refine under: those that miss their goals, or all if they are taken there by
/// throwing control points far away.
std::vector<std::size_t> strained(const PullTask& task, const Stage& stage) {
  std::vector<std::size_t> points = missing(task.points, stage, kReached);
  if (points.empty() && gain_of(stage) > Pull::kMostGain) {
    for (std::size_t i = 0; i < task.points.size(); ++i) {
      if (stage.is_held[i] != 0) {
        points.push_back(i);
      }
    }
  }
  return points;
}

/// The lattice as it is, if that does, or if refining does not help.
Stage solved_stage(Stage first, const PullTask& task, std::span<const glm::dvec3> model,
                   std::span<const glm::dvec3> places, const Progress& progress) {
  solve(task, model, places, progress, first);
  Stage last = first;
  for (int round = 0; round < task.most_refinements; ++round) {
    const std::vector<std::size_t> points = strained(task, last);
    if (points.empty() || last.lattice.as<ThbLattice>()->hierarchy->n_levels() == kMostThbLevels) {
      break;
    }
    last = refined(last, task, model, points);
    solve(task, model, places, progress, last);
  }
  const bool helps = missing(task.points, first, kReached).empty()
                         ? gain_of(last) < gain_of(first)
                         : longest(last.residuals) < (1 - kSamePlace) * longest(first.residuals);
  return helps ? last : first;
}

}  // namespace

PulledPose pulled_pose(const Lattice& lattice, std::shared_ptr<const Volume> volume,
                       std::span<const glm::dvec3> model, PullTask task, const Progress& progress) {
  if (task.most_refinements > 0 && lattice.as<ThbLattice>() == nullptr) {
    throw ParameterError("'refine' needs a thb lattice, this one is of type " +
                         std::string(lattice.type()));
  }
  require_volume(*volume);
  if (task.symmetry) {
    task.points =
        with_images(std::move(task.points), model, *task.symmetry, kSamePlace * volume->diagonal());
  }
  std::vector<glm::dvec3> places;
  for (const PulledPoint& point : task.points) {
    places.push_back(rest_place(point, model, task.symmetry));
  }
  const Stage stage =
      solved_stage({lattice, std::move(volume), task.mobilities}, task, model, places, progress);
  std::vector<glm::dvec3> pose(stage.lattice.posed_points().begin(),
                               stage.lattice.posed_points().end());
  double step = 1;
  if (task.stops_at_fold) {
    const SafeStep safe =
        InjectivityCheck(stage.volume).largest_step(pose, stage.motion, {.most_step = 1});
    step = safe.step < 1 ? safe.step * kShortOfFold : 1;
  }
  for (std::size_t i = 0; i < pose.size(); ++i) {
    pose[i] += step * stage.motion[i];
  }
  const bool has_misses = !missing(task.points, stage, kMiss).empty();
  PulledPose result{stage.lattice.with_pose(std::move(pose)),
                    std::move(task.points),
                    std::move(places),
                    stage.residuals,
                    stage.is_held,
                    step,
                    has_misses,
                    gain_of(stage)};
  for (std::size_t i = 0; i < result.residuals.size(); ++i) {
    const glm::dvec3 done = stage.wanted[i] - result.residuals[i];
    result.residuals[i] = stage.wanted[i] - step * done;
  }
  return result;
}

}  // namespace espalier
