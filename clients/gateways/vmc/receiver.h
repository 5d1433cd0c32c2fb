#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "clients/gateways/vmc/values.h"
#include "core/types/result.h"

namespace semblante::osc {
struct Message;
}

namespace semblante::vmc {

/// A complete face from a VMC sender.
struct ReceivedFace {
  semblante_frame frame{};     ///< every FAP within its range
  std::optional<double> time;  ///< seconds of the sender's clock, if sent since the last face
  std::size_t clamped = 0;     ///< number of values clamped to 0..1
};

/// Gathers the values of a VMC sender, packet by packet; a value is kept until it is sent again, or until nothing has
/// arrived for `forget_seconds`. Addresses, blend values and bones unrelated to a face are skipped. So are, as the
/// protocol requires, messages with too few values or wrong types; and those with a number that is not finite or an
/// invalid rotation.
///
/// A packet with /VMC/Ext/Blend/Apply completes a face. If a sender sends no Apply for `apply_seconds`, each bundle
/// with a changed value completes a face, and so does each single message /VMC/Ext/T after a change.
class Receiver {
 public:
  static constexpr double forget_seconds = 5.0;
  static constexpr double apply_seconds = 1.0;

  /// `arrival`: seconds of a monotonic clock. Returns the face, if the packet completes one. Errors: the packet is not
  /// OSC (osc::read_packet) and changes nothing.
  Result<std::optional<ReceivedFace>> take(std::span<const std::uint8_t> packet, double arrival);

  [[nodiscard]] const Values& values() const { return values_; }
  /// Number of messages skipped although their address is supported.
  [[nodiscard]] std::uint64_t skipped() const { return skipped_; }

 private:
  /// The effect of a message on the values.
  enum class Effect { nothing, value, time, apply, wrong };
  Effect read(const osc::Message& message);
  Effect read_blend(const osc::Message& message);
  Effect read_bone(const osc::Message& message);

  Values values_;
  std::optional<double> time_;
  std::optional<double> last_packet_;
  double last_apply_ = 0.0;  ///< time of the last Apply, else of the first packet
  bool changed_ = false;     ///< since the last face
  std::uint64_t skipped_ = 0;
};

}  // namespace semblante::vmc
