#pragma once

#include <limits>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "protocol/package/gltf_builder.h"

namespace semblante {

/// Thins values over time, given one by one: keeps those that linear interpolation between the kept ones does not
/// reproduce within `tolerance` (length of the difference). Only kept values take memory.
///
/// The swinging-door algorithm: from the last key on, each value narrows the range of slopes; a value outside it ends
/// the line at the value before. Every key is a given value, and the last value is a key.
class VectorTrack {
 public:
  explicit VectorTrack(double tolerance);
  /// Times rise.
  void push(float time, const glm::vec3& value);
  /// To be called once, after the last value. Gives one key if all values are equal.
  void finish();
  [[nodiscard]] const std::vector<float>& times() const { return times_; }
  [[nodiscard]] const std::vector<glm::vec3>& values() const { return values_; }

 private:
  void keep_last();

  double slack_;  ///< of each coordinate
  std::vector<float> times_;
  std::vector<glm::vec3> values_;
  float last_time_ = 0.0F;
  glm::vec3 last_{0.0F};
  glm::dvec3 low_{0.0}, high_{0.0};  ///< remaining range of slopes
};

/// The same for rotations, which glTF interpolates along the shorter arc: `tolerance` in radians. A line has at most
/// `max_span` values, because each is checked against all omitted ones.
class TurnTrack {
 public:
  explicit TurnTrack(double tolerance) : tolerance_(tolerance) {}
  void push(float time, const glm::quat& value);
  void finish();
  [[nodiscard]] const std::vector<float>& times() const { return times_; }
  [[nodiscard]] const std::vector<glm::quat>& values() const { return values_; }

  static constexpr std::size_t max_span = 64;

 private:
  struct Sample {
    float time;
    glm::quat value;
  };
  [[nodiscard]] bool leads_to(const Sample& end) const;
  void keep(const Sample& sample);

  double tolerance_;
  std::vector<float> times_;
  std::vector<glm::quat> values_;
  std::vector<Sample> since_;  ///< after the last key
};

}  // namespace semblante
