#include "lattice/build/frames.h"

#include <glm/geometric.hpp>

namespace espalier {

glm::dvec3 carried(const glm::dvec3& vector, const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 axis = glm::cross(from, to);
  const double cosine = glm::dot(from, to);
  return vector * cosine + glm::cross(axis, vector) +
         axis * (glm::dot(axis, vector) / (1 + cosine));
}

glm::dvec3 slid_onto_plane(const glm::dvec3& offset, const glm::dvec3& bone,
                           const glm::dvec3& normal) {
  return offset - bone * (glm::dot(offset, normal) / glm::dot(bone, normal));
}

}  // namespace espalier
