#pragma once

#include <cstdint>
#include <string_view>

#include "protocol/cpp/messages.h"

namespace semblante::streams {

/// Receives all frames of the streams, like a subscriber of each. The recorder implements it.
class BatchListener {
 public:
  virtual ~BatchListener() = default;
  /// Frames were accepted and are not sent yet. Called with the stream's mutex held, so it must only queue them.
  /// `epoch` identifies this instance of the stream; `batch` has the sequence number and media time of its first frame.
  virtual void taken(std::string_view stream, std::uint64_t epoch, const Frames& batch) = 0;
  /// A packet of sound came; also called with the stream's mutex held. Its time is on the clock of the frames.
  virtual void heard(std::string_view /*stream*/, std::uint64_t /*epoch*/, const SoundPacket& /*sound*/) {}
  /// A sentence of a speech, of which no letters mean that what is being said stops; the same.
  virtual void said(std::string_view /*stream*/, std::uint64_t /*epoch*/, const SpeechText& /*text*/) {}
  /// The stream has ended: no frames of this epoch follow. Also called with the stream's mutex held.
  virtual void ended(std::string_view stream) = 0;
};

}  // namespace semblante::streams
