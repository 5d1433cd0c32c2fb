#pragma once

#include <cstdint>
#include <string_view>

#include "protocol/cpp/messages.h"

namespace semblante::streams {

/// Hears all frames of a stream as subscribers get them: what records.
class BatchListener {
 public:
  virtual ~BatchListener() = default;
  /// Called with the stream's mutex held, when frames are taken and before they are sent: must only queue. `epoch`
  /// is the stream's life, `batch` has its sequence number and media time.
  virtual void taken(std::string_view stream, std::uint64_t epoch, const Frames& batch) = 0;
  /// The stream has ended: no batch of this life follows. As above.
  virtual void ended(std::string_view stream) = 0;
};

}  // namespace semblante::streams
