#include "lattice/io/word_reader.h"

#include <string>

namespace espalier {

WordReader::WordReader(const std::string& path, std::string_view text, char comment)
    : scanner_(path, text, {.comment = comment}) {}

std::optional<std::string_view> WordReader::next() {
  while (true) {
    if (has_line_) {
      if (const std::string_view word = scanner_.next_word(); !word.empty()) {
        return word;
      }
    }
    has_line_ = scanner_.next_line();
    if (!has_line_) {
      return std::nullopt;
    }
  }
}

std::string_view WordReader::word(std::string_view what) {
  const auto word = next();
  if (!word) {
    fail("the file ends before " + std::string(what));
  }
  return *word;
}

void WordReader::expect(std::string_view word) {
  if (const std::string_view found = this->word(word); found != word) {
    fail("expected " + std::string(word) + ", not " + quoted(found));
  }
}

std::int64_t WordReader::integer(std::string_view what) {
  const std::string_view text = word(what);
  std::int64_t number = 0;
  if (!parse_integer(text, number)) {
    fail(std::string(what) + " is " + quoted(text) + ", not a whole number");
  }
  return number;
}

std::int64_t WordReader::count(std::string_view what) {
  const std::int64_t n = integer(what);
  if (n < 0) {
    fail(std::string(what) + " is negative: " + std::to_string(n));
  }
  return n;
}

glm::dvec3 WordReader::point() {
  glm::dvec3 point;
  point.x = scanner_.to_coordinate(word("x"), "x");
  point.y = scanner_.to_coordinate(word("y"), "y");
  point.z = scanner_.to_coordinate(word("z"), "z");
  return point;
}

void WordReader::skip_line() {
  (void)scanner_.next_line();
  has_line_ = false;
}

std::string_view WordReader::rest_of_line() {
  std::string_view first;
  std::string_view last;
  for (std::string_view word = scanner_.next_word(); !word.empty(); word = scanner_.next_word()) {
    first = first.empty() ? word : first;
    last = word;
  }
  return first.empty()
             ? first
             : std::string_view(first.data(),
                                static_cast<std::size_t>(last.data() + last.size() - first.data()));
}

}  // namespace espalier
