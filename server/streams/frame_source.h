#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/cpp/messages.h"

namespace semblante::streams {

/// Iterates over the frames of a source with its own times, in order of time. One thread.
class FrameCursor {
 public:
  virtual ~FrameCursor() = default;
  /// When the current frame is due, in ms after the beginning of the source; never decreases. nullopt after the last
  /// frame.
  [[nodiscard]] virtual std::optional<double> time() const = 0;
  [[nodiscard]] virtual FaceFrame frame() const = 0;
  virtual void advance() = 0;
};

/// Iterates over what a source sends beside its frames, in order of time. One thread.
template <class Message>
class MessageCursor {
 public:
  virtual ~MessageCursor() = default;
  /// The current message, with its time in ms after the beginning of the source; null after the last one. Valid until
  /// advance().
  [[nodiscard]] virtual const Message* current() const = 0;
  virtual void advance() = 0;
};
using SoundCursor = MessageCursor<SoundPacket>;
using TextCursor = MessageCursor<SpeechText>;

/// Whether more of a source is to come while it plays.
struct Making {
  bool complete = true;
  std::string failure = {};  ///< for people: why it ends early; empty: it does not
};

/// A source that has a face for every time and can be played into a stream: a performance, a .fap file, a recording.
/// Any thread may use it. A new kind of source implements this interface and is passed to StreamHub::play.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  /// The kind shown in the stream's status: "performance", "fap", "recording".
  [[nodiscard]] virtual std::string_view kind() const = 0;
  /// For display; may be empty.
  [[nodiscard]] virtual std::string name() const = 0;
  /// In ms; 0: endless. Of a source that is still being made: of what there is.
  [[nodiscard]] virtual double duration() const = 0;
  [[nodiscard]] virtual Making making() const { return {}; }
  /// The face `ms` after the beginning, 0..duration. `played_ms` is the same time without starting over in each round
  /// of a loop; noise uses it so as not to repeat.
  [[nodiscard]] virtual FaceFrame frame_at(double ms, double played_ms) const = 0;
  /// For a source whose frames have their own times: the frames from the first one at or after `ms` on. Each is played
  /// at its time, none is skipped or interpolated. Null: the source is played at a rate.
  [[nodiscard]] virtual std::unique_ptr<FrameCursor> frames_from(double /*ms*/) const { return nullptr; }
  /// Its sound from the first packet at or after `ms` on; null: it has none. It is heard once, also of a loop.
  [[nodiscard]] virtual std::unique_ptr<SoundCursor> sound_from(double /*ms*/) const { return nullptr; }
  /// Its sentences from the first one at or after `ms` on; null: it has none. They are said once, also of a loop.
  [[nodiscard]] virtual std::unique_ptr<TextCursor> texts_from(double /*ms*/) const { return nullptr; }
  /// Whether its sentences say all that its frames show, so that a client with a voice of its own needs no frames. Else
  /// they are for captions alone.
  [[nodiscard]] virtual bool texts_replace_frames() const { return true; }
  /// Approximate memory use.
  [[nodiscard]] virtual std::size_t bytes() const = 0;
};

}  // namespace semblante::streams
