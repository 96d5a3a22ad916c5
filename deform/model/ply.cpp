/// G. Turk, "The PLY polygon file format", 1994.

#include "deform/model/ply.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "deform/model/encoded_number.h"
#include "deform/model/pairs.h"
#include "deform/model/ply_header.h"

namespace espalier {
namespace {

/// A number of the body and where it stands.
struct PlacedNumber {
  double value = 0;
  BytePlace place;
};

/// What stands in a body, one number after the other.
class PlyBody {
 public:
  /// scanner: at the end of the header.
  PlyBody(std::string_view path, std::string_view bytes, TextScanner scanner, PlyEncoding encoding)
      : path_(path), bytes_(bytes), scanner_(std::move(scanner)), encoding_(encoding) {
    const std::string_view last = scanner_.line();
    at_ = static_cast<std::size_t>(last.data() + last.size() - bytes.data());
    at_ += bytes.substr(at_).starts_with("\r\n") ? 2 : 1;
  }

  /// To be called before the numbers of element `index` of a kind.
  void begin_element(const PlyElement& element, std::int64_t index) {
    element_ = &element;
    index_ = index;
    if (encoding_ != PlyEncoding::Text) {
      return;
    }
    do {
      if (!scanner_.next_line()) {
        fail_at_end();
      }
      ahead_ = scanner_.next_word();
    } while (ahead_.empty());
  }

  [[nodiscard]] PlacedNumber next(PlyType type, std::string_view what) {
    return encoding_ == PlyEncoding::Text ? next_word(what) : next_bytes(type);
  }

  /// Of a coordinate of this type.
  [[nodiscard]] NumberEncoding encoding_of(PlyType type) const {
    const bool is_float = type == PlyType::Float;
    switch (encoding_) {
      case PlyEncoding::Text:
        return is_float ? NumberEncoding::FloatText : NumberEncoding::DoubleText;
      case PlyEncoding::Little:
        return is_float ? NumberEncoding::LittleFloat : NumberEncoding::LittleDouble;
      default:
        return is_float ? NumberEncoding::BigFloat : NumberEncoding::BigDouble;
    }
  }

  [[noreturn]] void fail(std::string_view what) const {
    const std::string message = fmt::format("{} {}: {}", element_->name, index_, what);
    if (encoding_ == PlyEncoding::Text) {
      scanner_.fail(message);
    }
    throw FileError(path_, message);
  }

 private:
  [[noreturn]] void fail_at_end() const {
    throw FileError(path_, fmt::format("ends in element {} of the {} '{}' that it announces",
                                       index_, element_->count, element_->name));
  }

  PlacedNumber next_word(std::string_view what) {
    const std::string_view word = ahead_.empty() ? scanner_.next_word() : std::exchange(ahead_, {});
    PlacedNumber number;
    if (word.empty()) {
      fail(fmt::format("{} is missing", what));
    }
    if (!parse_number(word, number.value)) {
      fail(fmt::format("{} is {}, not a number", what, quoted(word)));
    }
    if (word.size() > BytePlace::kLargestLength) {
      fail(fmt::format("{} has more than {} characters", what, BytePlace::kLargestLength));
    }
    number.place = BytePlace(static_cast<std::size_t>(word.data() - bytes_.data()), word.size());
    return number;
  }

  PlacedNumber next_bytes(PlyType type) {
    const std::size_t size = size_of(type);
    if (at_ > bytes_.size() || bytes_.size() - at_ < size) {
      fail_at_end();
    }
    PlacedNumber number;
    number.place = BytePlace(at_, size);
    const std::string_view bytes = bytes_.substr(at_, size);
    at_ += size;
    if (type == PlyType::Float || type == PlyType::Double) {
      number.value = decoded(bytes, encoding_of(type));
      return number;
    }
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t from = encoding_ == PlyEncoding::Little ? size - 1 - i : i;
      bits = bits << 8 | static_cast<unsigned char>(bytes[from]);
    }
    const bool is_signed =
        type == PlyType::Int8 || type == PlyType::Int16 || type == PlyType::Int32;
    const double range = std::ldexp(1.0, static_cast<int>(8 * size));
    number.value = is_signed && bits >= range / 2 ? bits - range : bits;
    return number;
  }

  std::string path_;
  std::string_view bytes_;
  TextScanner scanner_;
  PlyEncoding encoding_;
  std::size_t at_ = 0;      // in a binary body
  std::string_view ahead_;  // a word of a text body, taken but not used
  const PlyElement* element_ = nullptr;
  std::int64_t index_ = 0;
};

class PlyScanner {
 public:
  PlyScanner(std::string_view path, std::string_view bytes)
      : path_(path),
        scanner_(path, bytes),
        header_(read_ply_header(scanner_)),
        body_(path, bytes, scanner_, header_.encoding) {}

  [[nodiscard]] ModelLayout scan() {
    require_points();
    for (const PlyElement& element : header_.elements) {
      for (std::int64_t i = 0; i < element.count && !element.properties.empty(); ++i) {
        body_.begin_element(element, i);
        if (element.name == "vertex") {
          read_vertex(element);
        } else {
          read_other(element);
        }
      }
    }
    check_corners();
    if (has_normals_) {
      pair_points_with_own_normals(layout_);
    }
    return std::move(layout_);
  }

 private:
  static constexpr std::array<std::string_view, 6> kCoordinates = {"x", "y", "z", "nx", "ny", "nz"};

  /// Which of kCoordinates a property is; -1 none.
  [[nodiscard]] static int coordinate_of(const PlyProperty& property) {
    for (std::size_t i = 0; i < kCoordinates.size(); ++i) {
      if (property.name == kCoordinates[i] && !property.count_type) {
        return static_cast<int>(i);
      }
    }
    return -1;
  }

  void require_points() {
    unsigned found = 0;
    std::int64_t n_points = 0;
    for (const PlyElement& element : header_.elements) {
      if (element.name != "vertex") {
        continue;
      }
      if (n_points > 0) {
        throw FileError(path_, "has two elements 'vertex'");
      }
      n_points = element.count;
      for (const PlyProperty& property : element.properties) {
        const int i = coordinate_of(property);
        if (i >= 0 && i < 3) {
          require_floating(property, layout_.encoding);
        } else if (i >= 3) {
          require_floating(property, layout_.normal_encoding);
        }
        found |= i >= 0 ? 1u << i : 0u;
      }
    }
    if (n_points == 0 || (found & 7) != 7) {
      throw FileError(path_, "has no points: a PLY model needs elements 'vertex' with x, y and z");
    }
    has_normals_ = (found >> 3) == 7;
  }

  /// A text of floats and doubles counts as one of doubles.
  void require_floating(const PlyProperty& property, NumberEncoding& encoding) {
    if (property.type != PlyType::Float && property.type != PlyType::Double) {
      throw FileError(path_, fmt::format("{} of the points must be float or double, or a moved "
                                         "point could not be written",
                                         property.name));
    }
    const NumberEncoding own = body_.encoding_of(property.type);
    encoding = encoding == NumberEncoding::DoubleText ? encoding : own;
  }

  void read_vertex(const PlyElement& element) {
    std::array<PlacedNumber, 6> numbers;
    for (const PlyProperty& property : element.properties) {
      if (property.count_type) {
        skip_list(property);
        continue;
      }
      const PlacedNumber number = body_.next(property.type, property.name);
      if (const int i = coordinate_of(property); i >= 0) {
        numbers[static_cast<std::size_t>(i)] = number;
        if (i < 3 && !(std::abs(number.value) <= kLargestCoordinate)) {
          body_.fail(
              fmt::format("{} is {}, must be a number up to 1e18", property.name, number.value));
        }
      }
    }
    add(numbers, 0, layout_.points, layout_.point_places);
    if (has_normals_) {
      add(numbers, 3, layout_.normals, layout_.normal_places);
      if (const glm::dvec3& normal = layout_.normals.back();
          !std::isfinite(normal.x + normal.y + normal.z)) {
        layout_.normals.back() = glm::dvec3(0);
      }
    }
  }

  static void add(const std::array<PlacedNumber, 6>& numbers, std::size_t first,
                  std::vector<glm::dvec3>& values, std::vector<CoordinatePlaces>& places) {
    CoordinatePlaces place;
    glm::dvec3 value;
    for (int axis = 0; axis < 3; ++axis) {
      const PlacedNumber& number = numbers[first + static_cast<std::size_t>(axis)];
      value[axis] = number.value;
      place.axis[axis] = number.place;
    }
    values.push_back(value);
    places.push_back(place);
  }

  void read_other(const PlyElement& element) {
    for (const PlyProperty& property : element.properties) {
      const bool is_corners = property.name == "vertex_indices" || property.name == "vertex_index";
      if (!property.count_type) {
        (void)body_.next(property.type, property.name);
      } else if (element.name == "face" && is_corners) {
        read_face(property);
      } else {
        skip_list(property);
      }
    }
  }

  /// A whole number from 0 on that an int32 holds.
  [[nodiscard]] std::int32_t next_index(PlyType type, std::string_view what) {
    const double value = body_.next(type, what).value;
    if (!(value >= 0 && value <= std::numeric_limits<std::int32_t>::max()) ||
        value != std::floor(value)) {
      body_.fail(fmt::format("{} is {}, must be a whole number from 0", what, value));
    }
    return static_cast<std::int32_t>(value);
  }

  void skip_list(const PlyProperty& property) {
    const std::int32_t length = next_index(*property.count_type, "the length of a list");
    for (std::int32_t i = 0; i < length; ++i) {
      (void)body_.next(property.type, property.name);
    }
  }

  void read_face(const PlyProperty& property) {
    const std::int32_t length = next_index(*property.count_type, "the number of corners");
    face_.clear();
    for (std::int32_t i = 0; i < length; ++i) {
      face_.push_back(next_index(property.type, "a corner"));
    }
    if (face_.size() >= 3) {
      layout_.faces.push_back(face_);
    }
  }

  /// Faces may stand before the points.
  void check_corners() const {
    for (std::size_t face = 0; face < layout_.faces.n_rows(); ++face) {
      for (const std::int32_t point : layout_.faces[face]) {
        if (static_cast<std::size_t>(point) >= layout_.points.size()) {
          throw FileError(path_, fmt::format("face {} names point {}, there are {}", face, point,
                                             layout_.points.size()));
        }
      }
    }
  }

  std::string path_;
  TextScanner scanner_;
  PlyHeader header_;
  PlyBody body_;
  bool has_normals_ = false;
  ModelLayout layout_;
  std::vector<std::int32_t> face_;
};

}  // namespace

Model parse_ply(std::string path, std::string bytes) {
  ModelLayout layout = PlyScanner(path, bytes).scan();
  return {std::move(path), ModelFormat::Ply, std::move(bytes), std::move(layout)};
}

}  // namespace espalier
