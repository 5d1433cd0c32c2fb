#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/kernel/semblante_kernel.h"
#include "core/types/result.h"

namespace semblante::livelink {

struct ReceivedFace {
  semblante_frame frame{};        ///< every FAP within its range
  std::optional<double> seconds;  ///< of the device's clock
  std::size_t clamped = 0;        ///< number of coefficients clamped to 0..1
};

/// Follows one of the sending devices: that with the given subject, or else the first that sends a face, until it has
/// sent nothing for `forget_seconds`.
class Receiver {
 public:
  static constexpr double forget_seconds = 5.0;

  /// `subject`: empty for the first device.
  explicit Receiver(std::string subject) : wanted_(std::move(subject)) {}

  /// `arrival`: seconds of a monotonic clock. Returns the face, if the followed device sees one. Errors: an invalid
  /// packet (livelink::read_packet).
  Result<std::optional<ReceivedFace>> take(std::span<const std::uint8_t> packet, double arrival);

  [[nodiscard]] std::uint64_t others() const { return others_; }      ///< packets of subjects that are not followed
  [[nodiscard]] std::uint64_t faceless() const { return faceless_; }  ///< followed, without a face

 private:
  std::string wanted_;
  std::optional<std::pair<std::string, std::string>> followed_;  ///< device and subject
  double last_ = 0.0;
  std::uint64_t others_ = 0, faceless_ = 0;
};

}  // namespace semblante::livelink
