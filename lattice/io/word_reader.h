#pragma once

/// Files read word by word, wherever their lines end.

#include <optional>
#include <string>
#include <string_view>

#include "lattice/core/text_scanner.h"
#include "lattice/io/mesh_cells.h"

namespace espalier {

/// The words of a file. All functions throw FileError naming the line.
class WordReader {
 public:
  WordReader(const std::string& path, std::string_view text, char comment = '\0');

  /// The next word; nothing at the end of the file.
  [[nodiscard]] std::optional<std::string_view> next();
  /// The next word, which must exist; `what` names it in errors.
  [[nodiscard]] std::string_view word(std::string_view what);
  /// Reads a word, which must be this one.
  void expect(std::string_view word);
  [[nodiscard]] std::int64_t integer(std::string_view what);
  /// A number of things, 0 or more. Nothing may be allocated for it: it is only announced.
  [[nodiscard]] std::int64_t count(std::string_view what);
  [[nodiscard]] glm::dvec3 point();
  /// Goes on after the next line, whatever it holds.
  void skip_line();
  /// What is left of the current line.
  [[nodiscard]] std::string_view rest_of_line();
  [[noreturn]] void fail(const std::string& what) const { scanner_.fail(what); }

 private:
  TextScanner scanner_;
  bool has_line_ = false;
};

}  // namespace espalier
