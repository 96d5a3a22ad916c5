#pragma once

/// Models' files as meshes to be made denser, and back.

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "deform/model/dense_mesh.h"
#include "deform/model/model.h"

namespace espalier {

/// A model's file, and what of it a mesh is made of.
class DenseFile {
 public:
  DenseFile() = default;
  DenseFile(const DenseFile&) = delete;
  DenseFile& operator=(const DenseFile&) = delete;
  virtual ~DenseFile() = default;

  /// With all that the file says of points and corners.
  [[nodiscard]] virtual DenseMesh mesh() const = 0;
  /// The file with the parts of each face in its place. mesh: what densified() made of mesh().
  [[nodiscard]] virtual Model with(const DenseMesh& mesh, std::string path) const = 0;
};

/// Of a model of each format. The first throws ParameterError for an OBJ file with free-form curves
/// or surfaces, the third for a PLY file without room for more points in the type of its indices.
[[nodiscard]] std::unique_ptr<DenseFile> dense_obj_file(const Model& model);
[[nodiscard]] std::unique_ptr<DenseFile> dense_off_file(const Model& model);
[[nodiscard]] std::unique_ptr<DenseFile> dense_ply_file(const Model& model);
[[nodiscard]] std::unique_ptr<DenseFile> dense_stl_file(const Model& model);

/// The faces [begin, end) of a denser mesh that one of the original became.
struct FaceParts {
  std::size_t begin = 0;
  std::size_t end = 0;
  bool is_whole = false;  ///< it is as it was
};

/// What all faces of a mesh became.
class FacePartition {
 public:
  FacePartition(const DenseMesh& before, const DenseMesh& after);
  [[nodiscard]] const FaceParts& operator[](std::size_t face) const { return parts_[face]; }

 private:
  std::vector<FaceParts> parts_;
};

/// Points, faces and their corners as the model has them, without further numbers.
[[nodiscard]] DenseMesh plain_mesh(const Model& model);

/// What ends the first line of a text: "\n", "\r\n" or "\r".
[[nodiscard]] std::string_view line_end_of(std::string_view text);

}  // namespace espalier
