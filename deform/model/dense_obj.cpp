#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <span>
#include <utility>

#include "deform/model/deformed.h"
#include "deform/model/dense_file.h"
#include "deform/model/encoded_number.h"
#include "deform/model/model_file.h"
#include "deform/model/normals.h"
#include "deform/model/splices.h"
#include "lattice/core/error.h"
#include "lattice/core/text_scanner.h"

namespace espalier {
namespace {

constexpr std::size_t kMostExtras = 4;
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// The words of a statement that are references, and where they stand.
struct References {
  std::vector<DenseCorner> corners;
  std::size_t begin = 0;  // of the first word
  std::size_t end = 0;    // of the last
  bool is_relative = false;
};

/// What of an OBJ file a mesh is made of. The file is one that parse_obj() took.
class ObjParts {
 public:
  explicit ObjParts(const Model& model)
      : model_(model),
        scanner_(model.path(),
                 model.bytes().substr(model.bytes().starts_with(kByteOrderMark) ? 3 : 0),
                 {.comment = '#', .joins_lines = true}) {
    while (scanner_.next_line()) {
      read(scanner_.next_word());
    }
    if (has_equal_extras()) {
      mesh_.n_extras = n_extras_.front();
    } else {
      mesh_.extras.clear();
    }
    mesh_.points.assign(model.points().begin(), model.points().end());
    mesh_.normals.assign(model.normals().begin(), model.normals().end());
    for (std::size_t face = 0; face < faces_.size(); ++face) {
      mesh_.faces.push_back(faces_[face].corners);
      mesh_.parents.push_back(static_cast<std::int32_t>(face));
    }
  }

  [[nodiscard]] const DenseMesh& mesh() const { return mesh_; }
  [[nodiscard]] std::span<const References> faces() const { return faces_; }
  [[nodiscard]] std::span<const References> others() const { return others_; }
  /// Components of texture coordinates.
  [[nodiscard]] int texture_size() const { return texture_size_; }
  /// Of each kind of element, how many stand before the first face.
  [[nodiscard]] const std::array<std::size_t, 3>& counts_before() const { return counts_before_; }

 private:
  void read(std::string_view keyword) {
    if (keyword == "v") {
      read_point();
    } else if (keyword == "vt") {
      read_texture();
    } else if (keyword == "vn") {
      ++n_normals_;
    } else if (keyword == "f" || keyword == "fo") {
      if (faces_.empty()) {
        counts_before_ = {n_extras_.size(), mesh_.textures.size(), n_normals_};
      }
      faces_.push_back(read_references());
    } else if (keyword == "l" || keyword == "p") {
      others_.push_back(read_references());
    } else if (keyword == "curv" || keyword == "curv2" || keyword == "surf" || keyword == "vp") {
      throw ParameterError(fmt::format(
          "densify: {} has free-form curves or surfaces (line {}), only polygons are refined",
          model_.path(), scanner_.line_number()));
    }
  }

  void read_point() {
    for (int axis = 0; axis < 3; ++axis) {
      (void)scanner_.next_word();
    }
    std::size_t n = 0;
    double number = 0;
    while (n < kMostExtras && parse_number(scanner_.next_word(), number)) {
      mesh_.extras.push_back(number);
      ++n;
    }
    n_extras_.push_back(n);
  }

  void read_texture() {
    glm::dvec3 value(0);
    int n = 0;
    while (n < 3 && parse_number(scanner_.next_word(), value[n])) {
      ++n;
    }
    texture_size_ = std::max(texture_size_, n);
    mesh_.textures.push_back(value);
  }

  References read_references() {
    References result;
    for (auto word = scanner_.next_word(); !word.empty(); word = scanner_.next_word()) {
      const auto at = static_cast<std::size_t>(word.data() - model_.bytes().data());
      result.begin = result.corners.empty() ? at : result.begin;
      result.end = at + word.size();
      result.is_relative |= word.find('-') != std::string_view::npos;
      result.corners.push_back(corner_of(word));
    }
    return result;
  }

  [[nodiscard]] DenseCorner corner_of(std::string_view word) const {
    const std::array<std::size_t, 3> counts = {n_extras_.size(), mesh_.textures.size(), n_normals_};
    std::array<std::int32_t, 3> numbers = {-1, -1, -1};
    for (std::size_t kind = 0; kind < 3; ++kind) {
      const std::string_view number = word.substr(0, word.find('/'));
      word.remove_prefix(std::min(number.size() + 1, word.size()));
      std::int64_t value = 0;
      if (parse_integer(number, value)) {
        value = value < 0 ? static_cast<std::int64_t>(counts[kind]) + value : value - 1;
        numbers[kind] = static_cast<std::int32_t>(value);
      }
    }
    return {numbers[0], numbers[1], numbers[2]};
  }

  [[nodiscard]] bool has_equal_extras() const {
    return std::ranges::all_of(n_extras_, [&](std::size_t n) { return n == n_extras_.front(); });
  }

  const Model& model_;
  TextScanner scanner_;
  DenseMesh mesh_;
  std::vector<std::size_t> n_extras_;  // of each point
  std::size_t n_normals_ = 0;
  int texture_size_ = 0;
  std::array<std::size_t, 3> counts_before_{};
  std::vector<References> faces_;
  std::vector<References> others_;
};

/// References to textures or normals that the file has not at all: left alone by readers.
void drop_dangling(DenseMesh& mesh) {
  for (std::size_t face = 0; face < mesh.faces.n_rows(); ++face) {
    for (DenseCorner& corner : mesh.faces[face]) {
      corner.texture =
          corner.texture < static_cast<std::int32_t>(mesh.textures.size()) ? corner.texture : -1;
      corner.normal =
          corner.normal < static_cast<std::int32_t>(mesh.normals.size()) ? corner.normal : -1;
    }
  }
}

/// Writes the denser mesh into the file of the model.
class DenseWriter {
 public:
  DenseWriter(const Model& model, const ObjParts& parts, const DenseMesh& mesh)
      : model_(model), parts_(parts), mesh_(mesh) {
    const std::array<std::size_t, 3> old = {
        parts.mesh().points.size(), parts.mesh().textures.size(), parts.mesh().normals.size()};
    const std::array<std::size_t, 3> all = {mesh.points.size(), mesh.textures.size(),
                                            mesh.normals.size()};
    for (std::size_t kind = 0; kind < 3; ++kind) {
      n_old_[kind] = old[kind];
      n_new_[kind] = all[kind] - old[kind];
    }
  }

  [[nodiscard]] std::string write() {
    add_elements();
    const FacePartition partition(parts_.mesh(), mesh_);
    for (std::size_t face = 0; face < parts_.faces().size(); ++face) {
      replace_face(parts_.faces()[face], partition[face]);
    }
    for (const References& other : parts_.others()) {
      if (must_renumber(other)) {
        splices_.replace(other.begin, other.end, text_of(other.corners));
      }
    }
    return splices_.apply(model_.bytes());
  }

 private:
  void add_elements() {
    std::string lines;
    const auto add = [&](std::string_view keyword, const glm::dvec3& value, int size) {
      lines += keyword;
      for (int k = 0; k < size; ++k) {
        append(lines, value[k]);
      }
    };
    for (std::size_t i = n_old_[0]; i < mesh_.points.size(); ++i) {
      add("v", mesh_.points[i], 3);
      for (std::size_t k = 0; k < mesh_.n_extras; ++k) {
        append(lines, mesh_.extras[i * mesh_.n_extras + k]);
      }
      lines += model_.layout().line_end;
    }
    for (std::size_t i = n_old_[1]; i < mesh_.textures.size(); ++i) {
      add("vt", mesh_.textures[i], parts_.texture_size());
      lines += model_.layout().line_end;
    }
    for (std::size_t i = n_old_[2]; i < mesh_.normals.size(); ++i) {
      add("vn", mesh_.normals[i], 3);
      lines += model_.layout().line_end;
    }
    splices_.insert(model_.layout().first_face, lines);
  }

  void append(std::string& text, double number) const {
    text += ' ';
    text += EncodedNumber(number, model_.layout().encoding).view();
  }

  /// The number, from 1, of an element in the new file.
  [[nodiscard]] std::size_t number(std::size_t kind, std::int32_t index) const {
    const auto i = static_cast<std::size_t>(index);
    const std::size_t before = parts_.counts_before()[kind];
    if (i < before) {
      return i + 1;
    }
    return i < n_old_[kind] ? i + n_new_[kind] + 1 : i - n_old_[kind] + before + 1;
  }

  [[nodiscard]] bool must_renumber(const References& references) const {
    if (references.is_relative) {
      return true;
    }
    return std::ranges::any_of(references.corners, [&](const DenseCorner& corner) {
      const std::array<std::int32_t, 3> indices = {corner.point, corner.texture, corner.normal};
      for (std::size_t kind = 0; kind < 3; ++kind) {
        if (indices[kind] >= 0 && n_new_[kind] > 0 &&
            static_cast<std::size_t>(indices[kind]) >= parts_.counts_before()[kind]) {
          return true;
        }
      }
      return false;
    });
  }

  [[nodiscard]] std::string text_of(std::span<const DenseCorner> corners) const {
    std::string text;
    for (const DenseCorner& corner : corners) {
      text += text.empty() ? "" : " ";
      text += std::to_string(number(0, corner.point));
      if (corner.texture >= 0) {
        text += '/' + std::to_string(number(1, corner.texture));
      }
      if (corner.normal >= 0) {
        text += corner.texture >= 0 ? "/" : "//";
        text += std::to_string(number(2, corner.normal));
      }
    }
    return text;
  }

  void replace_face(const References& face, const FaceParts& parts) {
    if (parts.is_whole && !must_renumber(face)) {
      return;
    }
    std::string text;
    for (std::size_t child = parts.begin; child < parts.end; ++child) {
      text += child == parts.begin ? "" : std::string(model_.layout().line_end) + "f ";
      text += text_of(mesh_.faces[child]);
    }
    splices_.replace(face.begin, face.end, text);
  }

  const Model& model_;
  const ObjParts& parts_;
  const DenseMesh& mesh_;
  std::array<std::size_t, 3> n_old_{};  // points, texture coordinates, normals
  std::array<std::size_t, 3> n_new_{};
  Splices splices_;
};

class ObjDenseFile final : public DenseFile {
 public:
  explicit ObjDenseFile(const Model& model) : model_(model), parts_(model) {}

  [[nodiscard]] DenseMesh mesh() const override {
    DenseMesh mesh = parts_.mesh();
    drop_dangling(mesh);
    return mesh;
  }

  [[nodiscard]] Model with(const DenseMesh& mesh, std::string path) const override {
    const Model dense =
        parse_model(ModelFormat::Obj, std::move(path), DenseWriter(model_, parts_, mesh).write());
    std::vector<glm::dvec3> points(dense.points().begin(), dense.points().end());
    const std::size_t n_before = parts_.counts_before()[0];
    const std::size_t n_new = mesh.points.size() - model_.points().size();
    for (std::size_t i = 0; i < model_.points().size(); ++i) {
      points[i < n_before ? i : i + n_new] = mesh.points[i];
    }
    return deformed(dense, points, {});
  }

 private:
  Model model_;
  ObjParts parts_;
};

}  // namespace

std::unique_ptr<DenseFile> dense_obj_file(const Model& model) {
  return std::make_unique<ObjDenseFile>(model);
}

}  // namespace espalier
