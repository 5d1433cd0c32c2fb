#include "clients/gateways/vmc/receiver.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "clients/gateways/osc/packet.h"
#include "clients/gateways/vmc/turn.h"

namespace semblante::vmc {
namespace {

/// Smaller values are treated as noise of trackers, or as a blend shape that is not driven.
constexpr float is_driven = 1e-3F;
/// Cosine of half the angle from which on an eye's bone counts as turned: a tenth of a degree.
constexpr double is_turned = 0.9999996;

template <class T>
const T* value(const osc::Message& message, std::size_t index) {
  return index < message.arguments.size() ? std::get_if<T>(&message.arguments[index]) : nullptr;
}

std::optional<glm::dquat> rotation_at(const osc::Message& message, std::size_t first) {
  std::array<double, 4> xyzw{};
  for (std::size_t i = 0; i < xyzw.size(); ++i) {
    const float* part = value<float>(message, first + i);
    // Refuses values beyond 1e6: a unit quaternion has components of at most 1.
    if (part == nullptr || !std::isfinite(*part) || std::abs(*part) > 1e6F) return std::nullopt;
    xyzw[i] = static_cast<double>(*part);
  }
  const glm::dquat rotation(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
  const double length = glm::length(rotation);
  if (length < 1e-3) return std::nullopt;
  return rotation / length;
}

}  // namespace

Result<std::optional<ReceivedFace>> Receiver::take(std::span<const std::uint8_t> bytes, double arrival) {
  const auto packet = osc::read_packet(bytes);
  if (!packet) return packet.error();
  if (last_packet_ && arrival - *last_packet_ > forget_seconds) {
    values_ = Values();
    time_.reset();
    last_packet_.reset();
  }
  // A new sender may still send Apply: its first bundle may be an incomplete face.
  if (!last_packet_) last_apply_ = arrival;
  last_packet_ = arrival;
  bool applied = false;
  bool timed = false;
  for (const osc::Message& message : packet->messages) {
    const Effect effect = read(message);
    applied = applied || effect == Effect::apply;
    timed = timed || effect == Effect::time;
    changed_ = changed_ || effect == Effect::value;
    skipped_ += effect == Effect::wrong ? 1 : 0;
  }
  if (applied) last_apply_ = arrival;
  const bool applies = arrival - last_apply_ < apply_seconds;
  const bool finished = applied || (!applies && changed_ && (packet->is_bundle || timed));
  if (!finished) return std::optional<ReceivedFace>();
  ReceivedFace face;
  face.frame = face_from_values(values_, face.clamped);
  face.time = time_;
  time_.reset();
  changed_ = false;
  return std::optional<ReceivedFace>(face);
}

Receiver::Effect Receiver::read(const osc::Message& message) {
  if (message.address == "/VMC/Ext/Blend/Val") return read_blend(message);
  if (message.address == "/VMC/Ext/Blend/Apply") return Effect::apply;
  if (message.address == "/VMC/Ext/Bone/Pos") return read_bone(message);
  if (message.address != "/VMC/Ext/T") return Effect::nothing;
  const float* seconds = value<float>(message, 0);
  if (seconds == nullptr || !std::isfinite(*seconds)) return Effect::wrong;
  // After nine hours the resolution of a float is 4 ms: the packets' arrival is more precise.
  constexpr float coarse = 32'768.0F;
  if (std::abs(*seconds) < coarse) time_ = static_cast<double>(*seconds);
  return Effect::time;
}

Receiver::Effect Receiver::read_blend(const osc::Message& message) {
  const auto* name = value<std::string_view>(message, 0);
  const float* amount = value<float>(message, 1);
  if (name == nullptr || amount == nullptr || !std::isfinite(*amount)) return Effect::wrong;
  if (const auto shape = find_perfect_sync(*name)) {
    values_.perfect_sync[*shape] = *amount;
    values_.has_perfect_sync = values_.has_perfect_sync || *amount > is_driven;
  } else if (const auto preset = find_vrm_preset(*name)) {
    values_.presets[*preset] = *amount;
  } else {
    return Effect::nothing;
  }
  return Effect::value;
}

Receiver::Effect Receiver::read_bone(const osc::Message& message) {
  const auto* name = value<std::string_view>(message, 0);
  if (name == nullptr) return Effect::wrong;
  glm::dquat* bone = *name == "Head"       ? &values_.head
                     : *name == "Neck"     ? &values_.neck
                     : *name == "LeftEye"  ? &values_.eyes[0]
                     : *name == "RightEye" ? &values_.eyes[1]
                                           : nullptr;
  if (bone == nullptr) return Effect::nothing;
  const auto rotation = rotation_at(message, 4);
  if (!rotation) return Effect::wrong;
  *bone = mirror_x(*rotation);
  const bool is_eye = bone == &values_.eyes[0] || bone == &values_.eyes[1];
  values_.eye_bones = values_.eye_bones || (is_eye && std::abs(rotation->w) < is_turned);
  return Effect::value;
}

}  // namespace semblante::vmc
