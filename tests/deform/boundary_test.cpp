#include "deform/injectivity/boundary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <string>
#include <utility>
#include <vector>

#include "lattice/build/inventory.h"
#include "lattice/build/primitives.h"
#include "lattice/core/error.h"
#include "lattice/core/parallel.h"
#include "lattice/subdivision/freeze.h"
#include "lattice/tensor/tensor_lattice.h"
#include "lattice/tensor/thb_lattice.h"
#include "tests/support/families.h"
#include "tests/support/spline_volume.h"

namespace espalier {
namespace {

std::vector<glm::dvec3> rest_of(const Volume& volume) {
  return {volume.rest_controls().begin(), volume.rest_controls().end()};
}

template <class Map>
std::vector<glm::dvec3> posed(const Volume& volume, const Map& map) {
  std::vector<glm::dvec3> pose = rest_of(volume);
  for (glm::dvec3& p : pose) {
    p = map(p);
  }
  return pose;
}

/// A bar along x, of length 24 and width 2, bent round the z axis by an angle.
Volume bar() {
  return test::spline_volume({24, 2, 2}, test::grid_points({24, 2, 2}));
}
std::vector<glm::dvec3> bent(const Volume& volume, double angle) {
  return posed(volume, [&](const glm::dvec3& x) {
    const double turn = x.x * angle / 24;
    const double radius = x.y + 24 / angle;
    // A little along the axis, so that ends that meet cross and do not lie in one another.
    return glm::dvec3(radius * std::sin(turn), radius * std::cos(turn), x.z + 0.02 * x.x);
  });
}

/// What the volume makes of a place.
glm::dvec3 value_at(const Volume& volume, std::span<const glm::dvec3> pose,
                    const BoundaryPlace& place) {
  return volume.bezier(place.patch, volume.points(pose)).value(place.uvw);
}

/// Every crossing is one: two distinct places of the boundary, one point.
void expect_true_crossings(const Volume& volume, std::span<const glm::dvec3> pose,
                           const BoundaryReport& report) {
  for (const BoundaryCrossing& crossing : report.crossings) {
    EXPECT_LT(glm::distance(value_at(volume, pose, crossing.a), crossing.point), 1e-9);
    EXPECT_LT(glm::distance(value_at(volume, pose, crossing.b), crossing.point), 1e-9);
    EXPECT_GT(glm::distance(crossing.a.rest, crossing.b.rest), 1e-6);
    EXPECT_LT(glm::distance(value_at(volume, volume.rest_controls(), crossing.a), crossing.a.rest),
              1e-12);
  }
}

TEST(Boundary, of_lattices_at_rest_and_under_affine_maps_of_any_scale_is_simple) {
  for (const test::NamedLattice& family : test::lattice_families()) {
    const Volume volume = freeze_adaptive(family.lattice, {.tolerance = 1e-1, .most_levels = 1});
    for (const double scale : {1.0, 1e8, 1e-8}) {
      const auto pose = posed(volume, [&](const glm::dvec3& x) {
        return scale * glm::dvec3(x.x + 0.4 * x.y + 3, 1.2 * x.y - 0.3 * x.z, x.z + 0.1 * x.x);
      });
      const BoundaryReport report = check_boundary(volume, pose);
      EXPECT_EQ(report.verdict, BoundaryVerdict::Simple) << family.name;
      EXPECT_TRUE(report.is_unnested) << family.name;
      EXPECT_EQ(report.n_parts, family.name.starts_with("cubes sharing") ? 2u : 1u) << family.name;
    }
  }
}

TEST(Boundary, is_simple_where_leaves_meet_finer_neighbours) {
  for (const char* name : {"wedge cylinder", "prism over L", "prism over half disk 5",
                           "plus of cubes", "cubes sharing an edge"}) {
    for (const test::NamedLattice& family : test::lattice_families()) {
      if (family.name == name) {
        const Volume volume = freeze_adaptive(family.lattice, {.tolerance = 1e-3});
        EXPECT_EQ(check_boundary(volume, rest_of(volume)).verdict, BoundaryVerdict::Simple) << name;
        const Volume uniform = freeze_uniform(family.lattice, 2);
        EXPECT_EQ(check_boundary(uniform, rest_of(uniform)).verdict, BoundaryVerdict::Simple)
            << name;
      }
    }
  }
}

TEST(Boundary, of_a_twisted_bar_is_told_beside_dozens_of_levels_of_isolation) {
  for (const auto& [sectors, gradient_tolerance] :
       {std::pair(8, 1e-4), std::pair(10, 1e-4), std::pair(12, 1e-2)}) {
    const Volume volume =
        freeze_adaptive(test::lattice_from(make_cylinder({.sectors = sectors, .layers = 3})),
                        {.tolerance = 1e-5, .gradient_tolerance = gradient_tolerance});
    const auto pose = posed(volume, [&](const glm::dvec3& x) {
      const double turn = std::clamp(x.y, 0.0, 1.0);
      return glm::dvec3(std::cos(turn) * x.x - std::sin(turn) * x.z, x.y,
                        std::sin(turn) * x.x + std::cos(turn) * x.z);
    });
    EXPECT_EQ(check_boundary(volume, pose).verdict, BoundaryVerdict::Simple) << sectors;
  }
}

TEST(Boundary, of_a_ring_is_simple_inside_and_out) {
  const Volume torus = freeze_adaptive(test::lattice_from(make_torus({})), {.tolerance = 1e-2});
  EXPECT_EQ(check_boundary(torus, rest_of(torus)).verdict, BoundaryVerdict::Simple);
  const Volume pipe = freeze_adaptive(test::lattice_from(make_annulus({})), {.tolerance = 1e-2});
  const BoundaryReport report = check_boundary(pipe, rest_of(pipe));
  EXPECT_EQ(report.verdict, BoundaryVerdict::Simple);
  EXPECT_EQ(report.n_parts, 1u);
}

TEST(Boundary, of_a_bar_crosses_itself_when_its_ends_meet) {
  const Volume volume = bar();
  for (const double angle : {1.0, 3.0, 6.0}) {
    EXPECT_EQ(check_boundary(volume, bent(volume, angle)).verdict, BoundaryVerdict::Simple)
        << angle;
  }
  for (const double angle : {6.6, 7.5}) {
    const auto pose = bent(volume, angle);
    const BoundaryReport report = check_boundary(volume, pose);
    EXPECT_EQ(report.verdict, BoundaryVerdict::Intersecting) << angle;
    expect_true_crossings(volume, pose, report);
  }
}

TEST(Boundary, of_a_bar_that_also_lies_in_itself_is_seen_to_cross) {
  const Volume volume = bar();
  auto pose = bent(volume, 7.5);
  for (std::size_t i = 0; i < pose.size(); ++i) {
    pose[i].z = volume.rest_controls()[i].z;  // its flat sides lie in two planes
  }
  const BoundaryReport report = check_boundary(volume, pose);
  EXPECT_EQ(report.verdict, BoundaryVerdict::Intersecting);
  EXPECT_FALSE(report.undecided.empty());
  expect_true_crossings(volume, pose, report);
}

TEST(Boundary, that_touches_itself_without_crossing_is_undecided) {
  const Volume volume = test::spline_volume({6, 1, 1}, test::grid_points({6, 1, 1}));
  // Folded like a U with its legs in contact: x = 4…6 goes back over x = 0…2, one unit higher.
  const auto pose = posed(volume, [](const glm::dvec3& x) {
    if (x.x <= 2) {
      return x;
    }
    return x.x >= 4 ? glm::dvec3(6 - x.x, x.y, 2 - x.z) : glm::dvec3(3.5, x.y, 1 + (x.x - 3) * 0.5);
  });
  EXPECT_EQ(check_boundary(volume, pose).verdict, BoundaryVerdict::Undecided);
}

TEST(Boundary, of_one_part_inside_another_covers_space_twice) {
  const SubdivisionLattice cubes = test::cubes_sharing_vertex();
  const Volume volume = freeze_adaptive(cubes);
  const auto pose = posed(volume, [](const glm::dvec3& x) {
    const bool is_second = x.x + x.y + x.z > 3;  // turned and shrunk into the first
    const glm::dvec3 by = 0.1 * (glm::dvec3(x.y, x.x, x.z) - 1.0);
    return is_second ? glm::dvec3(1) - 2.0 * by - (by.x + by.y + by.z) : x;
  });
  const BoundaryReport report = check_boundary(volume, pose);
  EXPECT_EQ(report.verdict, BoundaryVerdict::Simple);
  EXPECT_EQ(report.n_parts, 2u);
  EXPECT_FALSE(report.is_unnested);
}

TEST(Boundary, of_rational_and_hierarchical_lattices_is_told_too) {
  const OrientedBox box;
  TensorLattice nurbs =
      make_tensor_lattice(TensorKind::Nurbs,
                          {TensorAxis::make(6, 3, Ends::Open), TensorAxis::make(5, 2, Ends::Open),
                           TensorAxis::make(4, 3, Ends::Open)},
                          box);
  for (std::size_t i = 0; i < nurbs.weights.size(); ++i) {
    nurbs.weights[i] = 1 + 0.3 * static_cast<double>(i % 5);
  }
  const Volume rational = freeze(nurbs);
  ASSERT_TRUE(rational.is_rational());
  EXPECT_EQ(check_boundary(rational, rest_of(rational)).verdict, BoundaryVerdict::Simple);
  ThbLattice thb = make_thb_lattice({5, 5, 5}, {3, 3, 3}, box);
  thb = with_cells(thb, 1, cells_of_box(*thb.hierarchy, 1, {0, 0, 0}, {0.5, 0.5, 1}));
  const Volume hierarchical = freeze(thb);
  const auto pose = test::jittered(rest_of(hierarchical), 0.02, 5);
  EXPECT_EQ(check_boundary(hierarchical, pose).verdict, BoundaryVerdict::Simple);
}

using Triangle = std::array<glm::dvec3, 3>;

/// A triangle of the boundary, in the pose and at rest.
struct Sample {
  Triangle pose;
  glm::dvec3 rest;
};

/// The faces of the boundary cut into n × n squares of two triangles.
std::vector<Sample> triangles_of(const Volume& volume, std::span<const glm::dvec3> pose, int n) {
  std::vector<Sample> samples;
  const auto points = volume.points(pose);
  for (std::size_t i = 0; i < volume.n_patches(); ++i) {
    const BezierPatch posed = volume.bezier(i, points);
    const BezierPatch rest = volume.bezier(i, volume.rest_points());
    for (int face = 0; face < 6; ++face) {
      if (!volume.patch(i).is_on_boundary(face)) {
        continue;
      }
      const auto uvw = [&](double s, double t) {
        glm::dvec3 place(face % 2);
        place[(face / 2 + 1) % 3] = s / n;
        place[(face / 2 + 2) % 3] = t / n;
        return place;
      };
      for (int t = 0; t < n; ++t) {
        for (int s = 0; s < n; ++s) {
          const std::array corners = {posed.value(uvw(s, t)), posed.value(uvw(s + 1, t)),
                                      posed.value(uvw(s + 1, t + 1)), posed.value(uvw(s, t + 1))};
          const glm::dvec3 middle = rest.value(uvw(s + 0.5, t + 0.5));
          samples.push_back({{corners[0], corners[1], corners[2]}, middle});
          samples.push_back({{corners[0], corners[2], corners[3]}, middle});
        }
      }
    }
  }
  return samples;
}

double volume_of(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                 const glm::dvec3& d) {
  return glm::determinant(glm::dmat3(b - a, c - a, d - a));
}

/// Whether an edge of one passes through the other, clear of its edges.
bool pierces(const Triangle& a, const Triangle& b) {
  constexpr double kClear = 1e-6;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3& p = a[i];
    const glm::dvec3& q = a[(i + 1) % 3];
    const double above = volume_of(b[0], b[1], b[2], p);
    const double below = volume_of(b[0], b[1], b[2], q);
    if (above * below >= 0 || std::min(std::abs(above), std::abs(below)) < kClear) {
      continue;
    }
    const double x = volume_of(p, q, b[0], b[1]);
    const double y = volume_of(p, q, b[1], b[2]);
    const double z = volume_of(p, q, b[2], b[0]);
    if (std::min({x, y, z}) > kClear || std::max({x, y, z}) < -kClear) {
      return true;
    }
  }
  return false;
}

/// Whether triangles that are far apart at rest pass through each other.
bool crosses(const std::vector<Sample>& samples) {
  for (const Sample& a : samples) {
    const Box box = box_of(a.pose);
    for (const Sample& b : samples) {
      if (glm::distance(a.rest, b.rest) > 0.9 && box.overlaps(box_of(b.pose)) &&
          pierces(a.pose, b.pose)) {
        return true;
      }
    }
  }
  return false;
}

TEST(Boundary, is_never_called_simple_where_fine_triangles_cross) {
  const Volume volume = test::spline_volume({3, 1, 1}, test::grid_points({3, 1, 1}));
  int n_simple = 0;
  int n_crossing = 0;
  int n_told = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const double size = 0.2 + 1.3 * (seed % 10) / 10;
    const auto pose = test::jittered(rest_of(volume), size, seed);
    const BoundaryReport report = check_boundary(volume, pose, {}, {.most_boxes = 600});
    expect_true_crossings(volume, pose, report);
    const bool is_crossing =
        crosses(triangles_of(volume, pose, 4)) && crosses(triangles_of(volume, pose, 8));
    EXPECT_FALSE(is_crossing && report.verdict == BoundaryVerdict::Simple) << seed;
    n_simple += report.verdict == BoundaryVerdict::Simple ? 1 : 0;
    n_crossing += is_crossing ? 1 : 0;
    n_told += is_crossing && report.verdict == BoundaryVerdict::Intersecting ? 1 : 0;
  }
  EXPECT_GT(n_simple, 5);
  EXPECT_GT(n_crossing, 10);
  EXPECT_EQ(n_told, n_crossing);
}

TEST(Boundary, is_the_same_for_any_number_of_threads) {
  const Volume volume = bar();
  const auto pose = bent(volume, 6.8);
  set_thread_count(1);
  const BoundaryReport one = check_boundary(volume, pose);
  set_thread_count(4);
  const BoundaryReport four = check_boundary(volume, pose);
  set_thread_count(0);
  ASSERT_GT(one.crossings.size(), 0u);
  ASSERT_EQ(one.crossings.size(), four.crossings.size());
  EXPECT_EQ(one.undecided.size(), four.undecided.size());
  for (std::size_t i = 0; i < one.crossings.size(); ++i) {
    EXPECT_EQ(one.crossings[i].point, four.crossings[i].point);
    EXPECT_EQ(one.crossings[i].a.uvw, four.crossings[i].a.uvw);
  }
}

TEST(Boundary, names_bad_input_and_can_be_cancelled) {
  const Volume volume = bar();
  auto pose = rest_of(volume);
  const Progress cancel([](std::string_view, double) { return false; });
  EXPECT_THROW((void)check_boundary(volume, pose, {}, {}, cancel), Cancelled);
  for (const double bad : {static_cast<double>(NAN), static_cast<double>(INFINITY), 1e19}) {
    pose[7].y = bad;
    try {
      (void)check_boundary(volume, pose);
      FAIL();
    } catch (const ParameterError& error) {
      EXPECT_NE(std::string(error.what()).find("control point 7"), std::string::npos);
    }
  }
  pose = rest_of(volume);
  EXPECT_THROW((void)check_boundary(volume, pose, std::vector<double>{1.0}), ParameterError);
  pose.pop_back();
  EXPECT_THROW((void)check_boundary(volume, pose), ParameterError);
}

TEST(Boundary, of_a_pose_that_is_flat_or_a_point_is_undecided_soon) {
  const Volume volume = test::spline_volume({3, 3, 3}, test::grid_points({3, 3, 3}));
  for (const double height : {0.0, 1e-300}) {
    const auto flat = posed(volume, [&](glm::dvec3 x) {
      x.z *= height;
      return x;
    });
    EXPECT_EQ(check_boundary(volume, flat, {}, {.most_boxes = 50}).verdict,
              BoundaryVerdict::Undecided);
  }
  const auto point = posed(volume, [](const glm::dvec3&) { return glm::dvec3(1, 2, 3); });
  EXPECT_EQ(check_boundary(volume, point, {}, {.most_boxes = 50}).verdict,
            BoundaryVerdict::Undecided);
}

}  // namespace
}  // namespace espalier
