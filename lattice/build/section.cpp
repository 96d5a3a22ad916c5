#include "lattice/build/section.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "lattice/build/extrude.h"
#include "lattice/build/offsets.h"

namespace espalier {
namespace {

glm::dvec3 on_circle(double radius, double angle) {
  return {radius * std::cos(angle), radius * std::sin(angle), 0};
}

double turn(int i, int n) {
  return 2 * std::numbers::pi * i / n;
}

/// Indices of a square grid's rim, counter-clockwise from the middle of its right side or, for an
/// odd number of cells, from the corner below.
std::vector<std::int32_t> rim_of_grid(int cells) {
  std::vector<std::int32_t> rim;
  const auto index = [cells](int i, int j) { return i + (cells + 1) * j; };
  for (int j = 0; j < cells; ++j) {
    rim.push_back(index(cells, j));
  }
  for (int i = cells; i > 0; --i) {
    rim.push_back(index(i, cells));
  }
  for (int j = cells; j > 0; --j) {
    rim.push_back(index(0, j));
  }
  for (int i = 0; i < cells; ++i) {
    rim.push_back(index(i, 0));
  }
  std::rotate(rim.begin(), rim.begin() + cells / 2, rim.end());
  return rim;
}

/// Adds a ring of quadrilaterals between two closed rows of points.
void add_ring(const std::vector<std::int32_t>& inner, const std::vector<std::int32_t>& outer,
              Section& section) {
  for (std::size_t i = 0; i < inner.size(); ++i) {
    const std::size_t j = (i + 1) % inner.size();
    section.faces.push_back(std::array{inner[i], outer[i], outer[j], inner[j]});
  }
}

std::int32_t add_point(const glm::dvec3& point, Section& section) {
  section.points.push_back(point);
  return static_cast<std::int32_t>(section.points.size() - 1);
}

/// Adds an O-grid whose outermost points are `outline`, counter-clockwise from its right, round
/// `centre`; core² quadrilaterals inside. side: 1, or -1 where right is left.
void add_o_grid(const glm::dvec3& centre, const std::vector<std::int32_t>& outline, double side,
                int core, int rings, Section& section) {
  const auto first = static_cast<std::int32_t>(section.points.size());
  const double radius = glm::distance(section.points[static_cast<std::size_t>(outline[0])], centre);
  const double half = 0.5 * radius / (1 + 0.5 * (rings - 1));  // of the core's width
  for (int j = 0; j <= core; ++j) {
    for (int i = 0; i <= core; ++i) {
      const glm::dvec3 place(2.0 * i / core - 1, 2.0 * j / core - 1, 0);
      // Corners are drawn in a little, so that they make no slivers with the ring.
      const double corner = std::abs(place.x * place.y);
      section.points.push_back(centre + place * (side * half * (1 - 0.15 * corner)));
    }
  }
  for (int j = 0; j < core; ++j) {
    for (int i = 0; i < core; ++i) {
      const std::int32_t a = first + i + (core + 1) * j;
      section.faces.push_back(std::array{a, a + 1, a + core + 2, a + core + 1});
    }
  }
  std::vector<std::int32_t> inner = rim_of_grid(core);
  for (std::int32_t& point : inner) {
    point += first;
  }
  const std::vector<std::int32_t> rim = inner;
  for (int ring = 1; ring <= rings; ++ring) {
    std::vector<std::int32_t> outer = outline;
    for (std::size_t i = 0; ring < rings && i < rim.size(); ++i) {
      const glm::dvec3 from = section.points[static_cast<std::size_t>(rim[i])];
      const glm::dvec3 to = section.points[static_cast<std::size_t>(outline[i])];
      outer[i] = add_point(glm::mix(from, to, static_cast<double>(ring) / rings), section);
    }
    add_ring(inner, outer, section);
    inner = outer;
  }
}

/// Angle at which outline point i of an O-grid with this core lies: the core's corners look at the
/// diagonals.
double o_grid_angle(int i, int core) {
  const int n = 4 * core;
  return turn(i, n) - (core % 2 == 0 ? 0 : turn(1, n) / 2);
}

}  // namespace

RingRadii radii_of_ring(int n) {
  const double step = 2 * std::numbers::pi / n;
  const double at_knot = (4 + 2 * std::cos(step)) / 6;
  const double between = (46 * std::cos(step / 2) + 2 * std::cos(3 * step / 2)) / 48;
  return {std::min(at_knot, between), std::max(at_knot, between)};
}

Section wheel_section(double radius, int sectors) {
  Section section{{glm::dvec3(0)}, {}};
  const double ring = radius / radii_of_ring(sectors).inner;
  for (int i = 0; i < sectors; ++i) {
    section.points.push_back(on_circle(ring, turn(i, sectors)));
    section.faces.push_back(std::array{0, i + 1, (i + 1) % sectors + 1});
  }
  return section;
}

Section o_grid_section(double radius, int core, int rings) {
  Section section;
  const int n = 4 * core;
  const double ring = radius / radii_of_ring(n).inner;
  std::vector<std::int32_t> outline;
  for (int i = 0; i < n; ++i) {
    outline.push_back(add_point(on_circle(ring, o_grid_angle(i, core)), section));
  }
  add_o_grid(glm::dvec3(0), outline, 1, core, rings, section);
  return section;
}

Section ring_section(double inner_radius, double radius, int sectors, int rings) {
  Section section;
  const RingRadii radii = radii_of_ring(sectors);
  const double from = inner_radius / radii.outer;
  const double to = radius / radii.inner;
  std::vector<std::int32_t> inner;
  for (int ring = 0; ring <= rings; ++ring) {
    std::vector<std::int32_t> outer;
    const double t = static_cast<double>(ring) / rings;
    for (int i = 0; i < sectors; ++i) {
      outer.push_back(add_point(on_circle(from * (1 - t) + to * t, turn(i, sectors)), section));
    }
    if (ring > 0) {
      add_ring(inner, outer, section);
    }
    inner = outer;
  }
  return section;
}

Section star_section(double radius, double inner_radius, int n) {
  Section section{{glm::dvec3(0)}, {}};
  for (int i = 0; i < 2 * n; ++i) {
    section.points.push_back(
        on_circle(i % 2 == 0 ? radius : inner_radius, turn(i, 2 * n) + std::numbers::pi / 2));
  }
  for (int i = 0; i < 2 * n; i += 2) {
    section.faces.push_back(std::array{0, (i + 2 * n - 1) % (2 * n) + 1, i + 1, i + 2});
  }
  return section;
}

Section barbell_section(double length, double radius, double bar_radius, int cells) {
  constexpr int kCore = 4;
  constexpr int kRound = 4 * kCore;
  Section section;
  const double ring = radius / radii_of_ring(kRound).inner;
  const double neck = std::asin(bar_radius / ring);  // where the bar's sides meet a disk
  std::array<std::vector<std::int32_t>, 2> outlines;
  std::array<glm::dvec3, 2> centres = {glm::dvec3(-length / 2, 0, 0), glm::dvec3(length / 2, 0, 0)};
  for (int end = 0; end < 2; ++end) {
    auto& outline = outlines[static_cast<std::size_t>(end)];
    const double mirrored = end == 0 ? 0 : std::numbers::pi;  // the neck looks at the other disk
    for (int i = 0; i < kRound; ++i) {
      // Points beside the neck are spread over what is left of the circle.
      const double rest = 2 * (std::numbers::pi - neck) / (kRound - 2);
      const double angle = i == 0 ? 0 : neck + (i - 1) * rest;
      outline.push_back(add_point(
          centres[static_cast<std::size_t>(end)] + on_circle(ring, angle + mirrored), section));
    }
    add_o_grid(centres[static_cast<std::size_t>(end)], outline, end == 0 ? 1 : -1, kCore, 1,
               section);
  }
  // Rows of three points along the bar, from the left disk's neck to the right one's.
  std::array<std::int32_t, 3> before = {outlines[0][kRound - 1], outlines[0][0], outlines[0][1]};
  const std::array<std::int32_t, 3> last = {outlines[1][1], outlines[1][0],
                                            outlines[1][kRound - 1]};
  const std::array<std::int32_t, 3> start = before;
  for (int cell = 1; cell <= cells; ++cell) {
    std::array<std::int32_t, 3> row = last;
    for (std::size_t i = 0; cell < cells && i < 3; ++i) {
      const glm::dvec3 from = section.points[static_cast<std::size_t>(start[i])];
      const glm::dvec3 to = section.points[static_cast<std::size_t>(last[i])];
      row[i] = add_point(glm::mix(from, to, static_cast<double>(cell) / cells), section);
    }
    section.faces.push_back(std::array{before[0], row[0], row[1], before[1]});
    section.faces.push_back(std::array{before[1], row[1], row[2], before[2]});
    before = row;
  }
  return section;
}

std::array<glm::dvec3, 2> plane_across(const glm::dvec3& axis) {
  const glm::dvec3 size = glm::abs(axis);
  glm::dvec3 other(1, 0, 0);
  if (size.x > size.y || size.x > size.z) {
    other = size.y <= size.z ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
  }
  const glm::dvec3 first = glm::normalize(glm::cross(axis, other));
  return {first, glm::cross(axis, first)};
}

CellMesh sweep_straight(const Section& section, const glm::dvec3& from, const glm::dvec3& to,
                        const std::array<double, 2>& scales, int layers) {
  check_layers(layers, section.faces.n_values());
  const auto [right, up] = plane_across(unit_vector(to - from));
  std::vector<glm::dvec3> points;
  for (int layer = 0; layer <= layers; ++layer) {
    const double t = static_cast<double>(layer) / layers;
    const glm::dvec3 centre = from * (1 - t) + to * t;
    const double scale = scales[0] * (1 - t) + scales[1] * t;
    for (const glm::dvec3& point : section.points) {
      points.push_back(centre + (right * point.x + up * point.y) * scale);
    }
  }
  return stack(std::move(points), section.faces, static_cast<std::size_t>(layers) + 1);
}

}  // namespace espalier
