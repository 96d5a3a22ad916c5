/// Scans OFF text: Geomview manual, "OFF: Object File Format".

#include "deform/model/off.h"

#include <fmt/format.h>

#include <limits>
#include <string_view>
#include <utility>

#include "deform/model/encoded_number.h"
#include "deform/model/pairs.h"
#include "lattice/core/text_scanner.h"

namespace espalier {
namespace {

class OffScanner {
 public:
  OffScanner(std::string_view path, std::string_view bytes)
      : path_(path), bytes_(bytes), scanner_(path, bytes, {.comment = '#'}) {}

  [[nodiscard]] ModelLayout scan() {
    read_keyword();
    const std::int64_t n_points = read_count("the number of points");
    const std::int64_t n_faces = read_count("the number of faces");
    if (n_points == 0) {
      scanner_.fail("has no points");
    }
    for (std::int64_t i = 0; i < n_points; ++i) {
      next_filled_line("points", n_points, i);
      read_point();
    }
    for (std::int64_t i = 0; i < n_faces; ++i) {
      next_filled_line("faces", n_faces, i);
      read_face();
    }
    find_pairs();
    return std::move(layout_);
  }

 private:
  /// Words are handed out across line ends until the points begin.
  std::string_view next_word() {
    for (;;) {
      const std::string_view word = word_.empty() ? scanner_.next_word() : std::exchange(word_, {});
      if (!word.empty() || !scanner_.next_line()) {
        return word;
      }
    }
  }

  void read_keyword() {
    const std::string_view keyword = next_word();
    if (keyword.empty()) {
      throw FileError(path_, "is empty; an OFF file begins with OFF");
    }
    std::string_view rest = keyword;
    const auto take = [&rest](std::string_view prefix) {
      const bool is_there = rest.starts_with(prefix);
      rest.remove_prefix(is_there ? prefix.size() : 0);
      return is_there;
    };
    take("ST");
    take("C");
    has_normals_ = take("N");
    if (rest == "4OFF" || rest == "nOFF" || rest == "4nOFF") {
      scanner_.fail(
          fmt::format("{} has points that are not in space; OFF can be read", quoted(keyword)));
    }
    if (rest != "OFF") {
      scanner_.fail(
          fmt::format("begins with {}, an OFF file with OFF, COFF or NOFF", quoted(keyword)));
    }
    word_ = next_word();
    if (word_ == "BINARY") {
      scanner_.fail("is a binary OFF file; only text can be read");
    }
  }

  std::int64_t read_count(std::string_view what) {
    const std::string_view word = next_word();
    std::int64_t count = 0;
    if (!parse_integer(word, count) || count < 0 ||
        count > std::numeric_limits<std::int32_t>::max()) {
      scanner_.fail(fmt::format("{} is {}, must be a whole number", what,
                                word.empty() ? "missing" : quoted(word)));
    }
    return count;
  }

  void next_filled_line(std::string_view what, std::int64_t n_announced, std::int64_t n_read) {
    do {
      if (!scanner_.next_line()) {
        scanner_.fail(
            fmt::format("ends after {} of the {} {} that it announces", n_read, n_announced, what));
      }
      word_ = scanner_.next_word();
    } while (word_.empty());
  }

  [[nodiscard]] CoordinatePlaces read_coordinates(std::string_view what, glm::dvec3& numbers,
                                                  NumberEncoding& encoding) {
    CoordinatePlaces places;
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view word = word_.empty() ? scanner_.next_word() : std::exchange(word_, {});
      numbers[axis] = scanner_.to_coordinate(word, fmt::format("{} of a {}", "xyz"[axis], what));
      if (word.size() > BytePlace::kLargestLength) {
        scanner_.fail(
            fmt::format("a number has more than {} characters", BytePlace::kLargestLength));
      }
      if (significant_digits(word) > kFloatDigits) {
        encoding = NumberEncoding::DoubleText;
      }
      places.axis[axis] =
          BytePlace(static_cast<std::size_t>(word.data() - bytes_.data()), word.size());
    }
    return places;
  }

  void read_point() {
    glm::dvec3 numbers;
    layout_.point_places.push_back(read_coordinates("point", numbers, layout_.encoding));
    layout_.points.push_back(numbers);
    if (has_normals_) {
      layout_.normal_places.push_back(read_coordinates("normal", numbers, layout_.normal_encoding));
      layout_.normals.push_back(numbers);
    }
  }

  void read_face() {
    std::int64_t n_corners = 0;
    if (!parse_integer(word_, n_corners) || n_corners < 0) {
      scanner_.fail(
          fmt::format("a face begins with {}, must be its number of corners", quoted(word_)));
    }
    face_.clear();
    for (std::int64_t i = 0; i < n_corners; ++i) {
      const std::int64_t point = scanner_.next_integer(fmt::format("corner {} of a face", i));
      if (point < 0 || point >= static_cast<std::int64_t>(layout_.points.size())) {
        scanner_.fail(
            fmt::format("a face names point {}, there are {}", point, layout_.points.size()));
      }
      face_.push_back(static_cast<std::int32_t>(point));
    }
    if (face_.size() >= 3) {
      layout_.faces.push_back(face_);
    }
  }

  void find_pairs() {
    if (has_normals_) {
      pair_points_with_own_normals(layout_);
    }
  }

  std::string path_;
  std::string_view bytes_;
  TextScanner scanner_;
  std::string_view word_;  // of the current line, taken but not used
  bool has_normals_ = false;
  ModelLayout layout_;
  std::vector<std::int32_t> face_;
};

}  // namespace

Model parse_off(std::string path, std::string bytes) {
  ModelLayout layout = OffScanner(path, bytes).scan();
  return {std::move(path), ModelFormat::Off, std::move(bytes), std::move(layout)};
}

}  // namespace espalier
