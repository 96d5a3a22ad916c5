/// Locks and tears: where control points are kept still, and where faces part.

#include "deform/scene/lock.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <utility>

#include "deform/evaluate/volume_boundary.h"
#include "lattice/core/error.h"
#include "lattice/core/text_scanner.h"
#include "lattice/subdivision/subdivision_boundary.h"

namespace espalier {
namespace {

/// What an option says.
struct LockOption {
  std::optional<Continuity> continuity;            ///< none: no lock
  std::optional<std::vector<std::int32_t>> faces;  ///< none: those that the model crosses
};

/// Numbers between commas; nothing if one is none.
std::optional<std::vector<std::int32_t>> parse_faces(std::string_view text) {
  std::vector<std::int32_t> faces;
  while (true) {
    const std::size_t comma = std::min(text.find(','), text.size());
    std::int64_t face = -1;
    if (!parse_integer(text.substr(0, comma), face) || !std::in_range<std::int32_t>(face)) {
      return std::nullopt;
    }
    faces.push_back(static_cast<std::int32_t>(face));
    if (comma == text.size()) {
      return faces;
    }
    text.remove_prefix(comma + 1);
  }
}

LockOption parse_lock(const std::string& option) {
  static const std::vector<std::pair<std::string, Continuity>> kWords = {
      {"C0", Continuity::C0}, {"C1", Continuity::C1}, {"C2", Continuity::C2}};
  LockOption result;
  if (option == "none") {
    return result;
  }
  const std::size_t colon = option.find(':');
  for (const auto& [word, continuity] : kWords) {
    if (option.substr(0, colon) == word) {
      result.continuity = continuity;
    }
  }
  if (colon != std::string::npos) {
    result.faces = parse_faces(std::string_view(option).substr(colon + 1));
  }
  if (!result.continuity || (colon != std::string::npos && !result.faces)) {
    throw ParameterError("'lock' is '" + option +
                         "', must be none, C0, C1 or C2, or C0:, C1: or C2: and the numbers of "
                         "boundary faces with commas between");
  }
  return result;
}

void sort_unique(std::vector<std::int32_t>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

std::vector<std::int32_t> crossed_faces(const Crossings& crossings) {
  std::vector<std::int32_t> faces;
  for (const Crossing& crossing : crossings.edges) {
    faces.push_back(crossing.boundary_face);
  }
  return faces;
}

/// By a subdivision lattice's own faces, which locks name; else by the faces of patches.
BoundarySurface boundary_of(const Lattice& lattice, const Volume& volume) {
  const auto* subdivision = lattice.as<SubdivisionLattice>();
  return subdivision != nullptr ? boundary_surface(*subdivision) : boundary_surface(volume);
}

}  // namespace

Scene with_crossings(const Scene& scene, const std::string& model, const std::string& lattice) {
  if (scene.bound.at({model, lattice}).crossings) {
    return scene;
  }
  Scene result = scene;
  BoundModel& bound = result.bound.at({model, lattice});
  const Model& points = model_in(scene, model);
  bound.crossings = std::make_shared<const Crossings>(find_crossings(
      boundary_of(lattice_in(scene, lattice), *bound.volume), bound.volume->rest_controls(),
      points.points(), points.faces(), bound.binding->status));
  return result;
}

Scene with_lock(const Scene& scene, const std::string& model, const std::string& lattice,
                const std::string& option) {
  if (scene.bound.at({model, lattice}).lock.option == option) {
    return scene;
  }
  LockOption parsed = parse_lock(option);
  Lock lock{option, {}, {}};
  Scene result = scene;
  if (parsed.continuity) {
    const SubdivisionLattice& subdivision = subdivision_lattice_in(scene, lattice, "a lock");
    if (!parsed.faces) {
      result = with_crossings(scene, model, lattice);
      parsed.faces = crossed_faces(*result.bound.at({model, lattice}).crossings);
    }
    lock.faces = *std::move(parsed.faces);
    sort_unique(lock.faces);
    try {
      lock.controls = unmoved_controls(subdivision, lock.faces, *parsed.continuity);
    } catch (const ParameterError& error) {
      throw ParameterError("'lock' is '" + option + "': in " + lattice + " " + error.what());
    }
  }
  result.bound.at({model, lattice}).lock = std::move(lock);
  return result;
}

std::vector<glm::dvec3> locked_pose(std::vector<glm::dvec3> pose, std::span<const glm::dvec3> rest,
                                    const Lock& lock) {
  for (const std::int32_t control : lock.controls) {
    pose[static_cast<std::size_t>(control)] = rest[static_cast<std::size_t>(control)];
  }
  return pose;
}

std::vector<std::int32_t> torn_faces(const Crossings& crossings, std::span<const glm::dvec3> rest,
                                     std::span<const glm::dvec3> pose, const Influence& influence,
                                     double tolerance) {
  if (crossings.edges.empty()) {
    return {};
  }
  std::vector<glm::dvec3> moves(pose.begin(), pose.end());
  for (std::size_t i = 0; i < moves.size(); ++i) {
    moves[i] -= rest[i];
  }
  std::vector<std::int32_t> faces;
  const std::vector<glm::dvec3> border_moves = crossings.points.apply(moves);
  for (std::size_t i = 0; i < border_moves.size(); ++i) {
    const Crossing& crossing = crossings.edges[i];
    const double share = influence.at(static_cast<std::size_t>(crossing.held));
    if (glm::length(share * border_moves[i]) > tolerance) {
      faces.push_back(crossing.face);
    }
  }
  sort_unique(faces);
  return faces;
}

}  // namespace espalier
