/// How a session grows cells from faces.

#include <glm/geometric.hpp>
#include <string>
#include <utility>

#include "viewer/interact/session.h"

namespace espalier::viewer {

void Session::begin_extrusion() {
  if (mode_ != Mode::Lattice) {
    say("Cells are extruded in Lattice mode: press ctrl+1.");
    return;
  }
  if (!lattice_.empty() && lattice_in(scene(), lattice_).as<SubdivisionLattice>() == nullptr) {
    say("Cells are extruded from subdivision lattices; the form Refine makes this one finer.");
    return;
  }
  set_element_kind(ElementKind::Face);
  std::erase_if(selection_, [&](std::int32_t face) {
    return !elements_.is_outer[static_cast<std::size_t>(face)];
  });
  if (selection_.empty()) {
    say("Select faces of the lattice's outside first: press 3 and click one.");
    return;
  }
  begin_transform(TransformKind::Extrude);
  if (!transform_) {
    return;
  }
  glm::dvec3 sum(0.0);
  const auto points = points_of(scene(), lattice_, Shape::Rest);
  for (const std::int32_t face : selection_) {
    sum += outward_area(scene(), lattice_, face, points);
  }
  transform_->normal = glm::length(sum) > 0 ? glm::normalize(sum) : view_.camera.backward();
}

void Session::finish_extrusion() {
  const Transform transform = *std::exchange(transform_, std::nullopt);
  Arguments arguments({{"lattice", lattice_}, {"output", lattice_}});
  std::string faces;
  for (const std::int32_t face : selection_) {
    faces += (faces.empty() ? "" : ",") + std::to_string(face);
  }
  arguments.set("faces", faces);
  if (transform.lock.axis >= 0) {
    const glm::dvec3 by = transform.offset(view_);
    arguments.set("by", std::vector<double>{by.x, by.y, by.z});
  } else {
    arguments.set("normal", transform.distance(view_));
  }
  const std::int32_t n_before = elements_.n_vertices;
  if (apply({"extrude", arguments})) {
    Selection added;
    for (std::int32_t i = n_before; i < elements_.n_vertices; ++i) {
      added.insert(i);
    }
    selection_ = elements_.within(ElementKind::Face, added);
  }
}

std::vector<glm::dvec3> Session::ghost() const {
  std::vector<glm::dvec3> segments;
  if (!transform_ || transform_->kind != TransformKind::Extrude) {
    return segments;
  }
  const auto points = points_of(scene(), lattice_, shape());
  const glm::dvec3 by = transform_->offset(view_);
  for (const std::int32_t face : selection_) {
    const auto loop = elements_.faces[static_cast<std::size_t>(face)];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const glm::dvec3& a = points[static_cast<std::size_t>(loop[i])];
      const glm::dvec3& b = points[static_cast<std::size_t>(loop[(i + 1) % loop.size()])];
      segments.insert(segments.end(), {a, a + by, a + by, b + by});
    }
  }
  return segments;
}

}  // namespace espalier::viewer
