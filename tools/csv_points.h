#pragma once

/// Points from comma-separated values.

#include <array>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::tools {

/// The three named columns of a table with a header line; other columns are left alone, empty lines
/// skipped. path: named in errors. Throws FileError naming the line.
[[nodiscard]] std::vector<glm::dvec3> parse_csv_points(
    const std::string& path, std::string_view text, const std::array<std::string_view, 3>& columns);

}  // namespace espalier::tools
