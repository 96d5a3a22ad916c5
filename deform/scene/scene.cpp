#include "deform/scene/scene.h"

#include <cmath>

#include "lattice/core/error.h"
#include "lattice/core/text_scanner.h"

namespace espalier {
namespace {

template <class Map>
const auto& find(const Map& map, const std::string& name, const char* what) {
  const auto found = map.find(name);
  if (found == map.end()) {
    throw ParameterError(std::string("the scene has no ") + what + " named '" + name + "'");
  }
  return found->second;
}

bool is_coordinate(double x) {
  return std::abs(x) <= kLargestCoordinate;  // false for what is not a number
}

}  // namespace

const Model& model_in(const Scene& scene, const std::string& name) {
  return find(scene.models, name, "model");
}

const Lattice& lattice_in(const Scene& scene, const std::string& name) {
  return find(scene.lattices, name, "lattice");
}

const SubdivisionLattice& subdivision_lattice_in(const Scene& scene, const std::string& name,
                                                 std::string_view what) {
  const Lattice& lattice = lattice_in(scene, name);
  const auto* subdivision = lattice.as<SubdivisionLattice>();
  if (subdivision == nullptr) {
    throw ParameterError(name + " is a " + std::string(lattice.type()) + " lattice; " +
                         std::string(what) + " needs a subdivision lattice");
  }
  return *subdivision;
}

const Pose& pose_in(const Scene& scene, const std::string& name) {
  return *find(scene.poses, name, "pose");
}

Scene with_model(Scene scene, const std::string& name, Model model) {
  std::erase_if(scene.bound, [&](const auto& entry) { return entry.first.first == name; });
  scene.torn_faces.erase(name);
  scene.influences.erase(name);
  scene.models.insert_or_assign(name, std::move(model));
  return scene;
}

Scene with_lattice(Scene scene, const std::string& name, Lattice lattice) {
  std::erase_if(scene.bound, [&](const auto& entry) { return entry.first.second == name; });
  scene.conversions.erase(name);
  scene.lattices.insert_or_assign(name, std::move(lattice));
  return scene;
}

Scene with_pose(Scene scene, const std::string& lattice, std::vector<glm::dvec3> pose) {
  const Lattice& found = lattice_in(scene, lattice);
  const std::size_t n_controls = found.rest_points().size();
  if (!pose.empty() && pose.size() != n_controls) {
    throw ParameterError("a pose of " + std::to_string(pose.size()) + " points for " + lattice +
                         ", which has " + std::to_string(n_controls));
  }
  for (std::size_t i = 0; i < pose.size(); ++i) {
    if (!is_coordinate(pose[i].x) || !is_coordinate(pose[i].y) || !is_coordinate(pose[i].z)) {
      throw ParameterError("point " + std::to_string(i) + " of " + lattice +
                           " would be too far away, or nowhere");
    }
  }
  scene.lattices.insert_or_assign(lattice, found.with_pose(std::move(pose)));
  return scene;
}

}  // namespace espalier
