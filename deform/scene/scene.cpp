#include "deform/scene/scene.h"

#include "lattice/core/error.h"

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
  scene.models.insert_or_assign(name, std::move(model));
  return scene;
}

Scene with_lattice(Scene scene, const std::string& name, Lattice lattice) {
  std::erase_if(scene.bound, [&](const auto& entry) { return entry.first.second == name; });
  scene.lattices.insert_or_assign(name, std::move(lattice));
  return scene;
}

}  // namespace espalier
