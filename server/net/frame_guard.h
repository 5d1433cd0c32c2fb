#pragma once

// Private to net/.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/types/token_bucket.h"
#include "server/net/server.h"

namespace semblante::net {

/// Limits the frames of a WebSocket's client that end no message: control frames, which Beast answers by itself, and
/// fragments, which Beast reads without end when they are empty; and the time in which a message arrives, as every byte
/// counts as activity for Beast. Whole messages are the peer's to limit. Reads the frames' headers, and the payload of
/// close frames: Beast accepts close codes that no protocol can have, and answers a reason that is not UTF-8 with the
/// wrong code. Beast refuses all other faults. Not synchronized.
class FrameGuard {
 public:
  using Clock = TokenBucket::Clock;

  static constexpr std::uint16_t protocol_error = 1002, invalid_payload = 1007, policy_violation = 1008;

  /// What ends the connection: words for the client, and the code of the close frame that has them.
  struct Fault {
    std::string_view words;
    std::uint16_t code;
  };

  explicit FrameGuard(const ServerLimits& limits)
      : limits_(limits),
        controls_(limits.controls_per_second, limits.controls_burst),
        fragments_(limits.fragments_per_second, limits.fragments_burst) {}

  /// Looks at the bytes in the order in which they arrive, in pieces of any size. The fault at the first frame that
  /// is too many or piece that is too late; after that nothing more is looked at.
  [[nodiscard]] std::optional<Fault> look(std::string_view bytes, Clock::time_point now = Clock::now());

 private:
  [[nodiscard]] std::size_t header_bytes() const;
  [[nodiscard]] std::uint64_t payload_bytes() const;
  [[nodiscard]] std::optional<Fault> look_at_frames(std::string_view bytes, Clock::time_point now);
  [[nodiscard]] std::optional<Fault> count_frame(Clock::time_point now);
  void expect_close();
  [[nodiscard]] std::optional<Fault> look_at_close(std::string_view payload);

  const ServerLimits& limits_;
  TokenBucket controls_, fragments_;
  std::uint64_t payload_left_ = 0;          ///< of the current frame
  std::uint32_t fragments_of_message_ = 0;  ///< received so far, without the last one
  bool ends_message_ = false;               ///< the current frame does, or is a control frame between messages
  std::optional<Clock::time_point> begin_;  ///< of what is not complete: a message with its fragments, or a frame
  std::uint64_t bytes_ = 0;                 ///< received since then
  std::array<unsigned char, 14> header_{};  ///< of the current frame, as far as it has arrived
  std::uint8_t header_size_ = 0;
  bool closes_ = false;            ///< the current frame is a close frame of a form that Beast takes
  std::array<char, 125> close_{};  ///< its payload without the mask, as far as it has arrived
  std::uint8_t close_size_ = 0;
  bool over_ = false;
};

}  // namespace semblante::net
