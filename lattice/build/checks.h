#pragma once

/// Parameters of ready-made lattices, checked.

#include <glm/vec3.hpp>
#include <string>

namespace espalier {

/// Throw ParameterError "NAME: WHAT …" unless a point is finite, an axis's ends are and differ, a
/// size is positive and finite, a count is in a range.
void check_point(const std::string& name, const std::string& what, const glm::dvec3& point);
void check_axis(const std::string& name, const glm::dvec3& from, const glm::dvec3& to);
void check_size(const std::string& name, const std::string& what, double size);
void check_count(const std::string& name, const std::string& what, int count, int least, int most);

}  // namespace espalier
