#include "deform/model/point_normals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "deform/model/dense_file.h"
#include "deform/model/encoded_number.h"
#include "deform/model/off_rows.h"
#include "deform/model/ply_rows.h"
#include "deform/model/splices.h"
#include "lattice/core/error.h"

namespace espalier {
namespace {

/// Points so that each has one normal.
struct SplitPoints {
  std::vector<glm::dvec3> normals;    ///< #points and more, which follow
  std::vector<std::size_t> sources;   ///< of those that follow: the point that each is once more
  std::vector<std::int32_t> corners;  ///< #corners: the point at each

  SplitPoints(const Model& model, const CornerNormals& added)
      : normals(model.points().size(), glm::dvec3(0)) {
    std::vector<std::int32_t> numbers;  // of the normals' points
    for (std::size_t k = 0; k < added.normals.size(); ++k) {
      const std::int32_t point = added.points[k];
      if (k > 0 && added.points[k - 1] == point) {
        numbers.push_back(static_cast<std::int32_t>(normals.size()));
        sources.push_back(static_cast<std::size_t>(point));
        normals.push_back(added.normals[k]);
      } else {
        numbers.push_back(point);
        normals[static_cast<std::size_t>(point)] = added.normals[k];
      }
    }
    for (const std::int32_t normal : added.of_corners) {
      corners.push_back(numbers[static_cast<std::size_t>(normal)]);
    }
  }

  [[nodiscard]] std::span<const std::int32_t> of_face(const Model& model, std::size_t face) const {
    return std::span(corners).subspan(model.faces().offset(face), model.faces()[face].size());
  }
  [[nodiscard]] bool is_changed(const Model& model, std::size_t face) const {
    return !std::ranges::equal(of_face(model, face), model.faces()[face]);
  }
};

std::string text_of(const glm::dvec3& normal) {
  std::string text;
  for (int axis = 0; axis < 3; ++axis) {
    text += ' ';
    text += EncodedNumber(normal[axis], NumberEncoding::FloatText).view();
  }
  return text;
}

std::string off_with_normals(const Model& model, const SplitPoints& split) {
  const OffRows rows = off_rows(model);
  const std::size_t n_points = model.points().size();
  const auto place = [&](std::string_view word) {
    return static_cast<std::size_t>(word.data() - model.bytes().data());
  };
  Splices splices;
  splices.insert(place(rows.keyword) + rows.keyword.find("OFF"), "N");
  splices.replace(BytePlace(place(rows.counts[0]), rows.counts[0].size()),
                  std::to_string(split.normals.size()));
  const auto end_of_place = [&](std::size_t point) {
    const BytePlace& last = model.layout().point_places[point].axis[2];
    return last.begin() + last.length();
  };
  for (std::size_t i = 0; i < n_points; ++i) {
    splices.insert(end_of_place(i), text_of(split.normals[i]));
  }
  std::string more;
  for (std::size_t k = 0; k < split.sources.size(); ++k) {
    const OffPointRow& row = rows.points[split.sources[k]];
    const std::size_t end = end_of_place(split.sources[k]);
    more += line_end_of(model.bytes());
    more += model.bytes().substr(row.begin, end - row.begin);
    more += text_of(split.normals[n_points + k]);
    more += model.bytes().substr(end, row.end - end);
  }
  splices.insert(rows.end_of_points, more);
  for (std::size_t face = 0; face < rows.faces.size(); ++face) {
    if (split.is_changed(model, face)) {
      std::string text = std::to_string(model.faces()[face].size());
      for (const std::int32_t point : split.of_face(model, face)) {
        text += ' ' + std::to_string(point);
      }
      splices.replace(rows.faces[face].begin, rows.faces[face].end, text);
    }
  }
  return splices.apply(model.bytes());
}

class PlyNormals {
 public:
  PlyNormals(const Model& model, const SplitPoints& split)
      : model_(model), split_(split), rows_(model_) {}

  [[nodiscard]] std::string run() {
    declare();
    rows_.replace_count("vertex", split_.sources.size(), splices_);
    std::vector<std::string_view> points;
    std::size_t end = 0;
    rows_.for_each([&](const PlyElement& element, PlyRows::Row row) {
      if (element.name == "vertex") {
        end = row.back().end;
        splices_.insert(end, numbers(split_.normals[points.size()]));
        points.push_back(model_.bytes().substr(row.front().begin, end - row.front().begin));
      }
    });
    splices_.insert(rows_.end_of_line(end), more_points(points));
    rows_.for_each_face([&](std::size_t face, const PlyElement& element, PlyRows::Row row) {
      for (std::size_t k = 0; k < row.size(); ++k) {
        if (is_ply_corners(element.properties[k]) && split_.is_changed(model_, face)) {
          splices_.replace(row[k].begin, row[k].end, corners(element.properties[k], face));
        }
      }
    });
    return splices_.apply(model_.bytes());
  }

 private:
  /// The properties in the header, of the type of x.
  void declare() {
    std::string lines;
    for (const std::string_view name : {"nx", "ny", "nz"}) {
      for (const PlyProperty& property : rows_.vertex().properties) {
        if (property.name == name) {
          throw ParameterError(fmt::format(
              "normals: {} has points with {}, but not all of nx, ny and nz", model_.path(), name));
        }
        type_ = property.name == "x" ? property.type : type_;
      }
      lines += line_end_;
      lines += fmt::format("property {} {}", type_ == PlyType::Double ? "double" : "float", name);
    }
    const std::string_view last = rows_.vertex().last_line;
    splices_.insert(static_cast<std::size_t>(last.data() + last.size() - model_.bytes().data()),
                    lines);
  }

  [[nodiscard]] std::string numbers(const glm::dvec3& normal) const {
    PlyWriter writer(rows_.header().encoding, line_end_);
    for (int axis = 0; axis < 3; ++axis) {
      writer.write(type_, normal[axis]);
    }
    const bool is_text = rows_.header().encoding == PlyEncoding::Text;
    return (is_text ? " " : "") + writer.text();
  }

  [[nodiscard]] std::string more_points(std::span<const std::string_view> points) const {
    PlyWriter writer(rows_.header().encoding, line_end_);
    for (std::size_t k = 0; k < split_.sources.size(); ++k) {
      writer.end_line();
      writer.write(points[split_.sources[k]]);
      const glm::dvec3& normal = split_.normals[points.size() + k];
      for (int axis = 0; axis < 3; ++axis) {
        writer.write(type_, normal[axis]);
      }
    }
    return writer.text();
  }

  [[nodiscard]] std::string corners(const PlyProperty& property, std::size_t face) const {
    rows_.require_room(property, split_.normals.size(), "normals",
                       "give a larger angle to split at");
    PlyWriter writer(rows_.header().encoding, line_end_);
    const auto points = split_.of_face(model_, face);
    writer.write(*property.count_type, static_cast<double>(points.size()));
    for (const std::int32_t point : points) {
      writer.write(property.type, point);
    }
    return writer.text();
  }

  const Model& model_;
  const SplitPoints& split_;
  PlyRows rows_;
  std::string line_end_{line_end_of(model_.bytes())};
  PlyType type_ = PlyType::Float;
  Splices splices_;
};

}  // namespace

std::string bytes_with_point_normals(const Model& model, const CornerNormals& added) {
  const SplitPoints split(model, added);
  return model.format() == ModelFormat::Off ? off_with_normals(model, split)
                                            : PlyNormals(model, split).run();
}

}  // namespace espalier
