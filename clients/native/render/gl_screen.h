#pragma once

#include <memory>
#include <string_view>

#include "clients/native/render/camera.h"
#include "clients/native/render/gl_head.h"
#include "clients/native/render/picture.h"
#include "core/types/result.h"

namespace semblante::render {

/// Draws heads to the window of the OpenGL ES 3 context that is current: its framebuffer 0, whose colours need not be
/// sRGB. The context must be current in each call, and at the end.
class GlScreen {
 public:
  /// Errors: internal, when a shader does not compile.
  static Result<GlScreen> create();
  ~GlScreen();
  GlScreen(GlScreen&&) noexcept;
  GlScreen& operator=(GlScreen&&) noexcept;

  /// `head` over the backdrop, or only the backdrop for null, with `words` (ASCII, lines) at the lower edge. `samples`
  /// per pixel: 1 (rough edges) or more, limited to what the driver has. Errors: internal, when OpenGL reports a fault.
  Status draw(GlHead* head, const Camera& camera, int width, int height, int samples, std::string_view words);

  /// What the last draw() put there; before the window is swapped.
  [[nodiscard]] Picture read() const;

 private:
  struct Impl;
  explicit GlScreen(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace semblante::render
