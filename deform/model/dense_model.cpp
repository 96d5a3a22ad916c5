#include "deform/model/dense_model.h"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "deform/model/dense_file.h"
#include "lattice/core/error.h"

namespace espalier {
namespace {

std::unique_ptr<DenseFile> dense_file(const Model& model) {
  switch (model.format()) {
    case ModelFormat::Off:
      return dense_off_file(model);
    case ModelFormat::Ply:
      return dense_ply_file(model);
    case ModelFormat::Stl:
      return dense_stl_file(model);
    default:
      return dense_obj_file(model);
  }
}

}  // namespace

Model dense_model(const Model& model, DensifyMethod method, double longest, std::string path,
                  const Progress& progress) {
  if (model.faces().empty()) {
    throw ParameterError(fmt::format("densify: {} has no faces", model.path()));
  }
  const std::unique_ptr<DenseFile> file = dense_file(model);
  const DenseMesh mesh = densified(file->mesh(), method, longest, progress);
  if (mesh.points.size() == model.points().size() &&
      mesh.faces.n_rows() == model.faces().n_rows()) {
    return model;
  }
  return file->with(mesh, std::move(path));
}

}  // namespace espalier
