#include "viewer/interact/bent_models.h"

#include "deform/evaluate/combine.h"

namespace espalier::viewer {

std::vector<glm::dvec3> shown_points(const Session& session, const std::string& model) {
  const auto rest = model_in(session.scene(), model).points();
  std::vector<LatticeMotion> motions;
  for (const auto& [names, bound] : session.scene().bound) {
    if (session.mode() != Mode::Pose || names.first != model) {
      continue;
    }
    const bool is_chosen = names.second == session.lattice();
    const auto posed = lattice_in(session.scene(), names.second).posed_points();
    motions.push_back({bound.volume, bound.binding,
                       bound.volume->displacements(
                           is_chosen ? session.shown_points()
                                     : std::vector<glm::dvec3>(posed.begin(), posed.end()))});
  }
  return motions.empty() ? std::vector<glm::dvec3>(rest.begin(), rest.end())
                         : combined_points(rest, motions);
}

}  // namespace espalier::viewer
