#pragma once

/// What a scanner finds in a model's file: the geometry, and where in the bytes it stands.

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "lattice/core/compressed_rows.h"

namespace espalier {

/// A stretch of a file's bytes; one of length 0 is a place to insert at.
class BytePlace {
 public:
  static constexpr std::uint64_t kLargestBegin = (std::uint64_t{1} << 40) - 1;
  static constexpr std::uint64_t kLargestLength = (std::uint64_t{1} << 24) - 1;

  BytePlace() = default;
  BytePlace(std::size_t begin, std::size_t length)
      : begin_(begin & kLargestBegin), length_(length & kLargestLength) {
    assert(begin <= kLargestBegin && length <= kLargestLength);
  }

  [[nodiscard]] std::size_t begin() const { return begin_; }
  [[nodiscard]] std::size_t length() const { return length_; }

 private:
  std::uint64_t begin_ : 40 = 0;
  std::uint64_t length_ : 24 = 0;
};

/// The places of the coordinates of one point or normal.
struct CoordinatePlaces {
  BytePlace axis[3];
};

/// How a file writes its coordinates.
enum class NumberEncoding : std::uint8_t {
  FloatText,     ///< decimal digits that tell floats apart
  DoubleText,    ///< decimal digits that tell doubles apart
  LittleFloat,   ///< four bytes, the least significant first
  BigFloat,      ///< four bytes, the most significant first
  LittleDouble,  ///< eight bytes
  BigDouble,
};

/// A point with one of its normals.
struct PointNormal {
  std::int32_t point = -1;
  std::int32_t normal = -1;
  bool operator==(const PointNormal&) const = default;
};

/// Consecutive faces [begin, end).
struct FaceRange {
  std::int32_t begin = 0;
  std::int32_t end = 0;
  bool operator==(const FaceRange&) const = default;
};

/// Faces that share a name, in increasing order. A face may be in several groups.
struct FaceGroup {
  std::string name;
  std::vector<FaceRange> ranges;
};

/// Places where normals are named by their number, in file order.
struct NormalReferences {
  /// Index into ModelLayout::pairs, -1 where no normal is named. May be empty if none is.
  std::vector<std::int32_t> pairs;
  /// The number's text, or of length 0 where a number could be inserted.
  std::vector<BytePlace> places;
};

/// All indices count from 0.
struct ModelLayout {
  std::vector<glm::dvec3> points;               ///< #P × 3, model units
  std::vector<CoordinatePlaces> point_places;   ///< #P, or as many as points_of_places
  std::vector<glm::dvec3> normals;              ///< #N × 3, as written, of any length
  std::vector<CoordinatePlaces> normal_places;  ///< #N
  CompressedRows<std::int32_t> faces;           ///< points at the corners of each polygon
  CompressedRows<std::int32_t> lines;  ///< points along each polyline, where a format has them
  std::vector<PointNormal> pairs;      ///< that occur; sorted by point, then normal
  std::vector<FaceGroup> groups;       ///< in the order of their first mention
  NumberEncoding encoding = NumberEncoding::FloatText;  ///< but see with_size()
  NumberEncoding normal_encoding = NumberEncoding::FloatText;

  // For formats that write a point once for every face.
  std::vector<std::int32_t> points_of_places;  ///< the point at each place; empty: place i, point i
  std::vector<glm::dvec3> facet_normals;       ///< #faces, as written, or none
  std::vector<CoordinatePlaces> facet_places;  ///< of the facets' normals

  // For formats that number their normals.
  std::vector<std::size_t> normal_ends;  ///< #N; a new normal's line may start after this byte
  NormalReferences corners;              ///< parallel to the values of `faces`
  NormalReferences others;               ///< outside faces: free-form surfaces, lines
  std::size_t first_face = 0;            ///< begin of the line of the first face
  std::string_view line_end = "\n";      ///< as the file's first line has it
};

}  // namespace espalier
