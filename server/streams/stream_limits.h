#pragma once

#include <chrono>
#include <cstddef>

#include "server/streams/flood_guard.h"

namespace semblante::streams {

struct StreamLimits {
  std::size_t max_connections = 16384;                  ///< of one stream
  std::size_t held_batches = 1024;                      ///< kept for clients that resume
  std::chrono::milliseconds held_time{30'000};          ///< time for which a batch is kept for them
  std::size_t resumed_frames = 1024;                    ///< maximum number of frames in one resume
  std::size_t resumed_bytes = std::size_t{256} * 1024;  ///< maximum bytes of one resume
  std::size_t pending_messages = 16;  ///< of one subscriber, before they are replaced by the newest state
  std::size_t pending_bytes = std::size_t{256} * 1024;
  std::chrono::milliseconds stalled{5000};       ///< a subscriber that reads nothing for so long is closed with 1013
  std::chrono::milliseconds hello_time{10'000};  ///< a connection without a hello after this is closed with 1008
  std::chrono::milliseconds filling_patience{3000};  ///< of silence, before the stream's own filling returns
  FloodLimits publisher;  ///< of one connection that publishes, and of all requests to one stream together
  std::size_t playing_bytes = std::size_t{512} << 20U;  ///< of all playing sources, in all streams together
};

}  // namespace semblante::streams
