#pragma once

#include <memory>

#include "core/types/result.h"

namespace semblante::render {

/// An OpenGL ES 3 context without a window or display server (EGL surfaceless platform of Mesa). Belongs to the thread
/// that last called make_current; not thread-safe.
class GlContext {
 public:
  /// Errors: unsupported, with the step of EGL that failed.
  static Result<std::unique_ptr<GlContext>> create();
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  void make_current() const;

 private:
  GlContext(void* display, void* context) : display_(display), context_(context) {}
  void* display_;
  void* context_;
};

}  // namespace semblante::render
