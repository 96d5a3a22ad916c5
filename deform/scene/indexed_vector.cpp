#include "deform/scene/indexed_vector.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

#include "lattice/core/error.h"
#include "lattice/core/text_scanner.h"

namespace espalier {
namespace {

/// The text up to a separator, which is taken off too.
std::string_view next_part(std::string_view& rest, char separator) {
  const std::size_t at = rest.find(separator);
  const std::string_view part = rest.substr(0, at);
  rest = at == std::string_view::npos ? std::string_view() : rest.substr(at + 1);
  return part;
}

}  // namespace

bool parse_vector(std::string_view text, glm::dvec3& vector) {
  if (std::count(text.begin(), text.end(), ',') != 2) {
    return false;
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (!parse_number(next_part(text, ','), vector[axis]) ||
        !(std::abs(vector[axis]) <= kLargestCoordinate)) {
      return false;
    }
  }
  return true;
}

std::vector<IndexedVector> parse_indexed_vectors(const std::string& option,
                                                 const std::vector<std::string>& words,
                                                 std::size_t n, const std::string& what) {
  std::vector<IndexedVector> result;
  std::set<std::size_t> seen;
  for (const std::string& word : words) {
    std::string_view rest = word;
    const std::string_view index_text = next_part(rest, '=');
    std::int64_t index = 0;
    glm::dvec3 vector(0);
    if (!parse_integer(index_text, index) || !parse_vector(rest, vector)) {
      throw ParameterError("'" + option + "' is '" + word +
                           "', must be INDEX=x,y,z with three finite numbers");
    }
    if (index < 0 || static_cast<std::size_t>(index) >= n) {
      throw ParameterError("'" + option + "' names point " + std::to_string(index) + " of " +
                           std::to_string(n) + " " + what + ", counted from 0");
    }
    if (!seen.insert(static_cast<std::size_t>(index)).second) {
      throw ParameterError("'" + option + "' names point " + std::to_string(index) +
                           " twice: give one vector for each");
    }
    result.push_back({static_cast<std::size_t>(index), vector});
  }
  return result;
}

}  // namespace espalier
