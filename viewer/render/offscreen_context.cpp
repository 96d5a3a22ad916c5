#include "viewer/render/offscreen_context.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string_view>
#include <vector>

#include "lattice/core/error.h"

namespace espalier::viewer {

struct OffscreenContext::Handles {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
};

namespace {

/// One of the shared libraries can be loaded; it then stays loaded.
bool can_load_one_of(std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (dlopen(name, RTLD_LAZY | RTLD_LOCAL) != nullptr) {
      return true;
    }
  }
  return false;
}

/// epoxy ends the process when these are missing; an exception can be told to the user.
void require_libraries() {
  if (!can_load_one_of({"libEGL.so.1"})) {
    throw Error("cannot draw: libEGL.so.1 is missing (Debian: libegl1, libegl-mesa0)");
  }
  if (!can_load_one_of({"libOpenGL.so.0", "libGL.so.1"})) {
    throw Error("cannot draw: libGL.so.1 is missing (Debian: libgl1, libgl1-mesa-dri)");
  }
}

bool has_extension(EGLDisplay display, std::string_view wanted) {
  const char* names = eglQueryString(display, EGL_EXTENSIONS);
  std::string_view rest = names != nullptr ? names : "";
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    if (rest.substr(0, end) == wanted) {
      return true;
    }
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return false;
}

/// Displays that need no window system, the most modest one first.
std::vector<EGLDisplay> candidate_displays() {
  std::vector<EGLDisplay> displays;
  if (has_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base")) {
    if (has_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
      displays.push_back(
          eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
    }
    if (has_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") &&
        has_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")) {
      std::array<EGLDeviceEXT, 8> devices{};
      EGLint n = 0;
      if (eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &n) != 0) {
        for (EGLint i = 0; i < n; ++i) {
          displays.push_back(
              eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices.at(i), nullptr));
        }
      }
    }
  }
  displays.push_back(eglGetDisplay(EGL_DEFAULT_DISPLAY));
  return displays;
}

constexpr std::array<EGLint, 7> kContextAttributes{EGL_CONTEXT_MAJOR_VERSION,
                                                   3,
                                                   EGL_CONTEXT_MINOR_VERSION,
                                                   3,
                                                   EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                   EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                   EGL_NONE};

/// A current context of the display, or EGL_NO_CONTEXT.
EGLContext current_context_of(EGLDisplay display) {
  if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == 0 ||
      !has_extension(display, "EGL_KHR_surfaceless_context") ||
      !has_extension(display, "EGL_KHR_no_config_context") || eglBindAPI(EGL_OPENGL_API) == 0) {
    return EGL_NO_CONTEXT;
  }
  EGLContext context =
      eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, kContextAttributes.data());
  if (context != EGL_NO_CONTEXT &&
      eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == 0) {
    eglDestroyContext(display, context);
    return EGL_NO_CONTEXT;
  }
  return context;
}

std::string text_of(GLenum name) {
  const GLubyte* text = glGetString(name);
  return text != nullptr ? reinterpret_cast<const char*>(text) : "";
}

}  // namespace

OffscreenContext::OffscreenContext() : handles_(std::make_unique<Handles>()) {
  require_libraries();
  for (EGLDisplay display : candidate_displays()) {
    handles_->context = current_context_of(display);
    if (handles_->context != EGL_NO_CONTEXT) {
      handles_->display = display;
      return;
    }
  }
  throw Error(
      "cannot draw: EGL gives no OpenGL 3.3 context (Debian: libgl1-mesa-dri draws "
      "without a GPU)");
}

OffscreenContext::~OffscreenContext() {
  // The display itself is the whole process's: terminating it would end other contexts, too.
  if (eglGetCurrentContext() == handles_->context) {
    eglMakeCurrent(handles_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
  eglDestroyContext(handles_->display, handles_->context);
}

std::string OffscreenContext::description() const {
  return text_of(GL_RENDERER) + ", " + text_of(GL_VERSION);
}

}  // namespace espalier::viewer
