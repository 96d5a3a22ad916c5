#include "deform/model/dense_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "deform/model/polygon_cuts.h"
#include "lattice/core/error.h"
#include "lattice/topology/face_triangles.h"

namespace espalier {
namespace {

using Loops = std::vector<std::vector<std::int32_t>>;

/// Texture coordinates are an affine function of the points, so that they must stay one.
glm::dvec3 texture_of(const glm::dvec3& p) {
  return {0.3 * p.x - 0.2 * p.y + 0.1, p.z + 0.5 * p.y, 0};
}

DenseMesh mesh_of(std::vector<glm::dvec3> points, const Loops& loops) {
  DenseMesh mesh;
  mesh.points = std::move(points);
  for (const glm::dvec3& p : mesh.points) {
    mesh.textures.push_back(texture_of(p));
    mesh.normals.emplace_back(0, 0, 2);
    mesh.extras.push_back(p.x + p.y);
  }
  mesh.n_extras = 1;
  std::vector<DenseCorner> corners;
  for (const auto& loop : loops) {
    corners.clear();
    for (const std::int32_t i : loop) {
      corners.push_back({i, i, i});
    }
    mesh.parents.push_back(static_cast<std::int32_t>(mesh.faces.n_rows()));
    mesh.faces.push_back(corners);
  }
  return mesh;
}

const std::vector<glm::dvec3> kOctahedron = {{1, 0, 0},  {0, 1, 0},  {0, 0, 1},
                                             {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
const Loops kOctahedronFaces = {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2},
                                {1, 0, 5}, {3, 1, 5}, {4, 3, 5}, {0, 4, 5}};
const std::vector<glm::dvec3> kHouse = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}, {0, 0, 1},
                                        {2, 0, 1}, {2, 1, 1}, {0, 1, 1}, {1, 0, 2}, {1, 1, 2}};
const Loops kHouseFaces = {{0, 3, 2, 1}, {0, 1, 5, 8, 4}, {1, 2, 6, 5}, {2, 3, 7, 9, 6},
                           {3, 0, 4, 7}, {4, 8, 9, 7},    {5, 6, 9},    {5, 9, 8}};

std::vector<glm::dvec3> loop_of(const DenseMesh& mesh, std::size_t face) {
  std::vector<glm::dvec3> loop;
  for (const DenseCorner& corner : mesh.faces[face]) {
    loop.push_back(mesh.points[static_cast<std::size_t>(corner.point)]);
  }
  return loop;
}

/// Twice the area vectors of the faces, by the face of the original.
std::map<std::int32_t, glm::dvec3> areas(const DenseMesh& mesh) {
  std::map<std::int32_t, glm::dvec3> sums;
  for (std::size_t face = 0; face < mesh.faces.n_rows(); ++face) {
    sums[mesh.parents[face]] += area_vector(loop_of(mesh, face));
  }
  return sums;
}

double longest_edge(const DenseMesh& mesh) {
  double longest = 0;
  for (std::size_t face = 0; face < mesh.faces.n_rows(); ++face) {
    const auto loop = loop_of(mesh, face);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      longest = std::max(longest, glm::distance(loop[i], loop[(i + 1) % loop.size()]));
    }
  }
  return longest;
}

/// How many faces each edge has.
std::map<std::pair<std::int32_t, std::int32_t>, int> edge_uses(const DenseMesh& mesh) {
  std::map<std::pair<std::int32_t, std::int32_t>, int> uses;
  for (std::size_t face = 0; face < mesh.faces.n_rows(); ++face) {
    const auto loop = mesh.faces[face];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      ++uses[std::minmax(loop[i].point, loop[(i + 1) % loop.size()].point)];
    }
  }
  return uses;
}

std::string error_of(const DenseMesh& mesh, DensifyMethod method, double longest) {
  try {
    (void)densified(mesh, method, longest);
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "";
}

TEST(DenseMesh, halves_long_edges_and_keeps_shape_and_attributes) {
  for (const double longest : {3.0, 1.5, 1.0, 0.4, 0.13}) {
    for (const auto& [points, loops] :
         {std::pair(kOctahedron, kOctahedronFaces), std::pair(kHouse, kHouseFaces)}) {
      const DenseMesh before = mesh_of(points, loops);
      const DenseMesh mesh = densified(before, DensifyMethod::Midpoint, longest);
      EXPECT_LE(longest_edge(mesh), longest);
      for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_EQ(mesh.points[i], points[i]);
      }
      const auto old_areas = areas(before);
      for (const auto& [face, area] : areas(mesh)) {
        EXPECT_LT(glm::distance(area, old_areas.at(face)), 1e-12);
      }
      for (std::size_t face = 0; face < mesh.faces.n_rows(); ++face) {
        EXPECT_GT(glm::dot(area_vector(loop_of(mesh, face)), old_areas.at(mesh.parents[face])), 0);
        for (const DenseCorner& corner : mesh.faces[face]) {
          const glm::dvec3& p = mesh.points[static_cast<std::size_t>(corner.point)];
          const glm::dvec3& t = mesh.textures[static_cast<std::size_t>(corner.texture)];
          EXPECT_LT(glm::distance(t, texture_of(p)), 1e-12);
          EXPECT_NEAR(mesh.extras[static_cast<std::size_t>(corner.point)], p.x + p.y, 1e-12);
          EXPECT_GT(mesh.normals[static_cast<std::size_t>(corner.normal)].z, 0.999);
        }
      }
      EXPECT_TRUE(std::ranges::is_sorted(mesh.parents));
      for (const auto& [edge, n] : edge_uses(mesh)) {
        EXPECT_EQ(n, 2);  // closed as before, without hanging points
      }
    }
  }
}

TEST(DenseMesh, is_the_mesh_where_edges_are_short) {
  const DenseMesh before = mesh_of(kHouse, kHouseFaces);
  for (const DensifyMethod method : {DensifyMethod::Midpoint, DensifyMethod::CatmullClark}) {
    const DenseMesh mesh = densified(before, method, 2);
    EXPECT_EQ(mesh.points, before.points);
    EXPECT_EQ(mesh.faces.n_rows(), before.faces.n_rows());
  }
}

TEST(DenseMesh, scales_with_the_model) {
  const DenseMesh one = densified(mesh_of(kHouse, kHouseFaces), DensifyMethod::Midpoint, 0.3);
  for (const double scale : {0x1p30, 0x1p-30}) {
    std::vector<glm::dvec3> points = kHouse;
    for (glm::dvec3& p : points) {
      p *= scale;
    }
    const DenseMesh other =
        densified(mesh_of(points, kHouseFaces), DensifyMethod::Midpoint, 0.3 * scale);
    ASSERT_EQ(other.points.size(), one.points.size());
    for (std::size_t i = 0; i < one.points.size(); ++i) {
      EXPECT_EQ(other.points[i], scale * one.points[i]);
    }
  }
}

TEST(DenseMesh, keeps_edges_of_three_faces) {
  const Loops book = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  const std::vector<glm::dvec3> points = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, -1, 0}};
  for (const DensifyMethod method : {DensifyMethod::Midpoint, DensifyMethod::Loop}) {
    const DenseMesh mesh = densified(mesh_of(points, book), method, 0.3);
    int n_bound = 0;
    for (const auto& [edge, n] : edge_uses(mesh)) {
      n_bound += n == 3 ? 1 : 0;
      if (n == 3) {
        const auto& p = mesh.points[static_cast<std::size_t>(edge.first)];
        EXPECT_EQ(p.x, 0);
        EXPECT_EQ(p.y, 0);
      }
    }
    EXPECT_GE(n_bound, 4);
  }
}

TEST(DenseMesh, cuts_concave_polygons_within_themselves) {
  const std::vector<glm::dvec3> points = {{0, 0, 0},     {4, 0, 0},     {4, 4, 0},   {3.5, 4, 0},
                                          {3.5, 0.5, 0}, {0.5, 0.5, 0}, {0.5, 4, 0}, {0, 4, 0}};
  const DenseMesh before = mesh_of(points, {{0, 1, 2, 3, 4, 5, 6, 7}});
  const DenseMesh mesh = densified(before, DensifyMethod::Midpoint, 0.7);
  double area = 0;
  for (std::size_t face = 0; face < mesh.faces.n_rows(); ++face) {
    const glm::dvec3 part = area_vector(loop_of(mesh, face));
    EXPECT_GT(part.z, 0);
    area += part.z;
  }
  EXPECT_NEAR(area, areas(before)[0].z, 1e-12);
  EXPECT_LE(longest_edge(mesh), 0.7);
}

TEST(DenseMesh, by_loop_has_his_masks) {
  const DenseMesh mesh =
      densified(mesh_of(kOctahedron, kOctahedronFaces), DensifyMethod::Loop, 1.2);
  ASSERT_EQ(mesh.faces.n_rows(), 32u);
  // Valence 4: 1 − 4 w, w = (5/8 − (3/8)²) / 4.
  EXPECT_LT(glm::distance(mesh.points[2], glm::dvec3(0, 0, 33.0 / 64)), 1e-15);
  EXPECT_LT(glm::distance(mesh.points[3], glm::dvec3(-33.0 / 64, 0, 0)), 1e-15);
  for (std::size_t i = 6; i < 18; ++i) {  // 3/8 (a + b) + 1/8 (c − c)
    EXPECT_NEAR(glm::length(mesh.points[i]), 0.375 * std::sqrt(2.0), 1e-15);
  }
  // A border: 1/8, 3/4, 1/8; points of a single face stay.
  const DenseMesh strip =
      densified(mesh_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 1}, {0, 1, 0}, {1, 1, 0}, {2, 1, 1}},
                        {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}}),
                DensifyMethod::Loop, 1.45);
  EXPECT_LT(glm::distance(strip.points[1], glm::dvec3(1, 0, 0.125)), 1e-15);
  EXPECT_EQ(strip.points[2], glm::dvec3(2, 0, 1));
}

TEST(DenseMesh, by_smooth_methods_commutes_with_affine_maps) {
  const glm::dmat3 A(1.5, 0.25, -0.125, 0.5, 0.75, 0.375, -0.25, 0.125, 1.25);
  for (const DensifyMethod method : {DensifyMethod::Loop, DensifyMethod::CatmullClark}) {
    const DenseMesh before = mesh_of(kOctahedron, kOctahedronFaces);
    DenseMesh mapped = before;
    for (glm::dvec3& p : mapped.points) {
      p = A * p + glm::dvec3(3, 4, 5);
    }
    const DenseMesh mesh = densified(before, method, 0.99 * longest_edge(before));
    const DenseMesh other = densified(mapped, method, 0.99 * longest_edge(mapped));
    ASSERT_EQ(other.points.size(), mesh.points.size());
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
      EXPECT_LT(glm::distance(other.points[i], A * mesh.points[i] + glm::dvec3(3, 4, 5)), 1e-14);
    }
  }
}

TEST(DenseMesh, by_catmull_clark_has_their_masks) {
  std::vector<glm::dvec3> cube;
  for (int i = 0; i < 8; ++i) {
    cube.emplace_back((i & 1) * 2 - 1, (i >> 1 & 1) * 2 - 1, (i >> 2) * 2 - 1);
  }
  const Loops faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                       {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  const DenseMesh mesh = densified(mesh_of(cube, faces), DensifyMethod::CatmullClark, 1.2);
  ASSERT_EQ(mesh.points.size(), 26u);
  const auto has = [&](const glm::dvec3& place) {
    return std::ranges::any_of(
        mesh.points, [&](const glm::dvec3& p) { return glm::distance(p, place) < 1e-15; });
  };
  EXPECT_LT(glm::distance(mesh.points[7], glm::dvec3(5.0 / 9)), 1e-15);
  EXPECT_LT(glm::distance(mesh.points[0], glm::dvec3(-5.0 / 9)), 1e-15);
  EXPECT_TRUE(has({0.75, 0.75, 0}));
  EXPECT_TRUE(has({0, -0.75, 0.75}));
  EXPECT_TRUE(has({0, 0, 1}));
  // A border as a cubic spline.
  const DenseMesh strip =
      densified(mesh_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 1}, {0, 1, 0}, {1, 1, 0}, {2, 1, 1}},
                        {{0, 1, 4, 3}, {1, 2, 5, 4}}),
                DensifyMethod::CatmullClark, 1.2);
  EXPECT_LT(glm::distance(strip.points[1], glm::dvec3(1, 0, 0.125)), 1e-15);
  EXPECT_EQ(strip.points[2], glm::dvec3(2, 0, 1));
}

TEST(DenseMesh, refuses_what_it_cannot_do_with_the_numbers) {
  const DenseMesh house = mesh_of(kHouse, kHouseFaces);
  EXPECT_EQ(error_of(house, DensifyMethod::Midpoint, 1e-5),
            "densify: edges of at most 1e-05 would take 1.28e+11 faces or more, the limit is "
            "5e+07; the longest edge is 2: give a larger length");
  EXPECT_NE(error_of(house, DensifyMethod::CatmullClark, 1e-5).find("the limit is 5e+07"),
            std::string::npos);
  EXPECT_EQ(error_of(house, DensifyMethod::Loop, 1),
            "densify: face 0 has 4 corners, Loop's method is for triangles: use catmull-clark");
  for (const double length : {0.0, -1.0, static_cast<double>(NAN)}) {
    EXPECT_NE(error_of(house, DensifyMethod::Midpoint, length).find("must be positive"),
              std::string::npos);
  }
  const DenseMesh twice = mesh_of(kHouse, {{0, 1, 2}, {3, 4, 3}});
  EXPECT_EQ(error_of(twice, DensifyMethod::Loop, 1),
            "densify: face 1 contains point 3 twice, only midpoint takes such faces");
  EXPECT_EQ(error_of(twice, DensifyMethod::Midpoint, 1), "");
  const Progress cancel([](std::string_view, double) { return false; });
  EXPECT_THROW((void)densified(house, DensifyMethod::Midpoint, 0.1, cancel), Cancelled);
}

TEST(EarTriangles, fill_random_star_shaped_and_comb_polygons) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> radius(0.2, 1);
  for (int n = 3; n < 40; ++n) {
    std::vector<glm::dvec3> loop;
    for (int i = 0; i < n; ++i) {
      const double angle = 6.283185307179586 * i / n;
      loop.push_back(radius(random) * glm::dvec3(std::cos(angle), std::sin(angle), 0));
    }
    double area = 0;
    for (const auto& [a, b, c] : ear_triangles(loop)) {
      area += std::abs(glm::cross(loop[b] - loop[a], loop[c] - loop[a]).z);
    }
    EXPECT_NEAR(area, area_vector(loop).z, 1e-12) << n;
  }
}

}  // namespace
}  // namespace espalier
