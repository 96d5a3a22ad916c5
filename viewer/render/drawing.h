#pragma once

/// What a picture shows, as plain data in drawing units (drawing_frame.h): float positions near
/// the origin. Colours are display (sRGB) colours in [0,1]; widths are pixels of the picture.

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "viewer/render/picture.h"

namespace espalier::viewer {

/// Clay: the colour of a model that has none of its own.
inline constexpr glm::vec3 kClay{0.84F, 0.67F, 0.55F};

/// Triangles that follow one another and wear one picture.
struct TextureRange {
  std::size_t n_indices = 0;                 ///< Three a triangle.
  std::shared_ptr<const Picture> picture{};  ///< Repeats; in place of the colour. None: the colour.
};

/// A shaded surface, lit on both sides.
struct TriangleMesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;      ///< One a position: unit, or zero for the facet's own.
  std::vector<std::uint32_t> indices;  ///< Three a triangle.
  glm::vec3 color = kClay;
  float opacity = 1;                     ///< In [0,1]; below 1 what is behind shines through.
  std::vector<glm::vec2> places{};       ///< In the pictures, one a position, v upward; or none.
  std::vector<TextureRange> textures{};  ///< Of all indices, in their order; or none.
  float unit = 1;  ///< Drawing units that one of the positions' is long; above 0.
};

/// Straight lines of one width with round ends.
struct LineSet {
  std::vector<glm::vec3> points;  ///< Two a segment.
  std::vector<glm::vec3> colors;  ///< One a segment.
  float width = 2.5F;
  float hidden_opacity = 0.3F;  ///< In [0,1]: what is left of a line behind an opaque mesh.
};

/// Round dots that face the viewer.
struct PointSet {
  std::vector<glm::vec3> points;
  std::vector<glm::vec3> colors;  ///< One a point.
  float diameter = 11;
  float outline = 1.5F;  ///< Width of a dark rim inside the diameter; 0: none.
  float hidden_opacity = 0.3F;
};

/// How meshes are lit: as by lamps in a studio, or from the picture of a shiny ball, which
/// shows dents and folds better.
enum class Shading { Phong, Matcap };

/// A vertical gradient.
struct Background {
  glm::vec3 top{0.97F, 0.975F, 0.98F};
  glm::vec3 bottom{0.84F, 0.85F, 0.87F};
};

/// Everything in one picture.
struct Drawing {
  std::vector<TriangleMesh> meshes{};
  std::vector<LineSet> lines{};
  std::vector<PointSet> points{};
  Background background{};
};

}  // namespace espalier::viewer
