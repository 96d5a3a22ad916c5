#pragma once

/// The OpenGL back end's programs. Only that back end includes this.

#include "viewer/render/opengl_objects.h"

namespace espalier::viewer {

/// Where shaders find what a vertex (mesh) or an instance (lines, points) consists of.
inline constexpr GLuint kPositionAttribute = 0;  ///< Vertex, start of a segment, centre of a dot.
inline constexpr GLuint kNormalAttribute = 1;    ///< Of a mesh.
inline constexpr GLuint kEndAttribute = 1;       ///< Of a segment.
inline constexpr GLuint kPlaceAttribute = 3;     ///< Of a mesh with a texture.
inline constexpr GLuint kColorAttribute = 2;     ///< Of a segment or dot.

/// Uniforms of all three: mat4 view, mat4 projection, vec2 viewport (pixels), float opacity.
struct OpenglShaders {
  GlProgram background;  ///< Three vertices; vec3 top, bottom; vec2 heights: of the lower and upper
                         ///< edge of the viewport in the picture, from 0 to 1.
  GlProgram mesh;    ///< vec3 color; float unit, has_texture, is_matcap; the texture is in unit 0.
  GlProgram lines;   ///< Four vertices an instance; float width, least_w, only_core, round_ends.
  GlProgram points;  ///< Four vertices an instance; float diameter, outline, least_w, only_core.

  OpenglShaders();
};

}  // namespace espalier::viewer
