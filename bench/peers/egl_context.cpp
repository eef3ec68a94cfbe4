#include "bench/peers/egl_context.h"

#include <EGL/eglext.h>

#include <cstdlib>

namespace hemicube::bench {
namespace {

/// The driver reads these when a display is opened.
void set_environment() {
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  setenv("GALLIUM_DRIVER", "llvmpipe", 1);
  setenv("LP_NUM_THREADS", "0", 1); // no thread but the caller's
}

} // namespace

std::unique_ptr<EglContext> EglContext::open(std::string* why) {
  std::unique_ptr<EglContext> context(new EglContext);
  if (!context->create(why))
    return nullptr;
  return context;
}

bool EglContext::create(std::string* why) {
  const auto fail = [&](const char* reason) {
    *why = reason;
    return false;
  };
  set_environment();
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (extensions == nullptr ||
      std::string(extensions).find("EGL_MESA_platform_surfaceless") == std::string::npos)
    return fail("EGL has no surfaceless platform");
  display_ = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display_ == EGL_NO_DISPLAY || eglInitialize(display_, nullptr, nullptr) != EGL_TRUE)
    return fail("no EGL display answers");
  if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE)
    return fail("EGL has no desktop OpenGL");
  const EGLint config_wish[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (eglChooseConfig(display_, config_wish, &config, 1, &count) != EGL_TRUE || count == 0)
    return fail("EGL has no OpenGL configuration");
  const EGLint context_wish[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 4,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 5,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_CONTEXT_OPENGL_NO_ERROR_KHR,
                                 EGL_TRUE,
                                 EGL_NONE};
  context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, context_wish);
  if (context_ == EGL_NO_CONTEXT ||
      eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE)
    return fail("no OpenGL 4.5 core context without a surface");
#define HC_LOAD(type, name)                                                                        \
  gl.name = reinterpret_cast<type>(eglGetProcAddress("gl" #name));                                 \
  if (gl.name == nullptr)                                                                          \
    return fail("gl" #name " is missing");
  HC_GL_FUNCTIONS(HC_LOAD)
#undef HC_LOAD
  if (description().find("llvmpipe") == std::string::npos)
    return fail("the driver that answers is not llvmpipe");
  return true;
}

EglContext::~EglContext() {
  if (display_ == EGL_NO_DISPLAY)
    return;
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  if (context_ != EGL_NO_CONTEXT)
    eglDestroyContext(display_, context_);
  eglTerminate(display_);
}

std::string EglContext::description() const {
  const auto text = [&](GLenum what) {
    const GLubyte* value = gl.GetString(what);
    return std::string(value == nullptr ? "" : reinterpret_cast<const char*>(value));
  };
  return text(GL_RENDERER) + ", " + text(GL_VERSION);
}

} // namespace hemicube::bench
