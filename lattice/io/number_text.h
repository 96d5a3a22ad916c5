#pragma once

/// Numbers as text that reads back to the same bits.

#include <charconv>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>

namespace espalier {

/// Appends the shortest decimal that reads back as `number`, which is finite; -0 keeps its sign in
/// readers that take "-0" for an integer.
template <class Number>
void append_number(std::string& text, Number number) {
  char digits[400];
  const auto [end, status] = std::to_chars(digits, digits + sizeof digits, number);
  const std::string_view shown(digits, static_cast<std::size_t>(end - digits));
  text += shown == "-0" ? "-0.0" : shown;
}

/// Appends x, y and z with `separator` between.
inline void append_point(std::string& text, const glm::dvec3& point, char separator) {
  append_number(text, point.x);
  text += separator;
  append_number(text, point.y);
  text += separator;
  append_number(text, point.z);
}

}  // namespace espalier
