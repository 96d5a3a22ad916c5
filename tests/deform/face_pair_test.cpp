#include "deform/injectivity/face_pair.h"

#include <gtest/gtest.h>

#include <array>

#include "lattice/volume/bezier_patch.h"

namespace espalier {
namespace {

/// A bilinear face through corners (0, 0), (1, 0), (0, 1) and (1, 1).
FaceNet bilinear(const std::array<glm::dvec3, 4>& corners) {
  BezierPatch patch;
  for (const double depth : {0.0, 1.0}) {
    for (const glm::dvec3& corner : corners) {
      patch.points.push_back(corner + glm::dvec3(depth, 0, 0));
    }
  }
  return {patch, 4};
}

/// The sides of a slit's end, joined along the edges s = 0 and t = 0 of both, with the fourth
/// corners this far from the plane of these edges, which nearly go on in each other.
BoundaryMesh slit_end(double of_a, double of_b) {
  const glm::dvec3 corner(0, 0.75, -0.1);
  const glm::dvec3 along = corner + glm::dvec3(0, 0.0003, -0.000305);
  const glm::dvec3 back = corner + glm::dvec3(0, -0.000305, 0.0003);
  const auto inner = [&](double height) { return corner + glm::dvec3(height, -0.00002, -0.00002); };
  BoundaryMesh mesh;
  mesh.faces = {{0, 4, true}, {1, 4, true}};
  mesh.pose = {bilinear({corner, along, back, inner(of_a)}),
               bilinear({corner, back, along, inner(of_b)})};
  mesh.rest = mesh.pose;
  mesh.rest_size = 1;
  mesh.seams = {{{0, 1, 0, 0, 1}, {1, 0, 0, 0, 1}}, {{0, 0, 0, 0, 1}, {1, 1, 0, 0, 1}}};
  mesh.corners = {{{0, {0, 0}}, {1, {1, 0}}, {2, {0, 1}}}, {{0, {0, 0}}, {1, {0, 1}}, {2, {1, 0}}}};
  return mesh;
}

bool are_apart(const BoundaryMesh& mesh) {
  return FacePairTester(mesh, 1e-13).test(0, 1, 400).is_apart;
}

TEST(FacePair, sides_of_the_end_of_a_slit_are_apart_where_it_opens) {
  for (const double opening : {1e-3, 1e-7, 1e-10}) {
    EXPECT_TRUE(are_apart(slit_end(opening, -opening))) << opening;
    EXPECT_TRUE(are_apart(slit_end(-opening, opening))) << opening;
  }
}

TEST(FacePair, sides_of_a_slit_that_lie_in_each_other_or_too_near_are_not_told_apart) {
  EXPECT_FALSE(are_apart(slit_end(1e-7, 1e-7)));
  EXPECT_FALSE(are_apart(slit_end(0, -1e-7)));
  EXPECT_FALSE(are_apart(slit_end(1e-14, -1e-14)));
}

TEST(FacePair, faces_that_share_one_edge_only_are_not_taken_for_a_slit) {
  BoundaryMesh mesh = slit_end(1e-7, -1e-7);
  mesh.seams = {{{0, 1, 0, 0, 1}, {1, 0, 0, 0, 1}}, {{0, 0, 0, 0, 1}, {2, 1, 0, 0, 1}}};
  EXPECT_FALSE(are_apart(mesh));
}

}  // namespace
}  // namespace espalier
