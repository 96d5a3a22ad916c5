/// Scans OBJ text: "Advanced Visualizer manual, appendix B1: object files", Wavefront 1992.

#include "deform/model/obj.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "deform/model/encoded_number.h"
#include "deform/model/pairs.h"
#include "lattice/core/text_scanner.h"

namespace espalier {
namespace {

constexpr std::int64_t kMostElements = std::numeric_limits<std::int32_t>::max();
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// What a corner names, in the order v/vt/vn.
enum ReferenceKind { Vertex, Texture, Normal };
constexpr int kReferenceKinds = 3;
constexpr std::array<std::string_view, kReferenceKinds> kKindNames = {"vertex", "texture vertex",
                                                                      "normal"};
constexpr std::array<std::string_view, kReferenceKinds> kKindStatements = {"v", "vt", "vn"};
using Counts = std::array<std::int64_t, kReferenceKinds>;
constexpr Counts kUnlimited = {kMostElements, kMostElements, kMostElements};

/// The groups and objects that faces are read into.
class GroupBuilder {
 public:
  /// Following faces are in the groups named by the rest of the line, from face `next` on.
  void start(bool is_object, TextScanner& scanner, std::int32_t next) {
    std::vector<std::size_t>& active = is_object ? objects_ : groups_;
    close(active, is_object ? objects_begin_ : groups_begin_, next);
    for (auto name = scanner.next_name(); !name.empty(); name = scanner.next_name()) {
      const auto [at, is_new] = numbers_.try_emplace(std::string(name), result_.size());
      if (is_new) {
        result_.push_back({at->first, {}});
      }
      active.push_back(at->second);
    }
  }

  [[nodiscard]] std::vector<FaceGroup> finish(std::int32_t n_faces) {
    close(groups_, groups_begin_, n_faces);
    close(objects_, objects_begin_, n_faces);
    for (FaceGroup& group : result_) {
      merge_ranges(group.ranges);
    }
    return std::move(result_);
  }

 private:
  void close(std::vector<std::size_t>& active, std::int32_t& begin, std::int32_t end) {
    if (begin < end) {
      for (const std::size_t group : active) {
        result_[group].ranges.push_back({begin, end});
      }
    }
    active.clear();
    begin = end;
  }

  /// A group and an object of one name, or a name given twice, may have brought ranges that
  /// touch or overlap.
  static void merge_ranges(std::vector<FaceRange>& ranges) {
    std::sort(ranges.begin(), ranges.end(),
              [](const FaceRange& a, const FaceRange& b) { return a.begin < b.begin; });
    std::vector<FaceRange> merged;
    for (const FaceRange& range : ranges) {
      if (!merged.empty() && range.begin <= merged.back().end) {
        merged.back().end = std::max(merged.back().end, range.end);
      } else {
        merged.push_back(range);
      }
    }
    ranges = std::move(merged);
  }

  std::vector<FaceGroup> result_;
  std::unordered_map<std::string, std::size_t> numbers_;
  std::vector<std::size_t> groups_;
  std::vector<std::size_t> objects_;
  std::int32_t groups_begin_ = 0;
  std::int32_t objects_begin_ = 0;
};

/// The first line end in `bytes`.
std::string_view line_end_of(std::string_view bytes) {
  const std::size_t at = bytes.find_first_of("\r\n");
  if (at == std::string_view::npos || bytes[at] == '\n') {
    return "\n";
  }
  return bytes.substr(at).starts_with("\r\n") ? "\r\n" : "\r";
}

class ObjScanner {
 public:
  /// limits: references to elements beyond these counts are errors.
  ObjScanner(std::string_view path, std::string_view bytes, const Counts& limits)
      : bytes_(bytes),
        scanner_(path,
                 bytes.starts_with(kByteOrderMark) ? bytes.substr(kByteOrderMark.size()) : bytes,
                 {.comment = '#', .joins_lines = true}),
        limits_(limits) {}

  void scan() {
    while (scanner_.next_line()) {
      read_statement(scanner_.next_word());
    }
  }

  /// References to texture vertices or normals in a file that has none at all are left alone.
  [[nodiscard]] bool has_dangling_references() const {
    bool is_dangling = false;
    for (int kind = Vertex; kind < kReferenceKinds; ++kind) {
      is_dangling |= largest_[kind] > counts_[kind] && (kind == Vertex || counts_[kind] > 0);
    }
    return is_dangling;
  }
  [[nodiscard]] const Counts& counts() const { return counts_; }

  [[nodiscard]] ModelLayout finish();

 private:
  struct Reference {
    std::int32_t point = -1;
    std::int32_t normal = -1;
    BytePlace normal_place;
  };

  void read_statement(std::string_view keyword);
  void read_vertex();
  void read_normal();
  void read_face();
  /// The points that the rest of the line names.
  std::vector<std::int32_t> read_references();
  void read_surface();

  void read_coordinates(std::array<std::string_view, 3> names, std::vector<glm::dvec3>& numbers,
                        std::vector<CoordinatePlaces>& places);
  [[nodiscard]] Reference parse_reference(std::string_view word);
  [[nodiscard]] std::int64_t resolve(std::string_view word, std::string_view number, int kind);
  void add_corner_normal(std::int32_t normal);
  void add_other_reference(const Reference& reference);
  void count(int kind);
  void find_pairs();

  [[nodiscard]] std::size_t place_of(std::string_view text) const {
    return static_cast<std::size_t>(text.data() - bytes_.data());
  }

  std::string_view bytes_;
  TextScanner scanner_;
  Counts limits_;
  Counts counts_ = {};
  Counts largest_ = {};  // numbers referred to
  ModelLayout layout_;
  GroupBuilder groups_;
  std::vector<std::int32_t> face_;            // corners of the face being read
  std::vector<std::int32_t> corner_normals_;  // filled from the first one on
  std::vector<PointNormal> others_;
  bool has_corner_normals_ = false;
};

void ObjScanner::read_statement(std::string_view keyword) {
  if (keyword == "v") {
    read_vertex();
  } else if (keyword == "vn") {
    read_normal();
  } else if (keyword == "vt") {
    count(Texture);
  } else if (keyword == "f" || keyword == "fo") {
    read_face();
  } else if (keyword == "l") {
    layout_.lines.push_back(read_references());
  } else if (keyword == "p") {
    read_references();
  } else if (keyword == "surf") {
    read_surface();
  } else if (keyword == "g" || keyword == "o") {
    groups_.start(keyword == "o", scanner_, static_cast<std::int32_t>(layout_.faces.n_rows()));
  }
}

void ObjScanner::count(int kind) {
  if (++counts_[kind] > kMostElements) {
    scanner_.fail(fmt::format("more than {} elements of one kind", kMostElements));
  }
}

void ObjScanner::read_coordinates(std::array<std::string_view, 3> names,
                                  std::vector<glm::dvec3>& numbers,
                                  std::vector<CoordinatePlaces>& places) {
  glm::dvec3 number;
  CoordinatePlaces place;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string_view word = scanner_.next_word();
    number[axis] = scanner_.to_coordinate(word, names[axis]);
    if (word.size() > BytePlace::kLargestLength) {
      scanner_.fail(
          fmt::format("{} has more than {} characters", names[axis], BytePlace::kLargestLength));
    }
    if (layout_.encoding == NumberEncoding::FloatText && significant_digits(word) > kFloatDigits) {
      layout_.encoding = NumberEncoding::DoubleText;
    }
    place.axis[axis] = BytePlace(place_of(word), word.size());
  }
  numbers.push_back(number);
  places.push_back(place);
}

void ObjScanner::read_vertex() {
  count(Vertex);
  read_coordinates(
      {"x of a vertex (v x y z)", "y of a vertex (v x y z)", "z of a vertex (v x y z)"},
      layout_.points, layout_.point_places);
}

void ObjScanner::read_normal() {
  count(Normal);
  const NumberEncoding encoding = layout_.encoding;
  read_coordinates(
      {"x of a normal (vn x y z)", "y of a normal (vn x y z)", "z of a normal (vn x y z)"},
      layout_.normals, layout_.normal_places);
  layout_.encoding = encoding;
  std::string_view line = scanner_.line();
  if (line.ends_with('\\') && place_of(line) + line.size() == bytes_.size()) {
    line.remove_suffix(1);  // it would join what is inserted after it
  }
  layout_.normal_ends.push_back(place_of(line) + line.size());
}

/// The index from 0 that `number`, a part of `word`, stands for.
std::int64_t ObjScanner::resolve(std::string_view word, std::string_view number, int kind) {
  std::int64_t value = 0;
  if (!parse_integer(number, value)) {
    scanner_.fail(fmt::format("{} is no reference: write v, v/vt, v//vn or v/vt/vn, whole numbers",
                              quoted(word)));
  }
  if (value == 0) {
    scanner_.fail(fmt::format("{} refers to {} 0: they count from 1, or back from -1", quoted(word),
                              kKindNames[kind]));
  }
  if (value < -counts_[kind] || value > limits_[kind]) {
    scanner_.fail(fmt::format("{} refers to {} {}, but the file has only {} '{}'{}", quoted(word),
                              kKindNames[kind], value, value < 0 ? counts_[kind] : limits_[kind],
                              kKindStatements[kind], value < 0 ? " before it" : ""));
  }
  largest_[kind] = std::max(largest_[kind], value);
  return value < 0 ? counts_[kind] + value : value - 1;
}

ObjScanner::Reference ObjScanner::parse_reference(std::string_view word) {
  Reference reference;
  std::string_view rest = word;
  for (int kind = Vertex; kind < kReferenceKinds; ++kind) {
    const std::size_t slash = kind == Normal ? std::string_view::npos : rest.find('/');
    const std::string_view number = rest.substr(0, slash);
    rest.remove_prefix(slash == std::string_view::npos ? rest.size() : slash + 1);
    if (!number.empty() || kind == Vertex) {
      const auto index = static_cast<std::int32_t>(resolve(word, number, kind));
      if (kind == Vertex) {
        reference.point = index;
      } else if (kind == Normal) {
        reference.normal = index;
        reference.normal_place = BytePlace(place_of(number), number.size());
      }
    }
  }
  if (reference.normal < 0) {
    reference.normal_place = BytePlace(place_of(word) + word.size(), 0);
  }
  return reference;
}

void ObjScanner::read_face() {
  if (layout_.faces.empty()) {
    layout_.first_face = place_of(scanner_.line());
  }
  face_.clear();
  for (auto word = scanner_.next_word(); !word.empty(); word = scanner_.next_word()) {
    const Reference reference = parse_reference(word);
    face_.push_back(reference.point);
    add_corner_normal(reference.normal);
    layout_.corners.places.push_back(reference.normal_place);
  }
  if (face_.size() < 3) {
    scanner_.fail(fmt::format("a face needs three corners or more, this has {}", face_.size()));
  }
  if (layout_.faces.n_values() + face_.size() > static_cast<std::size_t>(kMostElements)) {
    scanner_.fail(fmt::format("more than {} corners", kMostElements));
  }
  layout_.faces.push_back(face_);
}

void ObjScanner::add_corner_normal(std::int32_t normal) {
  if (normal >= 0 && !has_corner_normals_) {
    has_corner_normals_ = true;
    corner_normals_.assign(layout_.corners.places.size(), -1);
  }
  if (has_corner_normals_) {
    corner_normals_.push_back(normal);
  }
}

std::vector<std::int32_t> ObjScanner::read_references() {
  std::vector<std::int32_t> points;
  for (auto word = scanner_.next_word(); !word.empty(); word = scanner_.next_word()) {
    const Reference reference = parse_reference(word);
    add_other_reference(reference);
    points.push_back(reference.point);
  }
  return points;
}

/// surf s0 s1 t0 t1 v/vt/vn …: only references that may name a normal matter here.
void ObjScanner::read_surface() {
  for (auto word = scanner_.next_word(); !word.empty(); word = scanner_.next_word()) {
    if (word.find('/') != std::string_view::npos) {
      add_other_reference(parse_reference(word));
    }
  }
}

void ObjScanner::add_other_reference(const Reference& reference) {
  if (reference.normal >= 0) {
    others_.push_back({reference.point, reference.normal});
    layout_.others.places.push_back(reference.normal_place);
  }
}

void ObjScanner::find_pairs() {
  const std::span<const std::int32_t> corners = layout_.faces.values();
  std::vector<PointNormal> uses;
  uses.reserve((has_corner_normals_ ? corners.size() : 0) + others_.size());
  for (std::size_t corner = 0; has_corner_normals_ && corner < corners.size(); ++corner) {
    uses.push_back({corners[corner], corner_normals_[corner]});
  }
  const std::size_t n_corner_uses = uses.size();
  uses.insert(uses.end(), others_.begin(), others_.end());
  UniquePairs unique = unique_pairs(uses, layout_.points.size());
  layout_.pairs = std::move(unique.pairs);
  std::vector<std::int32_t>& pair_of_use = unique.pair_of_use;
  layout_.others.pairs.assign(pair_of_use.end() - static_cast<std::ptrdiff_t>(others_.size()),
                              pair_of_use.end());
  pair_of_use.resize(n_corner_uses);
  layout_.corners.pairs = std::move(pair_of_use);
}

ModelLayout ObjScanner::finish() {
  layout_.groups = groups_.finish(static_cast<std::int32_t>(layout_.faces.n_rows()));
  if (counts_[Normal] > 0 && (has_corner_normals_ || !others_.empty())) {
    find_pairs();
  }
  layout_.normal_encoding = layout_.encoding;
  layout_.line_end = line_end_of(bytes_);
  return std::move(layout_);
}

/// References to what comes later can only be judged at the end: then, if one has nothing to
/// refer to, a second pass that knows the counts finds and names it.
ModelLayout scan_obj(std::string_view path, std::string_view bytes) {
  ObjScanner scanner(path, bytes, kUnlimited);
  scanner.scan();
  if (scanner.counts()[Vertex] == 0) {
    throw FileError(path, "has no vertices: an OBJ file needs lines like 'v 1.0 2.0 3.0'");
  }
  if (scanner.has_dangling_references()) {
    Counts limits = scanner.counts();
    std::replace(limits.begin(), limits.end(), std::int64_t{0}, kMostElements);
    ObjScanner(path, bytes, limits).scan();
  }
  return scanner.finish();
}

}  // namespace

Model parse_obj(std::string path, std::string bytes) {
  ModelLayout layout = scan_obj(path, bytes);
  return {std::move(path), ModelFormat::Obj, std::move(bytes), std::move(layout)};
}

}  // namespace espalier
