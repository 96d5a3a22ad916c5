#include "deform/model/deformed.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>
#include <vector>

#include "deform/model/encoded_number.h"
#include "deform/model/model_file.h"
#include "deform/model/normals.h"
#include "deform/model/point_normals.h"
#include "deform/model/splices.h"
#include "lattice/core/error.h"
#include "lattice/core/text_scanner.h"

namespace espalier {
namespace {

bool has_same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool has_same_bits(const glm::dvec3& a, const glm::dvec3& b) {
  return has_same_bits(a.x, b.x) && has_same_bits(a.y, b.y) && has_same_bits(a.z, b.z);
}

void require_valid(const Model& model, std::span<const glm::dvec3> points,
                   std::span<const glm::dvec3> pair_normals) {
  if (points.size() != model.points().size()) {
    throw ParameterError(fmt::format("deformed: {} points given, {} has {}", points.size(),
                                     model.path(), model.points().size()));
  }
  if (!pair_normals.empty() && pair_normals.size() != model.pairs().size()) {
    throw ParameterError(
        fmt::format("deformed: {} normals given, {} has {} pairs of point and "
                    "normal",
                    pair_normals.size(), model.path(), model.pairs().size()));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!(std::abs(points[i][axis]) <= kLargestCoordinate)) {
        throw ParameterError(
            fmt::format("deformed: point {} moved to {}, beyond the largest "
                        "coordinate, 1e18",
                        i, points[i][axis]));
      }
    }
  }
}

void replace_coordinates(const CoordinatePlaces& places, const glm::dvec3& old_numbers,
                         const glm::dvec3& new_numbers, NumberEncoding of_file, Splices& splices) {
  for (int axis = 0; axis < 3; ++axis) {
    const NumberEncoding encoding = with_size(of_file, places.axis[axis].length());
    if (!is_same_number(old_numbers[axis], new_numbers[axis], encoding)) {
      splices.replace(places.axis[axis], EncodedNumber(new_numbers[axis], encoding).view());
    }
  }
}

/// Returns whether a point moved.
bool replace_points(const Model& model, std::span<const glm::dvec3> points, Splices& splices) {
  const ModelLayout& layout = model.layout();
  bool is_moved = false;
  for (std::size_t place = 0; place < layout.point_places.size(); ++place) {
    const std::size_t i = layout.points_of_places.empty()
                              ? place
                              : static_cast<std::size_t>(layout.points_of_places[place]);
    if (!has_same_bits(points[i], layout.points[i])) {
      is_moved = true;
      replace_coordinates(layout.point_places[place], layout.points[i], points[i], layout.encoding,
                          splices);
    }
  }
  return is_moved;
}

/// Facets that moved get the normal of their triangle, unless they had none, or have none now.
void replace_facet_normals(const Model& model, std::span<const glm::dvec3> points,
                           Splices& splices) {
  const ModelLayout& layout = model.layout();
  for (std::size_t facet = 0; facet < layout.facet_normals.size(); ++facet) {
    const std::span<const std::int32_t> corners = layout.faces[facet];
    const bool is_moved = std::ranges::any_of(
        corners, [&](std::int32_t i) { return !has_same_bits(points[i], layout.points[i]); });
    const glm::dvec3 normal = unit_or_zero(glm::cross(points[corners[1]] - points[corners[0]],
                                                      points[corners[2]] - points[corners[0]]));
    const glm::dvec3& old = layout.facet_normals[facet];
    if (is_moved && old != glm::dvec3(0) && normal != glm::dvec3(0)) {
      replace_coordinates(layout.facet_places[facet], old, normal, layout.normal_encoding, splices);
    }
  }
}

/// Normals that stand before a byte of the file.
std::size_t normals_before(const ModelLayout& layout, std::size_t byte) {
  const auto at = std::partition_point(
      layout.normal_places.begin(), layout.normal_places.end(),
      [byte](const CoordinatePlaces& place) { return place.axis[0].begin() < byte; });
  return static_cast<std::size_t>(at - layout.normal_places.begin());
}

/// How the normals of a file are numbered before and after lines were inserted: absolutely from
/// 1, or relative to the count of those before the reference.
class NormalNumbering {
 public:
  /// first_new: #N + 1, the new index of each old normal, and the new count.
  NormalNumbering(const ModelLayout& layout, std::vector<std::size_t> first_new)
      : layout_(layout), first_new_(std::move(first_new)) {}

  [[nodiscard]] std::size_t first_new(std::int32_t old_normal) const {
    return first_new_[old_normal];
  }
  /// The number by which the reference at a byte of the old file names an old normal there.
  [[nodiscard]] std::int64_t old_number(std::size_t normal, std::size_t byte,
                                        bool is_relative) const {
    return number(normal, is_relative ? normals_before(layout_, byte) : 0, is_relative);
  }
  /// The same of a new normal in the new file.
  [[nodiscard]] std::int64_t new_number(std::size_t normal, std::size_t byte,
                                        bool is_relative) const {
    return number(normal, is_relative ? first_new_[normals_before(layout_, byte)] : 0, is_relative);
  }

 private:
  [[nodiscard]] static std::int64_t number(std::size_t normal, std::size_t count,
                                           bool is_relative) {
    const auto index = static_cast<std::int64_t>(normal);
    return is_relative ? index - static_cast<std::int64_t>(count) : index + 1;
  }

  const ModelLayout& layout_;
  std::vector<std::size_t> first_new_;
};

std::string normal_line(const glm::dvec3& normal, NumberEncoding encoding) {
  std::string line = "vn";
  for (int axis = 0; axis < 3; ++axis) {
    line += ' ';
    line += EncodedNumber(normal[axis], encoding).view();
  }
  return line;
}

void rewrite_references(const Model& model, const NormalReferences& references,
                        const NormalPlan& plan, const NormalNumbering& numbering,
                        Splices& splices) {
  for (std::size_t i = 0; i < references.pairs.size(); ++i) {
    const std::int32_t pair = references.pairs[i];
    if (pair < 0) {
      continue;
    }
    const BytePlace place = references.places[i];
    const bool is_relative = model.bytes()[place.begin()] == '-';
    const std::int32_t normal = model.pairs()[pair].normal;
    const std::size_t new_normal = numbering.first_new(normal) + plan.value_of_pair[pair];
    const std::int64_t number = numbering.new_number(new_normal, place.begin(), is_relative);
    if (number != numbering.old_number(normal, place.begin(), is_relative)) {
      splices.replace(place, fmt::format_int(number).c_str());
    }
  }
}

void replace_normals(const Model& model, const NormalPlan& plan, Splices& splices) {
  const ModelLayout& layout = model.layout();
  std::vector<std::size_t> first_new(1, 0);
  for (std::size_t normal = 0; normal < layout.normals.size(); ++normal) {
    const std::span<const glm::dvec3> values = plan.values[normal];
    replace_coordinates(layout.normal_places[normal], layout.normals[normal], values[0],
                        layout.normal_encoding, splices);
    for (const glm::dvec3& value : values.subspan(1)) {
      splices.insert(layout.normal_ends[normal],
                     std::string(layout.line_end) + normal_line(value, layout.normal_encoding));
    }
    first_new.push_back(first_new.back() + values.size());
  }
  if (first_new.back() > layout.normals.size()) {
    const NormalNumbering numbering(layout, std::move(first_new));
    rewrite_references(model, layout.corners, plan, numbering, splices);
    rewrite_references(model, layout.others, plan, numbering, splices);
  }
}

/// The slashes still missing before a normal's number in v, v/, v/vt, v// or v/vt/, and whether
/// the reference that `end` lies in is relative.
struct ReferenceStyle {
  std::string_view missing_slashes;
  bool is_relative;
};
ReferenceStyle reference_style(std::string_view bytes, std::size_t end) {
  std::size_t begin = end;
  std::size_t n_slashes = 0;
  while (begin > 0 &&
         std::string_view("0123456789+-/").find(bytes[begin - 1]) != std::string_view::npos) {
    --begin;
    n_slashes += bytes[begin] == '/' ? 1 : 0;
  }
  return {std::string_view("//").substr(n_slashes), bytes[begin] == '-'};
}

/// Writes normals before the first face, and names them in all faces.
void add_normals(const Model& model, const CornerNormals& added, Splices& splices) {
  const ModelLayout& layout = model.layout();
  for (const glm::dvec3& normal : added.normals) {
    splices.insert(layout.first_face,
                   normal_line(normal, layout.normal_encoding).append(layout.line_end));
  }
  const std::size_t n_before = normals_before(layout, layout.first_face);
  const std::size_t next = n_before + added.normals.size();
  std::vector<std::size_t> first_new(layout.normals.size() + 1);
  for (std::size_t normal = 0; normal < first_new.size(); ++normal) {
    first_new[normal] = normal + (normal >= n_before ? next - n_before : 0);
  }
  const NormalNumbering numbering(layout, std::move(first_new));
  for (std::size_t corner = 0; corner < layout.faces.n_values(); ++corner) {
    const BytePlace place = layout.corners.places[corner];
    const ReferenceStyle style = reference_style(model.bytes(), place.begin());
    const std::int64_t number =
        numbering.new_number(n_before + static_cast<std::size_t>(added.of_corners[corner]),
                             place.begin(), style.is_relative);
    splices.replace(place, fmt::format("{}{}", style.missing_slashes, number));
  }
}

Model with_bytes(const Model& model, std::string bytes) {
  return bytes == model.bytes() ? model
                                : parse_model(model.format(), model.path(), std::move(bytes));
}

}  // namespace

std::string deformed_bytes(const Model& model, std::span<const glm::dvec3> points,
                           std::span<const glm::dvec3> pair_normals, NormalMode mode) {
  require_valid(model, points, pair_normals);
  Splices splices;
  replace_points(model, points, splices);
  replace_facet_normals(model, points, splices);
  if (!pair_normals.empty()) {
    const bool can_split = !model.layout().normal_ends.empty() && mode != NormalMode::Keep;
    replace_normals(
        model,
        can_split ? split_normals(model, pair_normals) : average_normals(model, pair_normals),
        splices);
  }
  return splices.apply(model.bytes());
}

std::string deformed_bytes_with_normals(const Model& model, std::span<const glm::dvec3> points,
                                        const CornerNormals& added) {
  if (model.format() == ModelFormat::Stl) {
    throw ParameterError(fmt::format(
        "normals: {} is an STL file, which has normals of its facets alone", model.path()));
  }
  if (!model.pairs().empty() || added.of_corners.size() != model.faces().n_values()) {
    throw ParameterError(fmt::format("normals: {} given for {} corners, of which some have normals",
                                     added.of_corners.size(), model.faces().n_values()));
  }
  require_valid(model, points, {});
  Splices splices;
  if (!replace_points(model, points, splices)) {
    return std::string(model.bytes());
  }
  if (model.format() == ModelFormat::Obj) {
    add_normals(model, added, splices);
    return splices.apply(model.bytes());
  }
  return bytes_with_point_normals(with_bytes(model, splices.apply(model.bytes())), added);
}

Model deformed(const Model& model, std::span<const glm::dvec3> points,
               std::span<const glm::dvec3> pair_normals, NormalMode mode) {
  return with_bytes(model, deformed_bytes(model, points, pair_normals, mode));
}

Model deformed_with_normals(const Model& model, std::span<const glm::dvec3> points,
                            const CornerNormals& added) {
  return with_bytes(model, deformed_bytes_with_normals(model, points, added));
}

}  // namespace espalier
