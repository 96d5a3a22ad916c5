/// 3D Systems, "Stereolithography interface specification", 1988.

#include "deform/model/stl.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "deform/model/encoded_number.h"
#include "deform/model/same_place.h"
#include "lattice/core/text_scanner.h"

namespace espalier {
namespace {

constexpr std::size_t kHeaderSize = 84;
constexpr std::size_t kFacetSize = 50;

/// What a file holds: every facet with three corners of its own.
struct Facets {
  std::vector<glm::dvec3> corners;  // 3 × #facets
  std::vector<CoordinatePlaces> corner_places;
  std::vector<glm::dvec3> normals;
  std::vector<CoordinatePlaces> normal_places;
  std::vector<FaceGroup> solids;
  NumberEncoding encoding = NumberEncoding::LittleFloat;
};

class TextStl {
 public:
  TextStl(std::string_view path, std::string_view bytes) : bytes_(bytes), scanner_(path, bytes) {
    facets_.encoding = NumberEncoding::FloatText;
  }

  [[nodiscard]] Facets scan() {
    while (next_line()) {
      if (word_ == "solid") {
        begin_solid();
      } else if (word_ == "facet") {
        read_facet();
      } else if (word_ != "endsolid") {
        scanner_.fail(
            fmt::format("{} in an STL file, must be solid, facet or endsolid", quoted(word_)));
      }
    }
    end_solid();
    return std::move(facets_);
  }

 private:
  /// To the next line with a word.
  bool next_line() {
    do {
      if (!scanner_.next_line()) {
        return false;
      }
      word_ = scanner_.next_word();
    } while (word_.empty());
    return true;
  }

  void expect_line(std::string_view first, std::string_view second = {}) {
    if (!next_line() || word_ != first || (!second.empty() && scanner_.next_word() != second)) {
      scanner_.fail(fmt::format("a facet is not whole: '{}{}{}' is missing", first,
                                second.empty() ? "" : " ", second));
    }
  }

  void begin_solid() {
    end_solid();
    facets_.solids.push_back({std::string(scanner_.next_name()), {}});
  }

  void end_solid() {
    const auto end = static_cast<std::int32_t>(facets_.normals.size());
    if (!facets_.solids.empty() && begin_ < end) {
      facets_.solids.back().ranges.push_back({begin_, end});
    }
    begin_ = end;
  }

  void read_facet() {
    if (scanner_.next_word() != "normal") {
      scanner_.fail("a facet begins 'facet normal x y z'");
    }
    read_coordinates("normal", facets_.normals, facets_.normal_places);
    expect_line("outer", "loop");
    for (int corner = 0; corner < 3; ++corner) {
      expect_line("vertex");
      read_coordinates("vertex", facets_.corners, facets_.corner_places);
    }
    expect_line("endloop");
    expect_line("endfacet");
  }

  void read_coordinates(std::string_view what, std::vector<glm::dvec3>& numbers,
                        std::vector<CoordinatePlaces>& places) {
    glm::dvec3 number;
    CoordinatePlaces place;
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view word = scanner_.next_word();
      number[axis] = scanner_.to_coordinate(word, fmt::format("{} of a {}", "xyz"[axis], what));
      if (word.size() > BytePlace::kLargestLength) {
        scanner_.fail(
            fmt::format("a number has more than {} characters", BytePlace::kLargestLength));
      }
      place.axis[axis] =
          BytePlace(static_cast<std::size_t>(word.data() - bytes_.data()), word.size());
    }
    numbers.push_back(number);
    places.push_back(place);
  }

  std::string_view bytes_;
  TextScanner scanner_;
  std::string_view word_;
  std::int32_t begin_ = 0;  // of the solid
  Facets facets_;
};

std::uint32_t announced_facets(std::string_view bytes) {
  std::uint32_t count = 0;
  for (std::size_t i = kHeaderSize; i-- > kHeaderSize - 4;) {
    count = count << 8 | static_cast<unsigned char>(bytes[i]);
  }
  return count;
}

Facets scan_binary(std::string_view path, std::string_view bytes) {
  const std::size_t n_facets = announced_facets(bytes);
  if (bytes.size() - kHeaderSize < n_facets * kFacetSize) {
    throw FileError(path,
                    fmt::format("announces {} facets of {} bytes, but has room for {}", n_facets,
                                kFacetSize, (bytes.size() - kHeaderSize) / kFacetSize));
  }
  Facets facets;
  const auto read = [&](std::size_t facet, std::size_t vector, glm::dvec3& number) {
    CoordinatePlaces place;
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t at =
          kHeaderSize + facet * kFacetSize + 12 * vector + 4 * static_cast<std::size_t>(axis);
      number[axis] = decoded(bytes.substr(at, 4), NumberEncoding::LittleFloat);
      place.axis[axis] = BytePlace(at, 4);
    }
    return place;
  };
  for (std::size_t facet = 0; facet < n_facets; ++facet) {
    glm::dvec3 number;
    facets.normal_places.push_back(read(facet, 0, number));
    facets.normals.push_back(std::isfinite(number.x + number.y + number.z) ? number
                                                                           : glm::dvec3(0));
    for (std::size_t corner = 0; corner < 3; ++corner) {
      facets.corner_places.push_back(read(facet, 1 + corner, number));
      for (int axis = 0; axis < 3; ++axis) {
        if (!(std::abs(number[axis]) <= kLargestCoordinate)) {
          throw FileError(path, fmt::format("facet {}: {} of corner {} is {}, must be a number up "
                                            "to 1e18",
                                            facet, "xyz"[axis], corner, number[axis]));
        }
      }
      facets.corners.push_back(number);
    }
  }
  return facets;
}

/// A text file begins with "solid", but so may the free text of a binary one, whose size is known.
bool is_text(std::string_view bytes) {
  const bool is_sized = bytes.size() >= kHeaderSize &&
                        bytes.size() == kHeaderSize + announced_facets(bytes) * kFacetSize;
  TextScanner scanner("", bytes.substr(0, 1024));
  std::string_view word;
  while (word.empty() && scanner.next_line()) {
    word = scanner.next_word();
  }
  return !is_sized && word == "solid";
}

/// Numbers the different corners in the order in which they appear.
void merge_corners(const std::vector<glm::dvec3>& corners, ModelLayout& layout) {
  const std::vector<std::int32_t> first = first_in_place(corners);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto earlier = static_cast<std::size_t>(first[i]);
    if (earlier == i) {
      layout.points_of_places.push_back(static_cast<std::int32_t>(layout.points.size()));
      layout.points.push_back(corners[i]);
    } else {
      layout.points_of_places.push_back(layout.points_of_places[earlier]);
    }
  }
}

/// Solids without a name are no groups; those that share one are one.
std::vector<FaceGroup> named_groups(const std::vector<FaceGroup>& solids) {
  std::vector<FaceGroup> groups;
  for (const FaceGroup& solid : solids) {
    const auto found = std::ranges::find(groups, solid.name, &FaceGroup::name);
    if (found != groups.end()) {
      found->ranges.insert(found->ranges.end(), solid.ranges.begin(), solid.ranges.end());
    } else if (!solid.name.empty()) {
      groups.push_back(solid);
    }
  }
  return groups;
}

}  // namespace

Model parse_stl(std::string path, std::string bytes) {
  Facets facets;
  if (is_text(bytes)) {
    facets = TextStl(path, bytes).scan();
  } else if (bytes.size() >= kHeaderSize) {
    facets = scan_binary(path, bytes);
  } else {
    throw FileError(path, "is no STL file: text begins with 'solid', binary has 84 bytes or more");
  }
  if (facets.normals.empty()) {
    throw FileError(path, "has no facets");
  }
  ModelLayout layout;
  merge_corners(facets.corners, layout);
  layout.faces = CompressedRows<std::int32_t>::uniform(3, layout.points_of_places);
  layout.point_places = std::move(facets.corner_places);
  layout.facet_normals = std::move(facets.normals);
  layout.facet_places = std::move(facets.normal_places);
  layout.groups = named_groups(facets.solids);
  layout.encoding = layout.normal_encoding = facets.encoding;
  return {std::move(path), ModelFormat::Stl, std::move(bytes), std::move(layout)};
}

}  // namespace espalier
