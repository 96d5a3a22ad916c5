/// Geomview manual, "OFF: Object File Format".

#include "deform/model/off_rows.h"

#include <cstdint>
#include <utility>

#include "lattice/core/text_scanner.h"

namespace espalier {
namespace {

/// Of a file that parse_off() took.
class RowScanner {
 public:
  explicit RowScanner(const Model& model)
      : model_(model), scanner_(model.path(), model.bytes(), {.comment = '#'}) {}

  [[nodiscard]] OffRows scan() {
    rows_.keyword = next_filled_line();
    // Points and faces come after the keyword, on any line; edges on the same as faces, or not.
    for (std::string_view& count : rows_.counts) {
      const std::string_view word = scanner_.next_word();
      count = word.empty() && &count != &rows_.counts.back() ? next_filled_line() : word;
    }
    while (rows_.points.size() < model_.points().size()) {
      read_point(next_filled_line());
    }
    const std::string_view last = scanner_.line();
    rows_.end_of_points = place(last) + last.size();
    while (rows_.faces.size() < model_.faces().n_rows()) {
      read_face(next_filled_line());
    }
    return std::move(rows_);
  }

 private:
  [[nodiscard]] std::size_t place(std::string_view word) const {
    return static_cast<std::size_t>(word.data() - model_.bytes().data());
  }

  /// The first word of the next line that has one.
  std::string_view next_filled_line() {
    std::string_view word;
    while (word.empty() && scanner_.next_line()) {
      word = scanner_.next_word();
    }
    return word;
  }

  void read_point(std::string_view word) {
    OffPointRow row{place(word)};
    for (; !word.empty(); word = scanner_.next_word()) {
      row.end = place(word) + word.size();
    }
    rows_.points.push_back(row);
  }

  /// One of less than three corners is none to the model.
  void read_face(std::string_view word) {
    OffFaceRow row{place(word), place(word) + word.size(), ""};
    std::int64_t n_corners = 0;
    if (!parse_integer(word, n_corners) || n_corners < 3) {
      return;
    }
    for (std::int64_t i = 0; i < n_corners; ++i) {
      const std::string_view corner = scanner_.next_word();
      row.end = place(corner) + corner.size();
    }
    for (word = scanner_.next_word(); !word.empty(); word = scanner_.next_word()) {
      row.rest += ' ';
      row.rest += word;
    }
    rows_.faces.push_back(std::move(row));
  }

  const Model& model_;
  TextScanner scanner_;
  OffRows rows_;
};

}  // namespace

OffRows off_rows(const Model& model) {
  return RowScanner(model).scan();
}

}  // namespace espalier
