#include "clients/native/viewer/orbit.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace semblante::viewer {
namespace {

constexpr float steepest = 1.2F;  // radians
constexpr float nearest = 0.45F;
constexpr float farthest = 3.0F;

}  // namespace

void Orbit::turn(float yaw, float pitch) {
  yaw_ += yaw;
  pitch_ = std::clamp(pitch_ + pitch, -steepest, steepest);
}

void Orbit::zoom(float factor) { distance_ = std::clamp(distance_ * factor, nearest, farthest); }

void Orbit::reset() { *this = {}; }

render::Camera Orbit::camera(const render::Box& subject, const render::Box& scene, float aspect) const {
  render::Camera camera = render::frame_box(subject, scene, render::View::front, aspect);
  if (yaw_ == 0 && pitch_ == 0 && distance_ == 1) {
    return camera;
  }
  const float away = glm::length(camera.eye - camera.target) * distance_;
  camera.eye = camera.target +
               away * glm::vec3(std::sin(yaw_) * std::cos(pitch_), std::sin(pitch_), std::cos(yaw_) * std::cos(pitch_));
  // A ball around the target holds the scene, whatever the direction.
  const float reach = glm::length(camera.target - scene.centre()) + glm::length(scene.size());
  camera.near_plane = std::max(away - reach, 0.02F * away);
  camera.far_plane = away + reach;
  return camera;
}

}  // namespace semblante::viewer
