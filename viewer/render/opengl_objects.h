#pragma once

/// OpenGL's objects, freed at the end of their scope. The context that made them must be current
/// then. Only the OpenGL back end includes this.

#include <epoxy/gl.h>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <utility>

namespace espalier::viewer {

/// Owns one object; Kind creates and destroys it.
template <class Kind>
class GlObject {
 public:
  GlObject() : id_(Kind::create()) {}
  GlObject(GlObject&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  GlObject(const GlObject&) = delete;
  GlObject& operator=(const GlObject&) = delete;
  ~GlObject() {
    if (id_ != 0) {
      Kind::destroy(id_);
    }
  }
  [[nodiscard]] GLuint id() const { return id_; }

 private:
  GLuint id_;
};

struct GlBufferKind {
  static GLuint create() {
    GLuint id = 0;
    glGenBuffers(1, &id);
    return id;
  }
  static void destroy(GLuint id) { glDeleteBuffers(1, &id); }
};
struct GlVertexArrayKind {
  static GLuint create() {
    GLuint id = 0;
    glGenVertexArrays(1, &id);
    return id;
  }
  static void destroy(GLuint id) { glDeleteVertexArrays(1, &id); }
};
struct GlRenderbufferKind {
  static GLuint create() {
    GLuint id = 0;
    glGenRenderbuffers(1, &id);
    return id;
  }
  static void destroy(GLuint id) { glDeleteRenderbuffers(1, &id); }
};
struct GlFramebufferKind {
  static GLuint create() {
    GLuint id = 0;
    glGenFramebuffers(1, &id);
    return id;
  }
  static void destroy(GLuint id) { glDeleteFramebuffers(1, &id); }
};

struct GlTextureKind {
  static GLuint create() {
    GLuint id = 0;
    glGenTextures(1, &id);
    return id;
  }
  static void destroy(GLuint id) { glDeleteTextures(1, &id); }
};

using GlTexture = GlObject<GlTextureKind>;
using GlBuffer = GlObject<GlBufferKind>;
using GlVertexArray = GlObject<GlVertexArrayKind>;
using GlRenderbuffer = GlObject<GlRenderbufferKind>;
using GlFramebuffer = GlObject<GlFramebufferKind>;

/// A vertex and a fragment shader, linked.
class GlProgram {
 public:
  /// Throws Error with the compiler's words if a source is wrong for this driver.
  GlProgram(std::string_view vertex_source, std::string_view fragment_source);
  GlProgram(const GlProgram&) = delete;
  GlProgram& operator=(const GlProgram&) = delete;
  ~GlProgram();

  /// Draws go through this program until another is used; set() needs that.
  void use() const { glUseProgram(id_); }
  void set(const char* name, float value) const;
  void set(const char* name, const glm::vec2& value) const;
  void set(const char* name, const glm::vec3& value) const;
  void set(const char* name, const glm::mat4& value) const;

 private:
  GLuint id_;
};

/// Replaces the whole content of a buffer.
template <class T>
void upload(const GlBuffer& buffer, std::span<const T> values) {
  glBindBuffer(GL_COPY_WRITE_BUFFER, buffer.id());
  glBufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(values.size_bytes()), values.data(),
               GL_DYNAMIC_DRAW);
}

/// Replaces the values from `first` on.
template <class T>
void upload_range(const GlBuffer& buffer, std::size_t first, std::span<const T> values) {
  glBindBuffer(GL_COPY_WRITE_BUFFER, buffer.id());
  glBufferSubData(GL_COPY_WRITE_BUFFER, static_cast<GLintptr>(first * sizeof(T)),
                  static_cast<GLsizeiptr>(values.size_bytes()), values.data());
}

/// Throws Error if the last calls failed, for lack of memory or through a mistake of ours.
void check_opengl(std::string_view task);

}  // namespace espalier::viewer
