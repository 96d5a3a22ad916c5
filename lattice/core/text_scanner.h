#pragma once

/// Lines and words of a text file, with errors that name file and line.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "lattice/core/error.h"

namespace espalier {

/// No coordinate beyond this is accepted: its square must fit a float for drawing and its
/// products a double, and real models end 20 powers of ten earlier.
inline constexpr double kLargestCoordinate = 1e18;

/// What a format makes of a line beyond its words.
struct TextSyntax {
  /// Starts a comment that lasts to the end of the line; '\0': there are no comments.
  char comment = '\0';
  /// A backslash at the very end of a line joins the next one to it, except in a comment.
  bool joins_lines = false;
};

/// Reads `text` line by line and word by word. Lines end in LF, CR LF or CR. The scanner keeps
/// views into `text`, which must outlive it; every word's place is `word.data() - text.data()`.
class TextScanner {
 public:
  /// path: named in errors.
  TextScanner(std::string_view path, std::string_view text, TextSyntax syntax = {})
      : path_(path), syntax_(syntax), rest_(text) {}

  /// Moves to the next line, skipping what is left of this one; false at the end of the text.
  bool next_line();
  /// The whole current line, without its end; joined lines count as one.
  [[nodiscard]] std::string_view line() const { return line_; }
  /// Counted from 1; within joined lines, the line that the last word came from.
  [[nodiscard]] std::size_t line_number() const;
  /// Bytes not yet handed out as words: an upper bound of what a file can still hold.
  [[nodiscard]] std::size_t bytes_left() const {
    return static_cast<std::size_t>(rest_.data() + rest_.size() - place());
  }

  /// The next word of the current line, empty if there is none.
  [[nodiscard]] std::string_view next_word();
  /// As next_word, but a comment starts only before a word: "part#1" is one name.
  [[nodiscard]] std::string_view next_name();
  /// The next word of the current line as a number; `what` names it in errors ("x coordinate").
  [[nodiscard]] double next_number(std::string_view what);
  /// As next_number, but finite and within kLargestCoordinate.
  [[nodiscard]] double next_coordinate(std::string_view what);
  /// As next_coordinate, of a word already taken.
  [[nodiscard]] double to_coordinate(std::string_view word, std::string_view what) const;
  [[nodiscard]] std::int64_t next_integer(std::string_view what);
  /// The next n bytes from where the current line's words begin, across line ends: n at most
  /// bytes_left().
  [[nodiscard]] std::string_view next_bytes(std::size_t n);
  /// Throws if the current line has words left.
  void expect_end_of_line(std::string_view after);

  /// Throws FileError at the current line.
  [[noreturn]] void fail(std::string_view what) const;

 private:
  [[nodiscard]] double to_number(std::string_view word, std::string_view what) const;
  [[nodiscard]] std::string_view take_word(bool comment_ends_word);
  [[nodiscard]] bool ends_word(std::size_t at) const;
  /// Where the next word is looked for.
  [[nodiscard]] const char* place() const {
    return words_.data() != nullptr ? words_.data() : rest_.data();
  }

  std::string path_;
  TextSyntax syntax_;
  std::string_view rest_;
  std::string_view line_;
  std::string_view words_;
  std::size_t line_number_ = 0;
  std::size_t n_joined_ = 0;  // line ends inside line_
};

/// The number that is the whole of `word` (also "+1"); false if it is none. "nan" and "inf" parse.
[[nodiscard]] bool parse_number(std::string_view word, double& number);
[[nodiscard]] bool parse_integer(std::string_view word, std::int64_t& number);

/// A word as an error shows it: quoted, cut to a length that fits a line, unprintables replaced.
[[nodiscard]] std::string quoted(std::string_view word);

}  // namespace espalier
