#include "viewer/render/opengl_objects.h"

#include <glm/gtc/type_ptr.hpp>
#include <string>

#include "lattice/core/error.h"

namespace espalier::viewer {
namespace {

GLuint compile(GLenum stage, std::string_view source) {
  const GLuint shader = glCreateShader(stage);
  const char* text = source.data();
  const auto length = static_cast<GLint>(source.size());
  glShaderSource(shader, 1, &text, &length);
  glCompileShader(shader);
  GLint is_compiled = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &is_compiled);
  if (is_compiled == GL_FALSE) {
    std::string log(1024, '\0');
    GLsizei n = 0;
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &n, log.data());
    glDeleteShader(shader);
    throw Error("OpenGL refuses a shader: " + log.substr(0, static_cast<std::size_t>(n)));
  }
  return shader;
}

}  // namespace

GlProgram::GlProgram(std::string_view vertex_source, std::string_view fragment_source)
    : id_(glCreateProgram()) {
  for (const auto& [stage, source] :
       {std::pair<GLenum, std::string_view>{GL_VERTEX_SHADER, vertex_source},
        {GL_FRAGMENT_SHADER, fragment_source}}) {
    const GLuint shader = compile(stage, source);
    glAttachShader(id_, shader);
    glDeleteShader(shader);
  }
  glLinkProgram(id_);
  GLint is_linked = GL_FALSE;
  glGetProgramiv(id_, GL_LINK_STATUS, &is_linked);
  if (is_linked == GL_FALSE) {
    glDeleteProgram(id_);
    throw Error("OpenGL cannot link a shader program");
  }
}

GlProgram::~GlProgram() {
  glDeleteProgram(id_);
}

void GlProgram::set(const char* name, float value) const {
  glUniform1f(glGetUniformLocation(id_, name), value);
}

void GlProgram::set(const char* name, const glm::vec2& value) const {
  glUniform2f(glGetUniformLocation(id_, name), value.x, value.y);
}

void GlProgram::set(const char* name, const glm::vec3& value) const {
  glUniform3f(glGetUniformLocation(id_, name), value.x, value.y, value.z);
}

void GlProgram::set(const char* name, const glm::mat4& value) const {
  glUniformMatrix4fv(glGetUniformLocation(id_, name), 1, GL_FALSE, glm::value_ptr(value));
}

void check_opengl(std::string_view task) {
  const GLenum error = glGetError();
  while (glGetError() != GL_NO_ERROR) {
  }
  if (error == GL_OUT_OF_MEMORY) {
    throw Error("OpenGL has not enough memory to " + std::string(task));
  }
  if (error != GL_NO_ERROR) {
    throw Error("OpenGL error " + std::to_string(error) + ", trying to " + std::string(task));
  }
}

}  // namespace espalier::viewer
