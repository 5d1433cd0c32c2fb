#pragma once

#include <cstddef>
#include <cstdint>

#include "core/types/result.h"
#include "core/types/token_bucket.h"
#include "protocol/cpp/messages.h"

namespace semblante::streams {

/// Checks the sound of one publisher: packets in the order of time that do not overlap, and no more bytes than Opus has
/// at its highest bitrate. Not synchronized.
class SoundGuard {
 public:
  using Clock = TokenBucket::Clock;
  /// 510 kbit/s, the most that one Opus stream has.
  static constexpr double bytes_per_second = 64'000, bytes_burst = 256'000;

  explicit SoundGuard(Clock::time_point now) : bytes_(bytes_per_second, bytes_burst, now) {}

  /// Returns how long a packet lasts that a decoder has read, ms. Errors: `out_of_range` (it begins before the packet
  /// before it has ended), `too_large` (too many bytes).
  Result<double> check(const SoundPacket& sound, Clock::time_point now);

 private:
  TokenBucket bytes_;
  double ends_ = 0.0;  ///< of the newest packet, ms by the publisher's clock
};

}  // namespace semblante::streams
