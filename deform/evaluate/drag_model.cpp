#include "deform/evaluate/drag_model.h"

#include <string>

#include "deform/evaluate/displace.h"
#include "lattice/core/error.h"
#include "lattice/core/parallel.h"

namespace espalier {

DragStart drag_start(const DragModel& model) {
  const Influence everything;
  const Influence& influence = model.influence == nullptr ? everything : *model.influence;
  DragStart start;
  start.points = combined_points(model.rest_points, model.motions, influence);
  if (model.needs_gradients()) {
    start.gradients = combined_gradients(model.rest_points.size(), model.motions, influence);
  }
  return start;
}

DragField drag_field(const DragModel& model, std::span<const glm::dvec3> vectors) {
  const Binding& binding = *model.motions[model.dragged].binding;
  const std::vector<glm::dvec3> displacements = model.volume().stencils().apply(vectors);
  DragField field;
  field.values = point_displacements(model.volume(), binding, displacements);
  if (model.needs_gradients()) {
    field.slopes = deformation_gradients(model.volume(), binding, displacements);
    parallel_for(field.slopes.size(), [&](std::size_t i) { field.slopes[i] -= glm::dmat3(1); });
  }
  if (model.influence != nullptr) {
    parallel_for(field.values.size(), [&](std::size_t i) {
      field.values[i] *= model.influence->at(i);
      if (!field.slopes.empty()) {
        field.slopes[i] *= model.influence->at(i);
      }
    });
  }
  return field;
}

void require_valid(const DragModel& model, std::span<const double> selection) {
  if (model.dragged >= model.motions.size()) {
    throw ParameterError("lattice " + std::to_string(model.dragged) + " of " +
                         std::to_string(model.motions.size()) + " is to be dragged");
  }
  if (!model.normals.empty() && model.normals.size() != model.rest_points.size()) {
    throw ParameterError(std::to_string(model.normals.size()) + " normals given for " +
                         std::to_string(model.rest_points.size()) + " points");
  }
  if (selection.size() != model.volume().n_controls()) {
    throw ParameterError("a selection of " + std::to_string(selection.size()) +
                         " control points given for a lattice of " +
                         std::to_string(model.volume().n_controls()));
  }
  for (std::size_t i = 0; i < selection.size(); ++i) {
    if (!(selection[i] >= 0 && selection[i] <= 1)) {
      throw ParameterError("control point " + std::to_string(i) + " is selected by " +
                           std::to_string(selection[i]) + ", must be 0 to 1");
    }
  }
}

}  // namespace espalier
