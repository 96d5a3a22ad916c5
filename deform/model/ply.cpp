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
#include "deform/model/ply_body.h"
#include "deform/model/ply_header.h"

namespace espalier {
namespace {

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
    const NumberEncoding own = number_encoding(header_.encoding, property.type);
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

  void skip_list(const PlyProperty& property) {
    const std::int32_t length = body_.next_index(*property.count_type, "the length of a list");
    for (std::int32_t i = 0; i < length; ++i) {
      (void)body_.next(property.type, property.name);
    }
  }

  void read_face(const PlyProperty& property) {
    const std::int32_t length = body_.next_index(*property.count_type, "the number of corners");
    face_.clear();
    for (std::int32_t i = 0; i < length; ++i) {
      face_.push_back(body_.next_index(property.type, "a corner"));
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
