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
#include "deform/model/model_file.h"
#include "deform/model/normals.h"
#include "deform/model/ply_rows.h"
#include "deform/model/splices.h"
#include "lattice/core/error.h"

namespace espalier {
namespace {

constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};
constexpr std::array<std::string_view, 3> kNormal = {"nx", "ny", "nz"};

std::size_t index_in(const std::array<std::string_view, 3>& names, const PlyProperty& property) {
  return property.count_type
             ? 3
             : static_cast<std::size_t>(std::ranges::find(names, property.name) - names.begin());
}

/// Texture coordinates of all corners, as MeshLab writes them.
bool is_corner_textures(const PlyProperty& property) {
  return property.count_type && property.name == "texcoord";
}

/// Numbers of points are the mesh's extras; those of faces are copied to all their parts.
class PlyDenseFile final : public DenseFile {
 public:
  explicit PlyDenseFile(const Model& model)
      : model_(model), rows_(model_), mesh_(plain_mesh(model)) {
    rows_.for_each([&](const PlyElement& element, PlyRows::Row row) {
      if (element.name == "vertex") {
        add_extras(element, row);
        end_of_points_ = row.back().end;
      }
    });
    rows_.for_each_face([&](std::size_t face, const PlyElement& element, PlyRows::Row row) {
      add_textures(face, element, row);
    });
    mesh_.n_extras = mesh_.extras.size() / mesh_.points.size();
  }

  [[nodiscard]] DenseMesh mesh() const override { return mesh_; }

  [[nodiscard]] Model with(const DenseMesh& mesh, std::string path) const override {
    Splices splices;
    const FacePartition partition(mesh_, mesh);
    rows_.replace_count("vertex", mesh.points.size() - mesh_.points.size(), splices);
    rows_.replace_count("face", mesh.faces.n_rows() - mesh_.faces.n_rows(), splices);
    splices.insert(rows_.end_of_line(end_of_points_), points_text(mesh));
    rows_.for_each_face([&](std::size_t face, const PlyElement& element, PlyRows::Row row) {
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
  void add_extras(const PlyElement& element, PlyRows::Row row) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      if (!property.count_type && index_in(kAxes, property) == 3) {
        mesh_.extras.push_back(row[k].numbers[0]);
      }
    }
  }

  void add_textures(std::size_t face, const PlyElement& element, PlyRows::Row row) {
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

  [[nodiscard]] std::string points_text(const DenseMesh& mesh) const {
    PlyWriter writer(rows_.header().encoding, line_end_);
    for (std::size_t i = mesh_.points.size(); i < mesh.points.size(); ++i) {
      writer.end_line();
      const auto of_point = std::span(mesh.extras).subspan(i * mesh.n_extras, mesh.n_extras);
      std::vector<double> extras(of_point.begin(), of_point.end());
      make_normal_unit(rows_.vertex(), extras);
      std::size_t extra = 0;
      for (const PlyProperty& property : rows_.vertex().properties) {
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
                                       const PlyElement& element, PlyRows::Row row) const {
    PlyWriter writer(rows_.header().encoding, line_end_);
    for (std::size_t face = parts.begin; face < parts.end; ++face) {
      if (face > parts.begin) {
        writer.end_line();
      }
      const std::span<const DenseCorner> corners = mesh.faces[face];
      for (std::size_t k = 0; k < row.size(); ++k) {
        const PlyProperty& property = element.properties[k];
        if (is_ply_corners(property)) {
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
    rows_.require_room(property, mesh.points.size(), "densify", "give a larger length");
    writer.write(*property.count_type, static_cast<double>(corners.size()));
    for (const DenseCorner& corner : corners) {
      writer.write(property.type, corner.point);
    }
  }

  Model model_;
  PlyRows rows_;
  std::string_view line_end_ = line_end_of(model_.bytes());
  DenseMesh mesh_;
  std::size_t end_of_points_ = 0;
};

}  // namespace

std::unique_ptr<DenseFile> dense_ply_file(const Model& model) {
  return std::make_unique<PlyDenseFile>(model);
}

}  // namespace espalier
