/// Geomview manual, "OFF: Object File Format".

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
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
#include "deform/model/splices.h"
#include "lattice/core/text_scanner.h"

namespace espalier {
namespace {

constexpr std::size_t kMostExtras = 16;

/// Where a face's corners stand, from their number on, and the words after them: its colour.
struct FaceLine {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::string rest;
};

/// Numbers after a point's coordinates are its normal, colour and texture coordinates; new points
/// get those that all have.
class OffDenseFile final : public DenseFile {
 public:
  explicit OffDenseFile(const Model& model)
      : model_(model), scanner_(model.path(), model.bytes(), {.comment = '#'}) {
    n_normal_ = model.normals().empty() ? 0 : 3;
    read_counts();
    for (std::size_t i = 0; i < model.points().size(); ++i) {
      (void)next_filled_line();
      read_point();
      ++n_points_read_;
    }
    const std::string_view last = scanner_.line();
    end_of_points_ = place(last) + last.size();
    for (std::size_t face = 0; face < model.faces().n_rows();) {
      face += read_face(next_filled_line()) ? 1 : 0;
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
    splices.insert(end_of_points_, point_lines(mesh));
    const FacePartition partition(this->mesh(), mesh);
    for (std::size_t face = 0; face < faces_.size(); ++face) {
      if (!partition[face].is_whole) {
        splices.replace(faces_[face].begin, faces_[face].end,
                        face_lines(mesh, partition[face], faces_[face].rest));
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

  /// The first word of the next line that has one.
  std::string_view next_filled_line() {
    std::string_view word;
    while (word.empty() && scanner_.next_line()) {
      word = scanner_.next_word();
    }
    return word;
  }

  /// Points and faces come after the keyword, on any line; edges on the same as faces, or not.
  void read_counts() {
    std::string_view word = next_filled_line();
    for (std::string_view& count : counts_) {
      word = scanner_.next_word();
      count = word.empty() && &count != &counts_.back() ? next_filled_line() : word;
    }
  }

  /// Its line's first word is taken.
  void read_point() {
    for (int axis = 1; axis < 3; ++axis) {
      (void)scanner_.next_word();
    }
    std::size_t n = 0;
    double number = 0;
    while (n < n_extras_ && parse_number(scanner_.next_word(), number) && std::isfinite(number)) {
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

  /// Whether it is a face to the model, of three corners or more.
  bool read_face(std::string_view word) {
    FaceLine line{place(word), place(word) + word.size(), ""};
    std::int64_t n_corners = 0;
    if (!parse_integer(word, n_corners) || n_corners < 3) {
      return false;
    }
    for (std::int64_t i = 0; i < n_corners; ++i) {
      const std::string_view corner = scanner_.next_word();
      line.end = place(corner) + corner.size();
    }
    for (word = scanner_.next_word(); !word.empty(); word = scanner_.next_word()) {
      line.rest += ' ';
      line.rest += word;
    }
    faces_.push_back(std::move(line));
    return true;
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
    const std::size_t n_faces = mesh.faces.n_rows() - faces_.size();
    const auto replace = [&](std::string_view word, std::size_t count) {
      splices.replace(BytePlace(place(word), word.size()), std::to_string(count));
    };
    std::int64_t old_faces = 0;
    std::int64_t n_edges = 0;
    (void)parse_integer(counts_[1], old_faces);  // those of two corners, too
    replace(counts_[0], mesh.points.size());
    replace(counts_[1], static_cast<std::size_t>(old_faces) + n_faces);
    if (parse_integer(counts_[2], n_edges) && n_edges != 0) {
      replace(counts_[2], MeshEdges(mesh).n_edges());
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
      std::vector<double> extras(&mesh.extras[i * n_extras_],
                                 &mesh.extras[i * n_extras_] + n_extras_);
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
  TextScanner scanner_;
  std::string_view line_end_ = line_end_of(model_.bytes());
  std::array<std::string_view, 3> counts_;  // of points, faces and edges, as they stand there
  std::size_t n_points_read_ = 0;
  std::size_t n_extras_ = kMostExtras;
  std::size_t n_normal_ = 0;  // of the extras
  std::vector<double> extras_;
  std::vector<bool> is_whole_;  // #extras
  std::size_t end_of_points_ = 0;
  std::vector<FaceLine> faces_;
};

}  // namespace

std::unique_ptr<DenseFile> dense_off_file(const Model& model) {
  return std::make_unique<OffDenseFile>(model);
}

}  // namespace espalier
