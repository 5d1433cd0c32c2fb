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
/// fragments, which Beast reads without end when they are empty. Whole messages are the peer's to limit. Reads only the
/// frames' headers; what is wrong with them Beast refuses. Not synchronized.
class FrameGuard {
 public:
  using Clock = TokenBucket::Clock;

  explicit FrameGuard(const ServerLimits& limits)
      : max_fragments_(limits.max_fragments),
        controls_(limits.controls_per_second, limits.controls_burst),
        fragments_(limits.fragments_per_second, limits.fragments_burst) {}

  /// Looks at the bytes in the order in which they arrive, in pieces of any size. The words for the client at the first
  /// frame that is too many; after that nothing more is looked at.
  [[nodiscard]] std::optional<std::string_view> look(std::string_view bytes);

 private:
  [[nodiscard]] std::size_t header_bytes() const;
  [[nodiscard]] std::uint64_t payload_bytes() const;
  [[nodiscard]] std::optional<std::string_view> count_frame();

  const std::uint32_t max_fragments_;
  TokenBucket controls_, fragments_;
  std::uint64_t payload_left_ = 0;          ///< of the current frame
  std::uint32_t fragments_of_message_ = 0;  ///< received so far, without the last one
  std::array<unsigned char, 14> header_{};  ///< of the current frame, as far as it has arrived
  std::uint8_t header_size_ = 0;
  bool over_ = false;
};

}  // namespace semblante::net
