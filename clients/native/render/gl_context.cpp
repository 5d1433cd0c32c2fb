#include "clients/native/render/gl_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

namespace semblante::render {
namespace {

Error refused(const char* step) {
  return {ErrorCode::unsupported, "egl",
          std::string(step) + " failed: rendering needs Mesa's EGL and OpenGL ES (libegl1, libgles2, libgl1-mesa-dri)"};
}

}  // namespace

Result<std::unique_ptr<GlContext>> GlContext::create() {
  const auto get_display =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
  if (get_display == nullptr) {
    return refused("eglGetPlatformDisplayEXT");
  }
  EGLDisplay display = get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE) {
    return refused("eglInitialize");
  }
  eglBindAPI(EGL_OPENGL_ES_API);
  const EGLint config_wish[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  eglChooseConfig(display, config_wish, &config, 1, &count);
  const EGLint context_wish[] = {EGL_CONTEXT_CLIENT_VERSION, 3, EGL_NONE};
  EGLContext context = eglCreateContext(display, count > 0 ? config : EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, context_wish);
  if (context == EGL_NO_CONTEXT) {
    return refused("eglCreateContext");
  }
  if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_FALSE) {
    eglDestroyContext(display, context);
    return refused("eglMakeCurrent");
  }
  return std::unique_ptr<GlContext>(new GlContext(display, context));
}

GlContext::~GlContext() {
  // The display is shared by the whole process, so it stays open.
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
}

void GlContext::make_current() const { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_); }

}  // namespace semblante::render
