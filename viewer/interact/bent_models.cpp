#include "viewer/interact/bent_models.h"

#include "deform/evaluate/combine.h"

namespace espalier::viewer {

std::vector<Bend> bends_of(const Session& session, const std::string& model) {
  std::vector<Bend> bends;
  for (const auto& [names, bound] : session.scene().bound) {
    if (session.mode() != Mode::Pose || names.first != model) {
      continue;
    }
    const auto posed = lattice_in(session.scene(), names.second).posed_points();
    bends.push_back({bound.volume, bound.binding,
                     names.second == session.lattice()
                         ? session.shown_points()
                         : std::vector<glm::dvec3>(posed.begin(), posed.end())});
  }
  return bends;
}

std::vector<glm::dvec3> bent_points(std::span<const glm::dvec3> rest, std::span<const Bend> bends) {
  std::vector<LatticeMotion> motions;
  for (const Bend& bend : bends) {
    motions.push_back({bend.volume, bend.binding, bend.volume->displacements(bend.controls)});
  }
  return motions.empty() ? std::vector<glm::dvec3>(rest.begin(), rest.end())
                         : combined_points(rest, motions);
}

}  // namespace espalier::viewer
