#pragma once

#include <memory>
#include <optional>
#include <span>

#include <glm/vec3.hpp>

#include "clients/native/render/camera.h"
#include "clients/native/render/picture.h"
#include "clients/native/render/scene.h"
#include "core/types/result.h"

namespace semblante::render {

struct PictureSize {
  int width = 512;
  int height = 512;
};

/// Draws one head without a window. Owns an OpenGL context, so it stays on the thread that made it.
class Renderer {
 public:
  /// Errors: unsupported, when there is no EGL or no OpenGL ES 3.
  static Result<Renderer> create(Scene scene);
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  [[nodiscard]] const Scene& scene() const;

  /// Sets deformed positions, one per file vertex, and updates normals. Errors: mismatch for another count.
  Status set_positions(std::span<const glm::vec3> positions);

  /// Errors: invalid_argument for a size outside 16..4096; internal when OpenGL reports a fault.
  Result<Picture> draw(const Camera& camera, PictureSize size = {});
  /// The same from a named view at a part of the NEUTRAL head, so that the camera does not follow the motion.
  Result<Picture> draw(View view, Subject subject, PictureSize size = {});

 private:
  struct Impl;
  explicit Renderer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace semblante::render
