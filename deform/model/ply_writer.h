#pragma once

/// Numbers as a PLY file has them.

#include <string>
#include <string_view>

#include "deform/model/ply_header.h"

namespace espalier {

/// The least and the greatest number of a type; of floating ones, of whole numbers that they tell
/// apart.
[[nodiscard]] double least_of(PlyType type);
[[nodiscard]] double greatest_of(PlyType type);

/// Rows of a PLY file's body.
class PlyWriter {
 public:
  /// line_end: of a text.
  PlyWriter(PlyEncoding encoding, std::string_view line_end)
      : encoding_(encoding), line_end_(line_end) {}

  /// Rounds to what the type holds.
  void write(PlyType type, double number);
  /// What stands in the file already: numbers, and in a text the space between them.
  void write(std::string_view bytes);
  void end_line();

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  PlyEncoding encoding_;
  std::string line_end_;
  std::string text_;
  bool is_in_line_ = false;
};

}  // namespace espalier
