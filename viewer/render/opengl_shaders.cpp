#include "viewer/render/opengl_shaders.h"

#include <string>

namespace espalier::viewer {
namespace {

/// Colours come as display colours and are written as linear light: the frame buffer converts.
constexpr const char* kCommon = R"(#version 330 core
uniform mat4 view;
uniform mat4 projection;
uniform vec2 viewport;
uniform float opacity;
vec3 linear(vec3 color) {
  color = clamp(color, 0.0, 1.0);
  return mix(color / 12.92, pow((color + 0.055) / 1.055, vec3(2.4)), greaterThan(color, vec3(0.04045)));
}
)";

constexpr const char* kBackgroundVertex = R"(
uniform vec2 heights;
out float height;
void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  height = mix(heights.x, heights.y, 0.5 * corner.y + 0.5);
  gl_Position = vec4(corner, 0.0, 1.0);
}
)";

constexpr const char* kBackgroundFragment = R"(
uniform vec3 top;
uniform vec3 bottom;
in float height;
out vec4 pixel;
void main() { pixel = vec4(linear(mix(bottom, top, height)), 1.0); }
)";

constexpr const char* kMeshVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 3) in vec2 place;
uniform float unit;
out vec2 texture_place;
out vec3 eye_position;
centroid out vec3 eye_normal;
void main() {
  vec4 placed = view * vec4(unit * position, 1.0);
  eye_position = placed.xyz;
  eye_normal = mat3(view) * normal;
  texture_place = place;
  gl_Position = projection * placed;
}
)";

/// A studio that moves with the camera: a warm key light from the upper left, a cool fill from the
/// right, a light from behind that sets off the outline, and a sky above a floor.
constexpr const char* kMeshFragment = R"(
uniform vec3 color;
uniform float has_texture;
uniform float is_matcap;
uniform sampler2D image;
in vec3 eye_position;
in vec2 texture_place;
centroid in vec3 eye_normal;
out vec4 pixel;

const vec3 key_direction = normalize(vec3(-0.55, 0.75, 0.50));
const vec3 fill_direction = normalize(vec3(0.85, 0.15, 0.50));
const vec3 back_direction = normalize(vec3(0.35, 0.55, -0.75));
const vec3 key_light = vec3(0.90, 0.85, 0.78);
const vec3 fill_light = vec3(0.10, 0.12, 0.15);
const vec3 back_light = vec3(0.16, 0.17, 0.19);
const vec3 sky_light = vec3(0.28, 0.30, 0.33);
const vec3 floor_light = vec3(0.17, 0.145, 0.125);

// Light that reaches a little around the shape, as that of a wide lamp does.
float wrapped(float cosine) { return max((cosine + 0.25) / 1.25, 0.0); }

// Both sides are lit: the normal is turned to the side of the facet that is seen.
vec3 lit_normal(vec3 to_eye) {
  vec3 facet = cross(dFdx(eye_position), dFdy(eye_position));
  float size = length(facet);
  facet = size > 0.0 ? facet / size : to_eye;
  facet = dot(facet, to_eye) < 0.0 ? -facet : facet;
  float strength = length(eye_normal);
  vec3 normal = strength > 1e-3 ? eye_normal / strength : facet;
  return dot(normal, facet) < 0.0 ? -normal : normal;
}

// Where the texture covers nothing, places are far below 0.
vec3 own_color() {
  vec3 covered = texture(image, vec2(texture_place.x, 1.0 - texture_place.y)).rgb;
  return has_texture > 0.0 && texture_place.x > -9e3 ? covered : linear(color);
}

// A ball of dark lacquer in the same studio, looked up where it has this normal.
vec3 ball(vec3 normal, vec3 to_eye) {
  vec3 right = normalize(vec3(to_eye.z, 0.0, -to_eye.x));
  vec2 at = vec2(dot(normal, right), dot(normal, cross(to_eye, right)));
  float rim = smoothstep(0.55, 1.0, length(at));
  float key = smoothstep(1.3, 0.0, distance(at, vec2(-0.40, 0.45)));
  float window = smoothstep(0.30, 0.12, distance(at, vec2(-0.38, 0.45)));
  float fill = smoothstep(0.45, 0.0, distance(at, vec2(0.62, -0.45)));
  return own_color() * (0.05 + 0.95 * key * key) * (1.0 - 0.75 * rim)
         + 0.30 * window * key_light + 0.22 * fill * vec3(0.55, 0.70, 1.0)
         + 0.10 * rim * max(at.y, 0.0) * sky_light;
}

void main() {
  vec3 to_eye = projection[2][3] == 0.0 ? vec3(0.0, 0.0, 1.0) : normalize(-eye_position);
  vec3 normal = lit_normal(to_eye);
  if (is_matcap > 0.0) {
    pixel = vec4(ball(normal, to_eye), opacity);
    return;
  }
  vec3 light = mix(floor_light, sky_light, 0.5 + 0.5 * normal.y)
             + key_light * wrapped(dot(normal, key_direction))
             + fill_light * wrapped(dot(normal, fill_direction))
             + back_light * wrapped(dot(normal, back_direction));
  float facing = max(dot(normal, to_eye), 0.0);
  float shine = pow(max(dot(normal, normalize(key_direction + to_eye)), 0.0), 28.0);
  vec3 lit = own_color() * light + 0.06 * shine * key_light
           + 0.16 * pow(1.0 - facing, 4.0) * sky_light;
  pixel = vec4(lit, opacity);
}
)";

/// The depth of something drawn a few pixels' size nearer to the eye than it is, so that a flat
/// mark on a surface is not swallowed by it.
constexpr const char* kMarkVertex = R"(
uniform vec2 depths;
noperspective out float clear;
float raised_depth(vec4 eye, float pixels) {
  float w = projection[2][3] * eye.z + projection[3][3];
  float pixel_size = 2.0 * w / (projection[1][1] * viewport.y);
  float z = eye.z + min(pixels * pixel_size, projection[2][3] == 0.0 ? 1e30 : 0.5 * w);
  return (projection[2][2] * z + projection[3][2]) / (projection[2][3] * z + projection[3][3]);
}
// What stands in the farther half of the scene is paler, the more the farther.
float clearness(vec4 eye) {
  float depth = (-eye.z - depths.x) / (depths.y - depths.x);
  return 1.0 - 0.35 * clamp(1.5 * depth - 0.5, 0.0, 1.0);
}
const vec4 nowhere = vec4(2.0, 2.0, 0.0, 1.0);
)";

constexpr const char* kLinesVertex = R"(
layout(location = 0) in vec3 start;
layout(location = 1) in vec3 end;
layout(location = 2) in vec3 color;
uniform float width;
uniform float least_w;
flat out vec3 line_color;
flat out float line_length;
noperspective out vec2 place;

void main() {
  vec4 eye[2] = vec4[2](view * vec4(start, 1.0), view * vec4(end, 1.0));
  vec4 clip[2] = vec4[2](projection * eye[0], projection * eye[1]);
  line_color = linear(color);
  line_length = 0.0;
  clear = 1.0;
  place = vec2(0.0);
  gl_Position = nowhere;
  if (max(clip[0].w, clip[1].w) <= least_w) return;
  for (int i = 0; i < 2; ++i) {
    if (clip[i].w < least_w) {
      float t = (least_w - clip[i].w) / (clip[1 - i].w - clip[i].w);
      eye[i] = mix(eye[i], eye[1 - i], t);
      clip[i] = projection * eye[i];
    }
  }
  vec2 pixels[2] = vec2[2](0.5 * viewport * clip[0].xy / clip[0].w,
                           0.5 * viewport * clip[1].xy / clip[1].w);
  vec2 along = pixels[1] - pixels[0];
  line_length = length(along);
  along = line_length > 1e-6 ? along / line_length : vec2(1.0, 0.0);
  float reach = 0.5 * width + 1.0;
  int at = gl_VertexID & 1;
  float across = (gl_VertexID & 2) == 0 ? -reach : reach;
  float beyond = at == 0 ? -reach : reach;
  vec2 corner = pixels[at] + along * beyond + vec2(-along.y, along.x) * across;
  clear = clearness(eye[at]);
  place = vec2(at == 0 ? beyond : line_length + beyond, across);
  gl_Position = vec4(2.0 * corner / viewport, raised_depth(eye[at], 1.5 * width), 1.0);
}
)";

constexpr const char* kLinesFragment = R"(
uniform float width;
uniform float only_core;
uniform float round_ends;
flat in vec3 line_color;
flat in float line_length;
noperspective in vec2 place;
noperspective in float clear;
out vec4 pixel;
void main() {
  float beyond = max(max(-place.x, place.x - line_length), 0.0);
  float coverage = clamp(0.5 * width + 0.5 - length(vec2(beyond, place.y)), 0.0, 1.0);
  if (round_ends == 0.0) {
    float inside = clamp(min(place.x, line_length - place.x) + 0.5, 0.0, 1.0);
    coverage = clamp(0.5 * width + 0.5 - abs(place.y), 0.0, 1.0) * inside;
  }
  if (coverage <= 0.99 * only_core) discard;
  pixel = vec4(line_color, coverage * clear * opacity);
}
)";

constexpr const char* kPointsVertex = R"(
layout(location = 0) in vec3 center;
layout(location = 2) in vec3 color;
uniform float diameter;
uniform float least_w;
flat out vec3 dot_color;
noperspective out vec2 place;

void main() {
  vec4 eye = view * vec4(center, 1.0);
  vec4 clip = projection * eye;
  dot_color = linear(color);
  clear = clearness(eye);
  place = vec2(0.0);
  gl_Position = nowhere;
  if (clip.w <= least_w) return;
  vec2 corner = vec2((gl_VertexID & 1) == 0 ? -1.0 : 1.0, (gl_VertexID & 2) == 0 ? -1.0 : 1.0);
  place = corner * (0.5 * diameter + 1.0);
  gl_Position = vec4(clip.xy / clip.w + 2.0 * place / viewport, raised_depth(eye, diameter), 1.0);
}
)";

constexpr const char* kPointsFragment = R"(
uniform float diameter;
uniform float outline;
uniform float only_core;
flat in vec3 dot_color;
noperspective in vec2 place;
noperspective in float clear;
out vec4 pixel;
void main() {
  float from_edge = 0.5 * diameter + 0.5 - length(place);
  float coverage = clamp(from_edge, 0.0, 1.0);
  if (coverage <= 0.99 * only_core) discard;
  float inside = clamp(from_edge - outline, 0.0, 1.0);
  float glow = 1.0 + 0.35 * dot(place, vec2(-0.5, 0.7)) / max(0.5 * diameter, 1.0);
  pixel = vec4(dot_color * mix(0.18, glow, inside), coverage * clear * opacity);
}
)";

std::string stage(const char* own, const char* shared = "") {
  return std::string(kCommon) + shared + own;
}

}  // namespace

OpenglShaders::OpenglShaders()
    : background(stage(kBackgroundVertex), stage(kBackgroundFragment)),
      mesh(stage(kMeshVertex), stage(kMeshFragment)),
      lines(stage(kLinesVertex, kMarkVertex), stage(kLinesFragment)),
      points(stage(kPointsVertex, kMarkVertex), stage(kPointsFragment)) {}

}  // namespace espalier::viewer
