#include "deform/direct/pulled_points.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

#include "deform/direct/table_rows.h"
#include "deform/embed/embed.h"
#include "deform/evaluate/weights.h"
#include "lattice/core/box_tree.h"
#include "lattice/core/error.h"

namespace espalier {
namespace {

std::string text_of(const glm::dvec3& v) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x, v.y, v.z);
}

/// A point of a surface is named by its place.
std::string name_at(const PulledPoint& point, const glm::dvec3& place) {
  return point.name.ends_with(')') ? point.name : point.name + " at " + text_of(place);
}

[[noreturn]] void refuse_outside(const PulledPoint& point, const glm::dvec3& place,
                                 PointStatus status) {
  const std::string subject =
      point.is_image ? fmt::format("'symmetry' mirrors {} to {}", point.name, text_of(place))
                     : fmt::format("'{}' names {}", point.option, name_at(point, place));
  throw ParameterError(fmt::format(
      "{}, which {}", subject,
      status == PointStatus::Unconverged
          ? "is not found in the lattice although a cell may hold it: is that singular at rest?"
          : "lies outside the lattice: no control point moves it"));
}

/// The corners of pulled points, each once, and where they are.
class Corners {
 public:
  std::size_t number(std::size_t point, bool is_image, const glm::dvec3& place) {
    const auto [found, is_new] = numbers_.try_emplace({point, is_image}, places.size());
    if (is_new) {
      places.push_back(place);
    }
    return found->second;
  }
  std::vector<glm::dvec3> places;

 private:
  std::map<std::pair<std::size_t, bool>, std::size_t> numbers_;
};

glm::dvec3 imaged(const glm::dvec3& place, bool is_image,
                  const std::optional<SymmetryPlane>& symmetry) {
  return is_image && symmetry ? symmetry->image_of_place(place) : place;
}

}  // namespace

glm::dvec3 rest_place(const PulledPoint& point, std::span<const glm::dvec3> model,
                      const std::optional<SymmetryPlane>& symmetry) {
  return imaged(place_of(point.point, model), point.is_image, symmetry);
}

std::vector<PulledPoint> with_images(std::vector<PulledPoint> points,
                                     std::span<const glm::dvec3> model,
                                     const SymmetryPlane& symmetry, double tolerance) {
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    PulledPoint image = points[i];
    image.is_image = true;
    image.goal = image.aim == Aim::Place ? symmetry.image_of_place(image.goal)
                                         : symmetry.image_of_vector(image.goal);
    const glm::dvec3 place = place_of(image.point, model);
    if (glm::distance(place, symmetry.image_of_place(place)) > 2 * tolerance) {
      points.push_back(std::move(image));
    } else if (glm::distance(image.goal, points[i].goal) > 2 * tolerance) {
      throw ParameterError(
          fmt::format("'{}' takes {} off the plane of symmetry {} = {}, on which it lies: give it "
                      "a goal on the "
                      "plane",
                      image.option, name_at(image, place), "xyz"[symmetry.axis], symmetry.offset));
    }
  }
  return points;
}

StencilTable rows_of(const Volume& volume, std::span<const PulledPoint> points,
                     std::span<const glm::dvec3> model,
                     const std::optional<SymmetryPlane>& symmetry, const Progress& progress) {
  Corners corners;
  std::vector<std::vector<std::pair<std::size_t, double>>> sums;
  for (const PulledPoint& point : points) {
    auto& sum = sums.emplace_back();
    for (const auto& [corner, weight] : point.point.corners) {
      const glm::dvec3 place = imaged(model[corner], point.is_image, symmetry);
      sum.emplace_back(corners.number(corner, point.is_image, place), weight);
    }
  }
  const Binding binding = embed(volume, corners.places, progress);
  const StencilTable weights = control_weights(volume, binding);
  StencilTable rows =
      StencilTable::build(points.size(), volume.n_controls(), [&](std::size_t i, StencilRow& row) {
        for (const auto& [corner, weight] : sums[i]) {
          add_row(weights[corner], weight, row);
        }
      });
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (rows[i].indices.empty() && !points[i].is_optional) {
      refuse_outside(points[i], rest_place(points[i], model, symmetry),
                     binding.status[sums[i].front().first]);
    }
  }
  return rows;
}

void require_no_contradiction(std::span<const PulledPoint> points,
                              std::span<const glm::dvec3> places,
                              std::span<const glm::dvec3> wanted, const glm::dvec3& normal,
                              double tolerance) {
  std::vector<Box> boxes;
  for (const glm::dvec3& place : places) {
    boxes.push_back(Box{place, place}.grown(0.5 * tolerance));
  }
  const BoxTree tree(boxes);
  for (std::size_t i = 0; i < points.size(); ++i) {
    tree.visit_overlapping(boxes[i], [&](std::size_t j) {
      glm::dvec3 apart = wanted[i] - wanted[j];
      if (points[i].aim == Aim::Plane || points[j].aim == Aim::Plane) {
        apart = glm::dot(apart, normal) * normal;
      }
      if (glm::length(apart) > tolerance) {
        throw ParameterError(fmt::format(
            "'{}' takes {} apart from {}{}, which is at the same place {}: give both the same goal",
            points[i].option, points[i].name, points[j].name,
            points[i].option == points[j].option ? "" : " of --" + points[j].option,
            text_of(places[i])));
      }
    });
  }
}

}  // namespace espalier
