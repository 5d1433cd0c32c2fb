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

/// A face that a VMC sender has finished.
struct ReceivedFace {
  semblante_frame frame{};     ///< every FAP within its range
  std::optional<double> time;  ///< seconds of the sender's own clock, if it told them since the last face
  std::size_t clamped = 0;     ///< values that were outside 0..1 and were taken as 0 or 1
};

/// Gathers what a VMC sender says, packet by packet; a value holds until it is said again, or until nothing has come
/// for `forget_seconds`. Addresses, blend values and bones that say nothing about a face are passed over. So is, as the
/// protocol asks, a message with too few values or with values of other types than it should have; and one with a
/// number that is not finite or a rotation that is none.
///
/// A face is finished by a packet that has /VMC/Ext/Blend/Apply. A sender that says no Apply for `apply_seconds`
/// finishes one by each bundle that changes something, or by each single message /VMC/Ext/T after a change.
class Receiver {
 public:
  static constexpr double forget_seconds = 5.0;
  static constexpr double apply_seconds = 1.0;

  /// `arrival`: seconds of a clock that does not fall. The face, if the packet finishes one. Errors: the packet is not
  /// OSC (osc::read_packet); it then changes nothing.
  Result<std::optional<ReceivedFace>> take(std::span<const std::uint8_t> packet, double arrival);

  [[nodiscard]] const Values& values() const { return values_; }
  /// Messages so far that were passed over though their address is one of those read here.
  [[nodiscard]] std::uint64_t skipped() const { return skipped_; }

 private:
  enum class Said { nothing, value, time, apply, wrong };
  Said read(const osc::Message& message);
  Said read_blend(const osc::Message& message);
  Said read_bone(const osc::Message& message);

  Values values_;
  std::optional<double> time_;
  std::optional<double> last_packet_;
  double last_apply_ = 0.0;  ///< or the first packet
  bool changed_ = false;     ///< since the last face
  std::uint64_t skipped_ = 0;
};

}  // namespace semblante::vmc
