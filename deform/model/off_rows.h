#pragma once

/// Where the rows of an OFF file stand.

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "deform/model/model.h"

namespace espalier {

/// From the first coordinate of a point to the last word of its line: normal, colour, texture.
struct OffPointRow {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// From the number of a face's corners to the last of them, and the words after that: its colour.
struct OffFaceRow {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::string rest;  ///< " 0.5 0 1"
};

struct OffRows {
  std::string_view keyword;                ///< views into the model's bytes
  std::array<std::string_view, 3> counts;  ///< of points, faces and edges; the last may be missing
  std::vector<OffPointRow> points;         ///< #points
  std::vector<OffFaceRow> faces;           ///< #faces of the model
  std::size_t end_of_points = 0;           ///< end of the last point's line
};

/// model: of an OFF file.
[[nodiscard]] OffRows off_rows(const Model& model);

}  // namespace espalier
