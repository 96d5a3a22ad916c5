#pragma once

/// Vectors for points by index, as users write them: "12=0.5,0,-1".

#include <cstddef>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace espalier {

/// A vector for one of many points.
struct IndexedVector {
  std::size_t index = 0;
  glm::dvec3 vector{0};
};

/// What "x,y,z" says; false unless these are three coordinates.
[[nodiscard]] bool parse_vector(std::string_view text, glm::dvec3& vector);

/// What "INDEX=x,y,z" says. Throws ParameterError naming `option` unless it is of that form, the
/// numbers are coordinates and the index is below n, the number of `what`; or if an index occurs
/// twice.
[[nodiscard]] std::vector<IndexedVector> parse_indexed_vectors(
    const std::string& option, const std::vector<std::string>& words, std::size_t n,
    const std::string& what);

}  // namespace espalier
