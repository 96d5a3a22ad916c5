#include "lattice/build/inventory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <utility>

#include "lattice/build/checks.h"
#include "lattice/build/extrude.h"
#include "lattice/build/extrude_faces.h"
#include "lattice/build/frames.h"
#include "lattice/build/offsets.h"
#include "lattice/build/primitives.h"
#include "lattice/build/section.h"
#include "lattice/core/error.h"
#include "lattice/topology/cell_complex.h"

namespace espalier {
namespace {

/// Where the Catmull-Clark boundary surface passes by a vertex with quadrilaterals only.
glm::dvec3 limit_point(const CellComplex& complex, std::span<const glm::dvec3> points,
                       VertexId vertex) {
  double n = 0;
  glm::dvec3 near(0);
  glm::dvec3 far(0);
  for (const EdgeId edge : complex.edges(vertex)) {
    if (complex.is_boundary(edge)) {
      n += 1;
      near += points[complex.other_end(edge, vertex).index()];
    }
  }
  for (const FaceId face : complex.faces(vertex)) {
    if (complex.is_boundary(face)) {
      const auto loop = complex.vertices(face);
      const auto at =
          static_cast<std::size_t>(std::find(loop.begin(), loop.end(), vertex) - loop.begin());
      far += points[loop[(at + 2) % 4].index()];
    }
  }
  return (n * n * points[vertex.index()] + 4.0 * near + far) / (n * (n + 5));
}

/// Scales a mesh about the origin so that its boundary surface is nowhere nearer than `radius`,
/// at the boundary's vertices.
void scale_to_radius(CellMesh& mesh, double radius) {
  const CellComplex complex(mesh.cells);
  double smallest = std::numeric_limits<double>::infinity();
  for (const VertexId vertex : complex.vertices()) {
    if (complex.is_boundary(vertex)) {
      smallest = std::min(smallest, glm::length(limit_point(complex, mesh.points, vertex)));
    }
  }
  for (glm::dvec3& point : mesh.points) {
    point *= radius / smallest;
  }
}

/// A point of the cube [-1, 1]³ seen from its middle at even angles, on the unit sphere.
glm::dvec3 on_sphere(const glm::dvec3& place) {
  const auto even = [](double x) { return std::tan(x * std::numbers::pi / 4); };
  return glm::normalize(glm::dvec3(even(place.x), even(place.y), even(place.z)));
}

std::vector<glm::dvec3> bones_of(const LimbOptions& options) {
  constexpr double kFoldedBack = 0.02;
  std::vector<glm::dvec3> bones;
  for (std::size_t i = 0; i + 1 < options.joints.size(); ++i) {
    const glm::dvec3 bone = unit_vector(options.joints[i + 1] - options.joints[i]);
    if (bone == glm::dvec3(0)) {
      throw ParameterError(fmt::format("limb: joints {} and {} coincide", i, i + 1));
    }
    if (i > 0 && glm::dot(bones.back(), bone) < kFoldedBack - 1) {
      throw ParameterError(fmt::format("limb: the bones at joint {} run back on each other", i));
    }
    bones.push_back(bone);
  }
  return bones;
}

void check_limb(const LimbOptions& options) {
  check_count("limb", "sectors", options.sectors, 3, 1000);
  check_count("limb", "layers", options.layers, 1, 1000);
  if (options.joints.size() < 2 || options.joints.size() > 10000 ||
      options.radii.size() != options.joints.size()) {
    throw ParameterError("limb: needs 2 to 10000 joints, and a radius at each");
  }
  for (std::size_t i = 0; i < options.joints.size(); ++i) {
    check_point("limb", "a joint", options.joints[i]);
    check_size("limb", "a radius", options.radii[i]);
  }
}

}  // namespace

CellMesh make_o_grid(const OGridOptions& options) {
  check_axis("ogrid", options.from, options.to);
  check_size("ogrid", "the radius", options.radius);
  const double end_radius = options.end_radius == 0 ? options.radius : options.end_radius;
  check_size("ogrid", "the end radius", end_radius);
  check_count("ogrid", "core", options.core, 1, 250);
  check_count("ogrid", "rings", options.rings, 1, 250);
  check_count("ogrid", "layers", options.layers, 1, 10000);
  return sweep_straight(o_grid_section(1, options.core, options.rings), options.from, options.to,
                        {options.radius, end_radius}, options.layers);
}

CellMesh make_annulus(const AnnulusOptions& options) {
  check_axis("annulus", options.from, options.to);
  check_size("annulus", "the radius", options.radius);
  check_size("annulus", "the inner radius", options.inner_radius);
  check_count("annulus", "sectors", options.sectors, 3, 1000);
  check_count("annulus", "rings", options.rings, 1, 1000);
  check_count("annulus", "layers", options.layers, 1, 10000);
  if (!(options.inner_radius < options.radius)) {
    throw ParameterError("annulus: the inner radius must be below the radius");
  }
  return sweep_straight(
      ring_section(options.inner_radius, options.radius, options.sectors, options.rings),
      options.from, options.to, {1, 1}, options.layers);
}

CellMesh make_torus(const TorusOptions& options) {
  check_point("torus", "the centre", options.center);
  check_axis("torus", {0, 0, 0}, options.axis);
  check_size("torus", "the radius", options.radius);
  check_size("torus", "the tube radius", options.tube_radius);
  check_count("torus", "sectors", options.sectors, 3, 1000);
  check_count("torus", "segments", options.segments, 3, 1000);
  if (!(options.tube_radius < options.radius)) {
    throw ParameterError("torus: the tube radius must be below the radius");
  }
  const Section section = wheel_section(options.tube_radius, options.sectors);
  const glm::dvec3 up = unit_vector(options.axis);
  const auto [right, ahead] = plane_across(up);
  // The spline along the ring cuts corners: its control points lie farther out.
  const double ring = 1 / radii_of_ring(options.segments).inner;
  std::vector<glm::dvec3> points;
  for (int step = 0; step < options.segments; ++step) {
    const double angle = 2 * std::numbers::pi * step / options.segments;
    const glm::dvec3 out = right * std::cos(angle) + ahead * std::sin(angle);
    for (const glm::dvec3& point : section.points) {
      points.push_back(options.center + out * ((options.radius + point.x) * ring) + up * point.y);
    }
  }
  return stack(std::move(points), section.faces, static_cast<std::size_t>(options.segments), true);
}

CellMesh make_star(const StarOptions& options) {
  check_axis("star", options.from, options.to);
  check_size("star", "the radius", options.radius);
  check_size("star", "the inner radius", options.inner_radius);
  check_count("star", "tips", options.tips, 3, 1000);
  check_count("star", "layers", options.layers, 1, 10000);
  if (!(options.inner_radius < options.radius)) {
    throw ParameterError("star: the inner radius must be below the radius");
  }
  return sweep_straight(star_section(options.radius, options.inner_radius, options.tips),
                        options.from, options.to, {1, 1}, options.layers);
}

CellMesh make_barbell(const BarbellOptions& options) {
  check_axis("barbell", options.from, options.to);
  check_axis("barbell", {0, 0, 0}, options.by);
  check_size("barbell", "the radius", options.radius);
  check_size("barbell", "the bar radius", options.bar_radius);
  check_count("barbell", "cells", options.cells, 1, 1000);
  check_count("barbell", "layers", options.layers, 1, 10000);
  const double length = glm::distance(options.from, options.to);
  if (!(options.bar_radius < 0.7 * options.radius) || !(2 * options.radius < length)) {
    throw ParameterError(
        "barbell: the bar radius must be below 0.7 of the radius, and the disks apart");
  }
  const glm::dvec3 right = unit_vector(options.to - options.from);
  const glm::dvec3 up = unit_vector(glm::cross(options.by, right));
  if (up == glm::dvec3(0)) {
    throw ParameterError("barbell: 'by' must not run from disk to disk");
  }
  Section section = barbell_section(length, options.radius, options.bar_radius, options.cells);
  for (glm::dvec3& point : section.points) {
    point = (options.from + options.to) / 2.0 + right * point.x + up * point.y;
  }
  return extrude(section.points, section.faces, options.by, options.layers);
}

CellMesh make_sphere(const SphereOptions& options) {
  check_point("sphere", "the centre", options.center);
  check_size("sphere", "the radius", options.radius);
  check_count("sphere", "cells", options.cells, 1, 100);
  check_count("sphere", "rings", options.rings, 1, 100);
  CellMesh cube =
      make_box({options.cells, options.cells, options.cells}, glm::dvec3(-1), glm::dvec3(1));
  const CellComplex complex(cube.cells);
  std::vector<std::int32_t> faces;
  for (const FaceId face : complex.faces()) {
    if (complex.is_boundary(face)) {
      faces.push_back(face.value);
    }
  }
  // The cube is half as large as the ball and half as round.
  const double core = 0.5 / (1 + 0.5 * (options.rings - 1));
  std::vector<glm::dvec3> offsets(cube.points.size(), glm::dvec3(0));
  for (std::size_t i = 0; i < cube.points.size(); ++i) {
    const glm::dvec3 place = cube.points[i];
    const glm::dvec3 size = glm::abs(place);
    const double distance = std::max({size.x, size.y, size.z});
    if (distance == 0) {
      continue;
    }
    cube.points[i] = core * (0.5 * place + 0.5 * distance * on_sphere(place / distance));
    offsets[i] = on_sphere(place / distance) - cube.points[i];
  }
  CellMesh ball = extrude_faces_by(cube, faces, offsets, options.rings).mesh;
  scale_to_radius(ball, options.radius);
  for (glm::dvec3& point : ball.points) {
    point += options.center;
  }
  return ball;
}

CellMesh make_limb(const LimbOptions& options) {
  check_limb(options);
  const std::vector<glm::dvec3> bones = bones_of(options);
  const Section section = wheel_section(1, options.sectors);
  std::vector<glm::dvec3> points;
  auto [right, up] = plane_across(bones.front());
  const auto n = static_cast<std::size_t>(options.layers);
  for (std::size_t i = 0; i < bones.size(); ++i) {
    if (i > 0) {
      right = carried(right, bones[i - 1], bones[i]);
      up = carried(up, bones[i - 1], bones[i]);
    }
    const glm::dvec3 first = i > 0 ? bones[i - 1] + bones[i] : bones[i];
    const glm::dvec3 last = i + 1 < bones.size() ? bones[i] + bones[i + 1] : bones[i];
    for (std::size_t step = i > 0 ? 1 : 0; step <= n; ++step) {
      const double t = static_cast<double>(step) / static_cast<double>(n);
      for (const glm::dvec3& point : section.points) {
        const glm::dvec3 offset = right * point.x + up * point.y;
        points.push_back(
            (options.joints[i] + options.radii[i] * slid_onto_plane(offset, bones[i], first)) *
                (1 - t) +
            (options.joints[i + 1] +
             options.radii[i + 1] * slid_onto_plane(offset, bones[i], last)) *
                t);
      }
    }
  }
  const std::size_t n_steps = points.size() / section.points.size();
  return stack(std::move(points), section.faces, n_steps);
}

}  // namespace espalier
