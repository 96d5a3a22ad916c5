/// G. Turk, "The PLY polygon file format", 1994.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deform/model/deformed.h"
#include "deform/model/dense_file.h"
#include "deform/model/encoded_number.h"
#include "deform/model/model_file.h"
#include "deform/model/normals.h"
#include "deform/model/ply_body.h"
#include "deform/model/ply_header.h"
#include "deform/model/splices.h"
#include "lattice/core/error.h"
#include "lattice/core/text_scanner.h"

namespace espalier {
namespace {

constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};
constexpr std::array<std::string_view, 3> kNormal = {"nx", "ny", "nz"};

std::size_t index_in(const std::array<std::string_view, 3>& names, const PlyProperty& property) {
  return property.count_type
             ? 3
             : static_cast<std::size_t>(std::ranges::find(names, property.name) - names.begin());
}

bool is_corners(const PlyProperty& property) {
  return property.count_type &&
         (property.name == "vertex_indices" || property.name == "vertex_index");
}

/// Texture coordinates of all corners, as MeshLab writes them.
bool is_corner_textures(const PlyProperty& property) {
  return property.count_type && property.name == "texcoord";
}

/// Numbers as a PLY file has them.
class PlyWriter {
 public:
  PlyWriter(PlyEncoding encoding, std::string_view line_end)
      : encoding_(encoding), line_end_(line_end) {}

  /// Rounds to what the type holds.
  void write(PlyType type, double number) {
    if (type == PlyType::Float || type == PlyType::Double) {
      write(EncodedNumber(number, number_encoding(encoding_, type)).view());
      return;
    }
    const auto whole = static_cast<std::int64_t>(
        std::clamp(std::round(number), least_of(type), greatest_of(type)));
    if (encoding_ == PlyEncoding::Text) {
      write(std::to_string(whole));
      return;
    }
    for (std::size_t i = 0; i < size_of(type); ++i) {
      const std::size_t byte = encoding_ == PlyEncoding::Little ? i : size_of(type) - 1 - i;
      text_ += static_cast<char>(static_cast<std::uint64_t>(whole) >> (8 * byte) & 0xFF);
    }
  }

  /// What stands in the file already.
  void write(std::string_view bytes) {
    text_ += is_in_line_ && encoding_ == PlyEncoding::Text && !bytes.empty() ? " " : "";
    text_ += bytes;
    is_in_line_ = true;
  }

  void end_line() {
    text_ += encoding_ == PlyEncoding::Text ? line_end_ : "";
    is_in_line_ = false;
  }

  [[nodiscard]] const std::string& text() const { return text_; }

  /// Of whole numbers.
  [[nodiscard]] static double least_of(PlyType type) {
    const bool is_signed =
        type == PlyType::Int8 || type == PlyType::Int16 || type == PlyType::Int32;
    return is_signed ? -std::ldexp(0.5, static_cast<int>(8 * size_of(type))) : 0;
  }
  [[nodiscard]] static double greatest_of(PlyType type) {
    if (type == PlyType::Float || type == PlyType::Double) {
      return std::ldexp(1.0, type == PlyType::Float ? 24 : 53);
    }
    return least_of(type) + std::ldexp(1.0, static_cast<int>(8 * size_of(type))) - 1;
  }

 private:
  PlyEncoding encoding_;
  std::string_view line_end_;
  std::string text_;
  bool is_in_line_ = false;
};

/// The numbers of one property of an element, the length of a list left out, and where all stands.
struct PropertyValues {
  std::vector<double> numbers;
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Numbers of points are the mesh's extras; those of faces are copied to all their parts.
class PlyDenseFile final : public DenseFile {
 public:
  explicit PlyDenseFile(const Model& model)
      : model_(model),
        scanner_(model.path(), model.bytes()),
        header_(read_ply_header(scanner_)),
        mesh_(plain_mesh(model)) {
    for_each_row([&](const PlyElement& element, std::span<const PropertyValues> row) {
      if (element.name == "vertex") {
        add_extras(element, row);
        end_of_points_ = row.back().end;
      }
    });
    for_each_face([&](std::size_t face, const PlyElement& element,
                      std::span<const PropertyValues> row) { add_textures(face, element, row); });
    mesh_.n_extras = mesh_.extras.size() / mesh_.points.size();
  }

  [[nodiscard]] DenseMesh mesh() const override { return mesh_; }

  [[nodiscard]] Model with(const DenseMesh& mesh, std::string path) const override {
    Splices splices;
    const FacePartition partition(mesh_, mesh);
    replace_counts(mesh, splices);
    splices.insert(end_of_point_lines(), points_text(mesh));
    for_each_face(
        [&](std::size_t face, const PlyElement& element, std::span<const PropertyValues> row) {
          if (!partition[face].is_whole) {
            splices.replace(row.front().begin, row.back().end,
                            faces_text(mesh, partition[face], element, row));
          }
        });
    const Model dense =
        parse_model(ModelFormat::Ply, std::move(path), splices.apply(model_.bytes()));
    std::vector<glm::dvec3> points(dense.points().begin(), dense.points().end());
    std::copy_n(mesh.points.begin(), model_.points().size(), points.begin());
    return deformed(dense, points, {});
  }

 private:
  /// visit(element, row) of every element with properties, in the file's order.
  template <class Visit>
  void for_each_row(const Visit& visit) const {
    PlyBody body(model_.path(), model_.bytes(), scanner_, header_.encoding);
    for (const PlyElement& element : header_.elements) {
      std::vector<PropertyValues> row(element.properties.size());
      for (std::int64_t i = 0; i < element.count && !row.empty(); ++i) {
        body.begin_element(element, i);
        for (std::size_t k = 0; k < row.size(); ++k) {
          read(body, element.properties[k], row[k]);
        }
        visit(element, row);
      }
    }
  }

  static void read(PlyBody& body, const PlyProperty& property, PropertyValues& values) {
    values.numbers.clear();
    std::size_t n = 1;
    values.begin = 0;
    const auto take = [&values](const BytePlace& place, bool is_first) {
      values.begin = is_first ? place.begin() : values.begin;
      values.end = place.begin() + place.length();
    };
    if (property.count_type) {
      const PlacedNumber length = body.next(*property.count_type, property.name);
      n = static_cast<std::size_t>(length.value);
      take(length.place, true);
    }
    for (std::size_t i = 0; i < n; ++i) {
      const PlacedNumber number = body.next(property.type, property.name);
      values.numbers.push_back(number.value);
      take(number.place, !property.count_type);
    }
  }

  /// The same of those that are faces to the model: visit(face, element, row).
  template <class Visit>
  void for_each_face(const Visit& visit) const {
    std::size_t face = 0;
    for_each_row([&](const PlyElement& element, std::span<const PropertyValues> row) {
      const auto corners = std::ranges::find_if(element.properties, is_corners);
      if (element.name != "face" || corners == element.properties.end()) {
        return;
      }
      const auto k = static_cast<std::size_t>(corners - element.properties.begin());
      if (row[k].numbers.size() >= 3) {
        visit(face++, element, row);
      }
    });
  }

  void add_extras(const PlyElement& element, std::span<const PropertyValues> row) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      if (!property.count_type && index_in(kAxes, property) == 3) {
        mesh_.extras.push_back(row[k].numbers[0]);
      }
    }
  }

  void add_textures(std::size_t face, const PlyElement& element,
                    std::span<const PropertyValues> row) {
    const std::span<DenseCorner> corners = mesh_.faces[face];
    for (std::size_t k = 0; k < row.size(); ++k) {
      const std::vector<double>& numbers = row[k].numbers;
      if (!is_corner_textures(element.properties[k]) || numbers.size() != 2 * corners.size()) {
        continue;
      }
      for (std::size_t i = 0; i < corners.size(); ++i) {
        corners[i].texture = static_cast<std::int32_t>(mesh_.textures.size());
        mesh_.textures.emplace_back(numbers[2 * i], numbers[2 * i + 1], 0);
      }
    }
  }

  void replace_counts(const DenseMesh& mesh, Splices& splices) const {
    for (const PlyElement& element : header_.elements) {
      const std::size_t n_more = element.name == "vertex" ? mesh.points.size() - mesh_.points.size()
                                 : element.name == "face"
                                     ? mesh.faces.n_rows() - mesh_.faces.n_rows()
                                     : 0;
      const auto begin =
          static_cast<std::size_t>(element.count_word.data() - model_.bytes().data());
      splices.replace(BytePlace(begin, element.count_word.size()),
                      std::to_string(static_cast<std::size_t>(element.count) + n_more));
    }
  }

  /// Where rows of more points go: in a text, before the end of the line of the last.
  [[nodiscard]] std::size_t end_of_point_lines() const {
    return header_.encoding == PlyEncoding::Text
               ? std::min(model_.bytes().find_first_of("\r\n", end_of_points_),
                          model_.bytes().size())
               : end_of_points_;
  }

  [[nodiscard]] std::string points_text(const DenseMesh& mesh) const {
    const auto vertex = std::ranges::find(header_.elements, "vertex", &PlyElement::name);
    PlyWriter writer(header_.encoding, line_end_);
    for (std::size_t i = mesh_.points.size(); i < mesh.points.size(); ++i) {
      writer.end_line();
      std::vector<double> extras(&mesh.extras[i * mesh.n_extras],
                                 &mesh.extras[i * mesh.n_extras] + mesh.n_extras);
      make_normal_unit(*vertex, extras);
      std::size_t extra = 0;
      for (const PlyProperty& property : vertex->properties) {
        if (property.count_type) {
          writer.write(*property.count_type, 0);
        } else if (const std::size_t axis = index_in(kAxes, property); axis < 3) {
          writer.write(property.type, mesh.points[i][static_cast<int>(axis)]);
        } else {
          writer.write(property.type, extras[extra++]);
        }
      }
    }
    return writer.text();
  }

  static void make_normal_unit(const PlyElement& vertex, std::span<double> extras) {
    std::array<double*, 3> at{};
    double* next = extras.data();
    for (const PlyProperty& property : vertex.properties) {
      if (!property.count_type && index_in(kAxes, property) == 3) {
        if (const std::size_t axis = index_in(kNormal, property); axis < 3) {
          at[axis] = next;
        }
        ++next;
      }
    }
    if (at[0] != nullptr && at[1] != nullptr && at[2] != nullptr) {
      const glm::dvec3 normal = unit_or_zero({*at[0], *at[1], *at[2]});
      for (std::size_t axis = 0; axis < 3; ++axis) {
        *at[axis] = normal[static_cast<int>(axis)];
      }
    }
  }

  [[nodiscard]] std::string faces_text(const DenseMesh& mesh, const FaceParts& parts,
                                       const PlyElement& element,
                                       std::span<const PropertyValues> row) const {
    PlyWriter writer(header_.encoding, line_end_);
    for (std::size_t face = parts.begin; face < parts.end; ++face) {
      if (face > parts.begin) {
        writer.end_line();
      }
      const std::span<const DenseCorner> corners = mesh.faces[face];
      for (std::size_t k = 0; k < row.size(); ++k) {
        const PlyProperty& property = element.properties[k];
        if (is_corners(property)) {
          write_corners(property, mesh, corners, writer);
        } else if (is_corner_textures(property) && corners[0].texture >= 0) {
          writer.write(*property.count_type, 2.0 * static_cast<double>(corners.size()));
          for (const DenseCorner& corner : corners) {
            const glm::dvec3& value = mesh.textures[static_cast<std::size_t>(corner.texture)];
            writer.write(property.type, value.x);
            writer.write(property.type, value.y);
          }
        } else {
          writer.write(model_.bytes().substr(row[k].begin, row[k].end - row[k].begin));
        }
      }
    }
    return writer.text();
  }

  void write_corners(const PlyProperty& property, const DenseMesh& mesh,
                     std::span<const DenseCorner> corners, PlyWriter& writer) const {
    if (static_cast<double>(mesh.points.size()) - 1 > PlyWriter::greatest_of(property.type)) {
      throw ParameterError(fmt::format(
          "densify: {} numbers points in a type that ends at {:.0f}, and {} are needed: give a "
          "larger length, or a file with int {}",
          model_.path(), PlyWriter::greatest_of(property.type), mesh.points.size(), property.name));
    }
    writer.write(*property.count_type, static_cast<double>(corners.size()));
    for (const DenseCorner& corner : corners) {
      writer.write(property.type, corner.point);
    }
  }

  Model model_;
  TextScanner scanner_;  // at the end of the header
  PlyHeader header_;
  std::string_view line_end_ = line_end_of(model_.bytes());
  DenseMesh mesh_;
  std::size_t end_of_points_ = 0;
};

}  // namespace

std::unique_ptr<DenseFile> dense_ply_file(const Model& model) {
  return std::make_unique<PlyDenseFile>(model);
}

}  // namespace espalier
