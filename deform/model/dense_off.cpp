/// Geomview manual, "OFF: Object File Format".

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deform/model/deformed.h"
#include "deform/model/dense_file.h"
#include "deform/model/encoded_number.h"
#include "deform/model/mesh_edges.h"
#include "deform/model/model_file.h"
#include "deform/model/normals.h"
#include "deform/model/off_rows.h"
#include "deform/model/splices.h"
#include "lattice/core/text_scanner.h"

namespace espalier {
namespace {

constexpr std::size_t kMostExtras = 16;

/// Numbers after a point's coordinates are its normal, colour and texture coordinates; new points
/// get those that all have.
class OffDenseFile final : public DenseFile {
 public:
  explicit OffDenseFile(const Model& model)
      : model_(model), rows_(off_rows(model_)), n_normal_(model.normals().empty() ? 0 : 3) {
    for (const OffPointRow& row : rows_.points) {
      read_extras(row);
      ++n_points_read_;
    }
    find_whole_columns();
  }

  [[nodiscard]] DenseMesh mesh() const override {
    DenseMesh mesh = plain_mesh(model_);
    mesh.n_extras = n_extras_;
    mesh.extras = extras_;
    return mesh;
  }

  [[nodiscard]] Model with(const DenseMesh& mesh, std::string path) const override {
    Splices splices;
    replace_counts(mesh, splices);
    splices.insert(rows_.end_of_points, point_lines(mesh));
    const FacePartition partition(this->mesh(), mesh);
    for (std::size_t face = 0; face < rows_.faces.size(); ++face) {
      const OffFaceRow& row = rows_.faces[face];
      if (!partition[face].is_whole) {
        splices.replace(row.begin, row.end, face_lines(mesh, partition[face], row.rest));
      }
    }
    const Model dense =
        parse_model(ModelFormat::Off, std::move(path), splices.apply(model_.bytes()));
    std::vector<glm::dvec3> points(dense.points().begin(), dense.points().end());
    std::copy_n(mesh.points.begin(), model_.points().size(), points.begin());
    return deformed(dense, points, {});
  }

 private:
  [[nodiscard]] std::size_t place(std::string_view word) const {
    return static_cast<std::size_t>(word.data() - model_.bytes().data());
  }

  void read_extras(const OffPointRow& row) {
    const BytePlace& last = model_.layout().point_places[n_points_read_].axis[2];
    const std::size_t begin = last.begin() + last.length();
    TextScanner scanner(model_.path(), model_.bytes().substr(begin, row.end - begin));
    (void)scanner.next_line();
    std::size_t n = 0;
    double number = 0;
    while (n < n_extras_ && parse_number(scanner.next_word(), number) && std::isfinite(number)) {
      extras_.push_back(number);
      ++n;
    }
    keep_extras(n);
  }

  /// Only the first n of all points; the one just read has no more.
  void keep_extras(std::size_t n) {
    const std::size_t before = std::exchange(n_extras_, n);
    const std::size_t n_kept = n == before ? extras_.size() : (n_points_read_ + 1) * n;
    for (std::size_t i = 0; n != before && i < n_kept; ++i) {
      extras_[i] = extras_[i / n * before + i % n];
    }
    extras_.resize(n_kept);
  }

  /// Colours from 0 to 255 stay whole numbers.
  void find_whole_columns() {
    is_whole_.assign(n_extras_, true);
    std::vector<double> most(n_extras_ + 1, 0.0);
    for (std::size_t i = 0; i < extras_.size(); ++i) {
      const std::size_t k = i % n_extras_;
      is_whole_[k] = is_whole_[k] && extras_[i] == std::floor(extras_[i]) && extras_[i] >= 0;
      most[k] = k < n_normal_ ? 0 : std::max(most[k], extras_[i]);
    }
    for (std::size_t k = 0; k < n_extras_; ++k) {
      is_whole_[k] = is_whole_[k] && k >= n_normal_ && *std::ranges::max_element(most) > 1;
    }
  }

  void replace_counts(const DenseMesh& mesh, Splices& splices) const {
    const std::size_t n_faces = mesh.faces.n_rows() - rows_.faces.size();
    const auto replace = [&](std::string_view word, std::size_t count) {
      splices.replace(BytePlace(place(word), word.size()), std::to_string(count));
    };
    std::int64_t old_faces = 0;
    std::int64_t n_edges = 0;
    (void)parse_integer(rows_.counts[1], old_faces);  // those of two corners, too
    replace(rows_.counts[0], mesh.points.size());
    replace(rows_.counts[1], static_cast<std::size_t>(old_faces) + n_faces);
    if (parse_integer(rows_.counts[2], n_edges) && n_edges != 0) {
      replace(rows_.counts[2], MeshEdges(mesh).n_edges());
    }
  }

  [[nodiscard]] std::string point_lines(const DenseMesh& mesh) const {
    std::string text;
    for (std::size_t i = model_.points().size(); i < mesh.points.size(); ++i) {
      const auto append = [&text](double number, NumberEncoding encoding) {
        text += text.ends_with('\n') || text.ends_with('\r') ? "" : " ";
        text += EncodedNumber(number, encoding).view();
      };
      text += line_end_;
      for (int axis = 0; axis < 3; ++axis) {
        append(mesh.points[i][axis], model_.layout().encoding);
      }
      const auto of_point = std::span(mesh.extras).subspan(i * n_extras_, n_extras_);
      std::vector<double> extras(of_point.begin(), of_point.end());
      if (n_normal_ > 0) {
        const glm::dvec3 normal = unit_or_zero({extras[0], extras[1], extras[2]});
        std::copy_n(&normal.x, 3, extras.begin());
      }
      for (std::size_t k = 0; k < n_extras_; ++k) {
        append(is_whole_[k] ? std::round(extras[k]) : extras[k], NumberEncoding::FloatText);
      }
    }
    return text;
  }

  [[nodiscard]] std::string face_lines(const DenseMesh& mesh, const FaceParts& parts,
                                       const std::string& rest) const {
    std::string text;
    for (std::size_t child = parts.begin; child < parts.end; ++child) {
      text += child == parts.begin ? "" : rest + std::string(line_end_);
      text += std::to_string(mesh.faces[child].size());
      for (const DenseCorner& corner : mesh.faces[child]) {
        text += ' ' + std::to_string(corner.point);
      }
    }
    return text;
  }

  Model model_;
  OffRows rows_;
  std::string_view line_end_ = line_end_of(model_.bytes());
  std::size_t n_points_read_ = 0;
  std::size_t n_extras_ = kMostExtras;
  std::size_t n_normal_;  // of the extras
  std::vector<double> extras_;
  std::vector<bool> is_whole_;  // #extras
};

}  // namespace

std::unique_ptr<DenseFile> dense_off_file(const Model& model) {
  return std::make_unique<OffDenseFile>(model);
}

}  // namespace espalier
