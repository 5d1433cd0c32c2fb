#pragma once

#include <limits>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "protocol/package/gltf_builder.h"

namespace semblante {

/// Values over time that come one by one, of which those are kept that a straight line between the kept ones does not
/// give within `tolerance` (length of the difference). Memory is that of what is kept.
///
/// A swinging door: from the last key on, each value narrows the slopes that a line through it may have; a value
/// outside them ends the line at the one before. Every kept key is a value that came, and the last one is kept.
class VectorTrack {
 public:
  explicit VectorTrack(double tolerance);
  /// Times rise.
  void push(float time, const glm::vec3& value);
  /// Once, after the last value. One key where all are alike.
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
  glm::dvec3 low_{0.0}, high_{0.0};  ///< slopes that are left
};

/// The same of turns, which glTF interpolates along the shorter arc: `tolerance` in radians. A line is at most
/// `max_span` values long, for each is checked against all it leaves out.
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
