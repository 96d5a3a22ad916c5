#include "tools/csv_points.h"

#include <algorithm>

#include "lattice/core/error.h"
#include "lattice/core/text_scanner.h"

namespace espalier::tools {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\"";
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) {
    return {};
  }
  return text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

std::vector<std::string_view> fields(std::string_view line) {
  std::vector<std::string_view> result;
  while (true) {
    const std::size_t comma = line.find(',');
    result.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) {
      return result;
    }
    line.remove_prefix(comma + 1);
  }
}

}  // namespace

std::vector<glm::dvec3> parse_csv_points(const std::string& path, std::string_view text,
                                         const std::array<std::string_view, 3>& columns) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) {
    text.remove_prefix(kByteOrderMark.size());
  }
  TextScanner scanner(path, text);
  if (!scanner.next_line()) {
    throw FileError(path, "is empty, needs a first line that names the columns");
  }
  const std::vector<std::string_view> header = fields(scanner.line());
  std::array<std::size_t, 3> place{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto found = std::find(header.begin(), header.end(), columns[i]);
    if (found == header.end()) {
      scanner.fail("the first line must name the columns " + std::string(columns[0]) + "," +
                   std::string(columns[1]) + "," + std::string(columns[2]));
    }
    place[i] = static_cast<std::size_t>(found - header.begin());
  }
  std::vector<glm::dvec3> points;
  while (scanner.next_line()) {
    const std::vector<std::string_view> values = fields(scanner.line());
    if (values.size() == 1 && values[0].empty()) {
      continue;
    }
    glm::dvec3 point;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<int>(i);
      if (place[i] >= values.size() || values[place[i]].empty()) {
        scanner.fail("column " + std::string(columns[i]) + " is missing");
      }
      point[axis] = scanner.to_coordinate(values[place[i]], columns[i]);
    }
    points.push_back(point);
  }
  return points;
}

}  // namespace espalier::tools
