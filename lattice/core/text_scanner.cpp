#include "lattice/core/text_scanner.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <limits>

namespace espalier {
namespace {

constexpr std::size_t kLongestQuoted = 40;

bool is_line_end(char c) {
  return c == '\n' || c == '\r';
}

/// Line ends too: they occur inside joined lines.
bool is_blank(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

/// The first line end at or after `begin`, or the end of the text.
std::size_t find_line_end(std::string_view text, std::size_t begin) {
  while (begin < text.size() && !is_line_end(text[begin])) {
    ++begin;
  }
  return begin;
}

/// Bytes of the line end at `at`: CR LF is one line end.
std::size_t line_end_length(std::string_view text, std::size_t at) {
  if (at >= text.size()) {
    return 0;
  }
  return text[at] == '\r' && at + 1 < text.size() && text[at + 1] == '\n' ? 2 : 1;
}

std::string_view without_plus(std::string_view word) {
  return word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+' ? word.substr(1)
                                                                               : word;
}

}  // namespace

bool parse_number(std::string_view word, double& number) {
  word = without_plus(word);
  const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (status == std::errc::result_out_of_range && end == word.data() + word.size()) {
    // from_chars leaves the number alone: a vanishing one counts as zero, a huge one as infinite.
    const std::size_t exponent = word.find_first_of("eE");
    const bool is_tiny = exponent != std::string_view::npos && exponent + 1 < word.size() &&
                         word[exponent + 1] == '-';
    number = is_tiny ? 0.0 : std::numeric_limits<double>::infinity();
    return true;
  }
  return status == std::errc() && end == word.data() + word.size();
}

bool parse_integer(std::string_view word, std::int64_t& number) {
  word = without_plus(word);
  const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), number);
  return status == std::errc() && end == word.data() + word.size();
}

std::string quoted(std::string_view word) {
  std::string shown = "'";
  for (const char c : word.substr(0, kLongestQuoted)) {
    shown += c >= ' ' && c <= '~' ? c : '?';
  }
  return shown + (word.size() > kLongestQuoted ? "…'" : "'");
}

bool TextScanner::next_line() {
  line_number_ += n_joined_;
  n_joined_ = 0;
  if (rest_.empty()) {
    line_ = words_ = rest_;
    return false;
  }
  const auto is_joined = [this](std::size_t begin, std::size_t end) {
    return end > begin && end < rest_.size() && rest_[end - 1] == '\\' &&
           (syntax_.comment == '\0' ||
            rest_.substr(begin, end - begin).find(syntax_.comment) == std::string_view::npos);
  };
  std::size_t begin = 0;
  std::size_t end = find_line_end(rest_, 0);
  while (syntax_.joins_lines && is_joined(begin, end)) {
    begin = end + line_end_length(rest_, end);
    end = find_line_end(rest_, begin);
    ++n_joined_;
  }
  line_ = words_ = rest_.substr(0, end);
  rest_.remove_prefix(end + line_end_length(rest_, end));
  ++line_number_;
  return true;
}

std::size_t TextScanner::line_number() const {
  if (n_joined_ == 0) {
    return line_number_;
  }
  const auto n_read = static_cast<std::size_t>(words_.data() - line_.data());
  std::size_t n_lines = 0;
  for (std::size_t at = find_line_end(line_, 0); at < n_read;
       at = find_line_end(line_, at + line_end_length(line_, at))) {
    ++n_lines;
  }
  return line_number_ + n_lines;
}

bool TextScanner::ends_word(std::size_t at) const {
  const char c = words_[at];
  return is_blank(c) || (c == '\\' && syntax_.joins_lines &&
                         (at + 1 == words_.size() || is_line_end(words_[at + 1])));
}

std::string_view TextScanner::take_word(bool comment_ends_word) {
  std::size_t begin = 0;
  while (begin < words_.size() && ends_word(begin)) {
    ++begin;
  }
  const char comment = syntax_.comment;
  if (begin < words_.size() && comment != '\0' && words_[begin] == comment) {
    words_.remove_prefix(words_.size());
    return {};
  }
  std::size_t end = begin;
  while (end < words_.size() && !ends_word(end) &&
         !(comment_ends_word && comment != '\0' && words_[end] == comment)) {
    ++end;
  }
  const std::string_view word = words_.substr(begin, end - begin);
  words_.remove_prefix(end);
  return word;
}

std::string_view TextScanner::next_word() {
  return take_word(true);
}

std::string_view TextScanner::next_name() {
  return take_word(false);
}

double TextScanner::to_number(std::string_view word, std::string_view what) const {
  if (word.empty()) {
    fail(std::string(what) + " is missing");
  }
  double number = 0;
  if (!parse_number(word, number)) {
    fail(std::string(what) + " is " + quoted(word) + ", not a number");
  }
  return number;
}

double TextScanner::next_number(std::string_view what) {
  return to_number(next_word(), what);
}

double TextScanner::to_coordinate(std::string_view word, std::string_view what) const {
  const double number = to_number(word, what);
  if (!std::isfinite(number)) {
    fail(std::string(what) + " is not finite");
  }
  if (std::abs(number) > kLargestCoordinate) {
    fail(std::string(what) + " is beyond the largest coordinate, 1e18");
  }
  return number;
}

double TextScanner::next_coordinate(std::string_view what) {
  return to_coordinate(next_word(), what);
}

std::int64_t TextScanner::next_integer(std::string_view what) {
  const std::string_view word = next_word();
  if (word.empty()) {
    fail(std::string(what) + " is missing");
  }
  std::int64_t number = 0;
  if (!parse_integer(word, number)) {
    fail(std::string(what) + " is " + quoted(word) + ", not a whole number");
  }
  return number;
}

std::string_view TextScanner::next_bytes(std::size_t n) {
  assert(n <= bytes_left());
  if (n <= words_.size()) {
    const std::string_view bytes = words_.substr(0, n);
    words_.remove_prefix(n);
    return bytes;
  }
  const std::string_view bytes(place(), n);
  rest_ = {bytes.data() + n, bytes_left() - n};
  const auto n_line_ends = std::count(bytes.begin(), bytes.end(), '\n');
  const std::size_t last_line = line_number_ + static_cast<std::size_t>(n_line_ends);
  next_line();  // what follows on the last of these lines
  line_number_ = last_line;
  return bytes;
}

void TextScanner::expect_end_of_line(std::string_view after) {
  const std::string_view word = next_word();
  if (!word.empty()) {
    fail("unexpected " + quoted(word) + " after " + std::string(after));
  }
}

void TextScanner::fail(std::string_view what) const {
  throw FileError(path_, line_number(), what);
}

}  // namespace espalier
