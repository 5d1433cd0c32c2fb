#pragma once

#include <array>
#include <vector>

#include <glm/gtc/quaternion.hpp>

#include "clients/gateways/vmc/vrm_blends.h"
#include "core/bridges/arkit.h"
#include "core/kernel/semblante_kernel.h"

namespace semblante::vmc {

/// The values of a face in VMC. Rotations are unit quaternions about the axes of turn.h, all numbers are finite.
struct Values {
  ArkitCoefficients perfect_sync{};                                       ///< blend values with ARKit's names
  bool has_perfect_sync = false;                                          ///< one of `perfect_sync` was not 0
  std::vector<float> presets = std::vector<float>(vrm_presets().size());  ///< by vrm_presets()
  glm::dquat neck{1, 0, 0, 0}, head{1, 0, 0, 0};                          ///< head: relative to the neck
  std::array<glm::dquat, 2> eyes{glm::dquat(1, 0, 0, 0),
                                 glm::dquat(1, 0, 0, 0)};  ///< left, right, relative to the head
  bool eye_bones = false;  ///< an eye was rotated: the gaze is from bones, not from blend values
};

/// Converts values to a face, with every FAP within its range. Low-level FAPs and FAP 1 are computed by core/bridges
/// from perfect sync; only without perfect sync, from the presets of mouth, lids and gaze, because a sender of both
/// sends the same motion twice. FAP 2 has the two strongest of the presets' expressions (of equal ones the lower
/// numbers). FAPs 48 to 50 are the combined rotation of neck and head. Values are clamped to 0..1; `clamped` is the
/// number of those outside.
semblante_frame face_from_values(const Values& values, std::size_t& clamped);

/// The values that a VMC sender sends for a face. With `presets` the expressions of FAP 2 that have a preset are sent
/// only as that preset and removed from perfect sync, because avatars add both; the presets of mouth and lids repeat
/// perfect sync, for avatars without such shapes. With `bones` the presets of the gaze are 0, because the eye bones
/// have it. The frame's FAPs must be finite.
Values values_from_face(const semblante_frame& frame, bool presets, bool bones);

}  // namespace semblante::vmc
