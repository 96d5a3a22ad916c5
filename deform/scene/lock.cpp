/// Locks and tears: where control points are kept still, and where faces part.

#include "deform/scene/lock.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <utility>

#include "deform/evaluate/volume_boundary.h"
#include "deform/scene/index_list.h"
#include "lattice/core/error.h"
#include "lattice/core/text_scanner.h"
#include "lattice/subdivision/subdivision_boundary.h"

namespace espalier {
namespace {

/// What an option says.
struct LockOption {
  std::optional<Continuity> continuity;  ///< none: no lock
  bool names_faces = false;              ///< else those that the model crosses
  std::vector<std::int32_t> faces = {};  ///< by number
  std::vector<int> sides = {};           ///< by name, of 6
};

/// Numbers or sides between commas; false if one is neither.
bool parse_faces(const std::string& text, LockOption& option) {
  static constexpr std::array<std::string_view, 6> kSides = {"u0", "u1", "v0", "v1", "w0", "w1"};
  for (const std::string& word : words_between(text, ',')) {
    const auto side = std::find(kSides.begin(), kSides.end(), word);
    std::int64_t face = -1;
    if (side != kSides.end()) {
      option.sides.push_back(static_cast<int>(side - kSides.begin()));
    } else if (parse_integer(word, face) && std::in_range<std::int32_t>(face)) {
      option.faces.push_back(static_cast<std::int32_t>(face));
    } else {
      return false;
    }
  }
  return true;
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
  result.names_faces = colon != std::string::npos;
  const bool are_faces = !result.names_faces || parse_faces(option.substr(colon + 1), result);
  if (!result.continuity || !are_faces) {
    throw ParameterError("'lock' is '" + option +
                         "', must be none, C0, C1 or C2, or C0:, C1: or C2: and the numbers of "
                         "boundary faces with commas between, or sides of a grid, u0 to w1");
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

/// All faces of a side of a grid, as boundary_surface() numbers them.
void add_side(const Volume& volume, int side, std::vector<std::int32_t>& faces) {
  const std::size_t n_before = faces.size();
  for (std::size_t i = 0; i < volume.n_patches(); ++i) {
    if (volume.patch(i).is_on_boundary(side)) {
      faces.push_back(static_cast<std::int32_t>(6 * i) + side);
    }
  }
  if (faces.size() == n_before) {
    throw ParameterError(std::string("side ") + "uvw"[side / 2] + (side % 2 == 0 ? "0" : "1") +
                         " does not exist: the lattice is closed to a ring there");
  }
}

/// The control points that hold faces still: those of a subdivision lattice by its own rules, else
/// by the patches.
std::vector<std::int32_t> controls_to_lock(const Lattice& lattice, const Volume& volume,
                                           Continuity continuity, const Lock& lock) {
  const auto* subdivision = lattice.as<SubdivisionLattice>();
  return subdivision != nullptr ? unmoved_controls(*subdivision, lock.faces, continuity)
                                : unmoved_controls(volume, lock.faces, continuity);
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
  const LockOption parsed = parse_lock(option);
  Lock lock{option, parsed.faces, {}};
  Scene result = scene;
  if (parsed.continuity) {
    const Lattice& at_rest = lattice_in(scene, lattice);
    const std::shared_ptr<const Volume> volume = scene.bound.at({model, lattice}).volume;
    if (!parsed.names_faces) {
      result = with_crossings(scene, model, lattice);
      lock.faces = crossed_faces(*result.bound.at({model, lattice}).crossings);
    }
    try {
      if (!parsed.sides.empty() && at_rest.as<SubdivisionLattice>() != nullptr) {
        throw ParameterError("cells have no sides with names: give the numbers of faces");
      }
      for (const int side : parsed.sides) {
        add_side(*volume, side, lock.faces);
      }
      sort_unique(lock.faces);
      lock.controls = controls_to_lock(at_rest, *volume, *parsed.continuity, lock);
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

std::span<const double> rest_weights(const Lattice& lattice) {
  const auto* tensor = lattice.as<TensorLattice>();
  return tensor == nullptr ? std::span<const double>() : std::span<const double>(tensor->weights);
}

std::vector<double> locked_weights(std::vector<double> weights, std::span<const double> rest,
                                   const Lock& lock) {
  for (const std::int32_t control : lock.controls) {
    if (!weights.empty()) {
      weights[static_cast<std::size_t>(control)] = rest[static_cast<std::size_t>(control)];
    }
  }
  return weights;
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
