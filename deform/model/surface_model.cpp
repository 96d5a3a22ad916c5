#include "deform/model/surface_model.h"

#include <utility>

#include "deform/model/encoded_number.h"
#include "deform/model/model_file.h"
#include "lattice/core/error.h"
#include "lattice/osd/refine_surface.h"

namespace espalier {
Model make_obj_model(std::span<const glm::dvec3> points, const CompressedRows<std::int32_t>& faces,
                     std::string path) {
  std::string bytes;
  for (const glm::dvec3& point : points) {
    bytes += 'v';
    for (int axis = 0; axis < 3; ++axis) {
      bytes += ' ';
      bytes += EncodedNumber(point[axis], NumberEncoding::FloatText).view();
    }
    bytes += '\n';
  }
  for (std::size_t face = 0; face < faces.n_rows(); ++face) {
    bytes += 'f';
    for (const std::int32_t point : faces[face]) {
      bytes += ' ' + std::to_string(point + 1);
    }
    bytes += '\n';
  }
  return parse_model(ModelFormat::Obj, std::move(path), std::move(bytes));
}

Model refined_model(const Model& model, int levels, std::string path) {
  try {
    const osd::RefinedSurface surface = osd::refine_surface(model.points(), model.faces(), levels);
    return make_obj_model(surface.points, surface.faces, std::move(path));
  } catch (const ParameterError& error) {
    throw ParameterError(model.path() + ": " + error.what());
  }
}

}  // namespace espalier
