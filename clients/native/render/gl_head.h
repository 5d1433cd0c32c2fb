#pragma once

#include <memory>
#include <span>

#include <glm/vec3.hpp>

#include "clients/native/render/camera.h"
#include "clients/native/render/scene.h"
#include "core/types/result.h"

namespace semblante::render {

/// One head in the OpenGL ES 3 context that is current: the context must be current in each call, and when the head is
/// destroyed. All pictures of heads are drawn by it, those of a file and those of a window.
class GlHead {
 public:
  /// Errors: internal, when a shader does not compile.
  static Result<GlHead> create(Scene scene);
  ~GlHead();
  GlHead(GlHead&&) noexcept;
  GlHead& operator=(GlHead&&) noexcept;

  [[nodiscard]] const Scene& scene() const;

  /// Sets deformed positions, one per file vertex, and updates normals. Errors: mismatch for another count.
  Status set_positions(std::span<const glm::vec3> positions);

  /// Pixels along a side of each of the two shadow maps; 2048 at first.
  void set_shadow_side(int side);

  /// Draws onto a framebuffer of this size in pixels, whose colours the driver encodes as sRGB: light premultiplied by
  /// alpha, nothing behind the head.
  void draw(const Camera& camera, unsigned framebuffer, int width, int height);

 private:
  struct Impl;
  explicit GlHead(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace semblante::render
