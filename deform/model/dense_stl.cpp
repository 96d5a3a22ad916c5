/// 3D Systems, "Stereolithography interface specification", 1988.

#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deform/model/dense_file.h"
#include "deform/model/encoded_number.h"
#include "deform/model/model_file.h"
#include "deform/model/normals.h"
#include "deform/model/splices.h"

namespace espalier {
namespace {

constexpr std::size_t kCountPlace = 80;  // in a binary file
constexpr std::size_t kFacetSize = 50;

using Triangle = std::array<std::int32_t, 3>;

/// Facets are copies of the one that they are parts of, with other numbers.
class StlDenseFile final : public DenseFile {
 public:
  explicit StlDenseFile(const Model& model) : model_(model) {}

  [[nodiscard]] DenseMesh mesh() const override { return plain_mesh(model_); }

  [[nodiscard]] Model with(const DenseMesh& mesh, std::string path) const override {
    Splices splices;
    const FacePartition partition(plain_mesh(model_), mesh);
    std::size_t n_facets = 0;
    for (std::size_t facet = 0; facet < model_.faces().n_rows(); ++facet) {
      const std::vector<Triangle> triangles = triangles_of(mesh, partition[facet]);
      n_facets += triangles.size();
      if (!partition[facet].is_whole || is_moved(mesh, facet)) {
        splices.replace(begin_of(facet), end_of(facet), text_of(mesh, facet, triangles));
      }
    }
    if (is_binary()) {
      std::string count;
      for (int byte = 0; byte < 4; ++byte) {
        count += static_cast<char>(n_facets >> (8 * byte) & 0xFF);
      }
      splices.replace(BytePlace(kCountPlace, count.size()), count);
    }
    return parse_model(ModelFormat::Stl, std::move(path), splices.apply(model_.bytes()));
  }

 private:
  [[nodiscard]] bool is_binary() const { return encoded_size(model_.layout().encoding) > 0; }

  /// Quadrilaterals are cut along the shorter diagonal.
  [[nodiscard]] static std::vector<Triangle> triangles_of(const DenseMesh& mesh,
                                                          const FaceParts& parts) {
    std::vector<Triangle> triangles;
    for (std::size_t face = parts.begin; face < parts.end; ++face) {
      const auto corner = [&](std::size_t i) { return mesh.faces[face][i].point; };
      const auto distance = [&](std::size_t i, std::size_t k) {
        return glm::distance(mesh.points[static_cast<std::size_t>(corner(i))],
                             mesh.points[static_cast<std::size_t>(corner(k))]);
      };
      if (mesh.faces[face].size() == 3) {
        triangles.push_back({corner(0), corner(1), corner(2)});
      } else if (distance(0, 2) <= distance(1, 3)) {
        triangles.push_back({corner(0), corner(1), corner(2)});
        triangles.push_back({corner(0), corner(2), corner(3)});
      } else {
        triangles.push_back({corner(0), corner(1), corner(3)});
        triangles.push_back({corner(1), corner(2), corner(3)});
      }
    }
    return triangles;
  }

  [[nodiscard]] bool is_moved(const DenseMesh& mesh, std::size_t facet) const {
    for (const std::int32_t point : model_.faces()[facet]) {
      const auto i = static_cast<std::size_t>(point);
      if (mesh.points[i] != model_.points()[i]) {
        return true;
      }
    }
    return false;
  }

  [[nodiscard]] std::size_t begin_of(std::size_t facet) const {
    const std::size_t normal = model_.layout().facet_places[facet].axis[0].begin();
    return is_binary() ? normal : model_.bytes().rfind("facet", normal);
  }
  [[nodiscard]] std::size_t end_of(std::size_t facet) const {
    constexpr std::string_view kEnd = "endfacet";
    const std::size_t last = model_.layout().point_places[3 * facet + 2].axis[2].begin();
    return is_binary() ? begin_of(facet) + kFacetSize
                       : model_.bytes().find(kEnd, last) + kEnd.size();
  }

  /// What stands between two facets of a text: a line's end, and the space before this one.
  [[nodiscard]] std::string gap_before(std::size_t facet) const {
    if (is_binary()) {
      return "";
    }
    const std::size_t begin = begin_of(facet);
    const std::size_t line = model_.bytes().find_last_of("\r\n", begin) + 1;
    return std::string(line_end_of(model_.bytes())) +
           std::string(model_.bytes().substr(line, begin - line));
  }

  [[nodiscard]] std::string text_of(const DenseMesh& mesh, std::size_t facet,
                                    const std::vector<Triangle>& triangles) const {
    std::string text;
    for (const Triangle& triangle : triangles) {
      text += text.empty() ? "" : gap_before(facet);
      text += text_of(mesh, facet, triangle);
    }
    return text;
  }

  [[nodiscard]] std::string text_of(const DenseMesh& mesh, std::size_t facet,
                                    const Triangle& triangle) const {
    const ModelLayout& layout = model_.layout();
    const std::size_t begin = begin_of(facet);
    Splices splices;
    const auto replace = [&](const CoordinatePlaces& places, const glm::dvec3& numbers) {
      for (int axis = 0; axis < 3; ++axis) {
        const BytePlace& place = places.axis[axis];
        splices.replace(BytePlace(place.begin() - begin, place.length()),
                        EncodedNumber(numbers[axis], layout.encoding).view());
      }
    };
    replace_normal(mesh, facet, triangle, replace);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const CoordinatePlaces& to = layout.point_places[3 * facet + corner];
      const auto point = static_cast<std::size_t>(triangle[corner]);
      const std::optional<std::size_t> from = unmoved_corner(mesh, facet, point);
      for (int axis = 0; from && axis < 3; ++axis) {
        // The digits that the facets around have.
        const BytePlace& same = layout.point_places[3 * facet + *from].axis[axis];
        splices.replace(BytePlace(to.axis[axis].begin() - begin, to.axis[axis].length()),
                        model_.bytes().substr(same.begin(), same.length()));
      }
      if (!from) {
        replace(to, mesh.points[point]);
      }
    }
    return splices.apply(model_.bytes().substr(begin, end_of(facet) - begin));
  }

  /// That of the triangle where a smooth method turned it; none stays none.
  template <class Replace>
  void replace_normal(const DenseMesh& mesh, std::size_t facet, const Triangle& triangle,
                      const Replace& replace) const {
    std::array<glm::dvec3, 3> p;
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = mesh.points[static_cast<std::size_t>(triangle[i])];
    }
    const glm::dvec3 normal = unit_or_zero(glm::cross(p[1] - p[0], p[2] - p[0]));
    const glm::dvec3& old = model_.layout().facet_normals[facet];
    constexpr double kSame = 1e-6;
    if (old != glm::dvec3(0) && normal != glm::dvec3(0) &&
        glm::distance(unit_or_zero(old), normal) > kSame && is_moved(mesh, facet)) {
      replace(model_.layout().facet_places[facet], normal);
    }
  }

  /// The corner of the facet, of those that stayed, that is this point.
  [[nodiscard]] std::optional<std::size_t> unmoved_corner(const DenseMesh& mesh, std::size_t facet,
                                                          std::size_t point) const {
    const auto corners = model_.faces()[facet];
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (static_cast<std::size_t>(corners[i]) == point &&
          mesh.points[point] == model_.points()[point]) {
        return i;
      }
    }
    return std::nullopt;
  }

  Model model_;
};

}  // namespace

std::unique_ptr<DenseFile> dense_stl_file(const Model& model) {
  return std::make_unique<StlDenseFile>(model);
}

}  // namespace espalier
