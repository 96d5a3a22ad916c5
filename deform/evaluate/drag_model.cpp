#include "deform/evaluate/drag_model.h"

#include <glm/geometric.hpp>
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

void require_margin(double margin) {
  if (!(margin >= 0 && margin < 1)) {
    throw ParameterError("the margin is " + std::to_string(margin) +
                         ", must be at least 0 and less than 1");
  }
}

glm::dmat3 cofactors(const glm::dmat3& J) {
  return {glm::cross(J[1], J[2]), glm::cross(J[2], J[0]), glm::cross(J[0], J[1])};
}

template <class Real>
void require_fits(const DraggedPoints<Real>& out, std::size_t n_points, bool has_normals,
                  bool has_folds) {
  const auto check = [n_points](std::size_t n, bool is_possible, const std::string& what) {
    if (n != 0 && n != n_points) {
      throw ParameterError("room for " + std::to_string(n) + " " + what + " given for " +
                           std::to_string(n_points) + " points");
    }
    if (n != 0 && !is_possible) {
      throw ParameterError("the drag was begun without what " + what + " need");
    }
  };
  check(out.points.size(), true, "points");
  check(out.normals.size(), has_normals, "normals");
  check(out.folded.size(), has_folds, "marks");
}

template void require_fits(const DraggedPoints<float>&, std::size_t, bool, bool);
template void require_fits(const DraggedPoints<double>&, std::size_t, bool, bool);

}  // namespace espalier
