#pragma once

/// Whether two boundary faces of a pose meet elsewhere than where they hang together.

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "deform/injectivity/boundary_seams.h"

namespace espalier {

/// What is known of a pair of faces.
struct FacePairResult {
  bool is_apart = false;
  std::size_t n_boxes = 0;  ///< pairs of parts that were looked at
  /// If not: places of the two where they surely pass through each other, if any were found.
  std::optional<std::array<glm::dvec2, 2>> crossing;
};

/// Looks at pairs of faces, or a face and itself, by cutting them in parts; a pair of parts is done
/// with
///   - where a plane separates their hulls;
///   - where they lie in one face, or in two that share a seam, with the slopes along a common
///     square in two cones such that n = a × b for a, b of either has n · d > 0 for one d: every
///     chord of the square's image is dx · a + dy · b, which is not zero [APS98]; d is the
///     direction from which the parts are seen, as in [VM94];
///   - where they share a corner, with a plane through it between them;
///   - where they are whole faces that share two straight edges at a corner, with the plane of
///     these between them: as two sides of the end of a slit do.
/// Certain within the rounding of control points. Keeps memory from call to call: one a thread.
class FacePairTester {
 public:
  /// tolerance: of a control point's coordinate.
  FacePairTester(const BoundaryMesh& mesh, double tolerance);

  /// most_boxes: pairs of parts that may be looked at, besides the first.
  [[nodiscard]] FacePairResult test(std::size_t a, std::size_t b, std::size_t most_boxes);

 private:
  /// Part of a face.
  struct Part {
    std::size_t face = 0;
    ParameterRectangle where;
    std::vector<glm::dvec3> points;
    glm::dvec2 lengths{0};  // of its net along s and t
  };

  [[nodiscard]] Part part_of(std::size_t face, const ParameterRectangle& where);
  [[nodiscard]] std::array<Part, 2> halves(const Part& part);

  [[nodiscard]] bool is_apart(const Part& a, const Part& b, bool is_one);
  [[nodiscard]] bool have_separate_hulls(const Part& a, const Part& b) const;
  [[nodiscard]] bool is_embedded(std::size_t face, const ParameterRectangle& where);
  [[nodiscard]] bool are_joined(const Part& a, const SeamUse& of_a, const Part& b,
                                const SeamUse& of_b);
  [[nodiscard]] bool are_divided_at(const Part& a, const CornerUse& of_a, const Part& b,
                                    const CornerUse& of_b);
  [[nodiscard]] bool are_divided_along(const Part& a, const std::array<SeamUse, 2>& of_a,
                                       const Part& b, const std::array<SeamUse, 2>& of_b) const;
  [[nodiscard]] bool share_two_straight_edges(const Part& a, const Part& b) const;
  [[nodiscard]] glm::dvec3 turn_above(glm::dvec3& normal) const;
  [[nodiscard]] bool have_separate_slopes();
  void append_slopes(std::size_t face, const ParameterRectangle& where, const glm::dvec2& signs,
                     int across);

  [[nodiscard]] std::optional<std::array<glm::dvec2, 2>> find_crossing(const Part& a,
                                                                       const Part& b) const;
  [[nodiscard]] bool is_real_crossing(std::size_t a, const glm::dvec2& at_a, std::size_t b,
                                      const glm::dvec2& at_b) const;
  [[nodiscard]] bool meet_at_leaf(std::size_t a, std::size_t b) const;

  const BoundaryMesh& mesh_;
  double tolerance_;
  std::array<std::vector<glm::dvec3>, 2> slopes_;  // across a seam, and along it
  std::vector<glm::dvec3> room_;
};

}  // namespace espalier
