#pragma once

#include "clients/native/render/camera.h"

namespace semblante::viewer {

/// A camera that goes around a head: front, turned by `yaw` and `pitch` (radians), at `distance` times the distance at
/// which the subject fills the picture.
class Orbit {
 public:
  /// Right and up are positive: the head's own left side appears as the yaw grows.
  void turn(float yaw, float pitch);
  void zoom(float factor);
  /// Back to the front.
  void reset();

  [[nodiscard]] render::Camera camera(const render::Box& subject, const render::Box& scene, float aspect) const;

 private:
  float yaw_ = 0;
  float pitch_ = 0;
  float distance_ = 1;
};

}  // namespace semblante::viewer
