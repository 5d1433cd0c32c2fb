#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/cpp/face_frame.h"

namespace semblante::streams {

/// Walks through the frames of a source that has times of its own, in their order. One thread.
class FrameCursor {
 public:
  virtual ~FrameCursor() = default;
  /// Of the frame at hand, ms after the beginning of the source; does not fall. Nothing after the last frame.
  [[nodiscard]] virtual std::optional<double> time() const = 0;
  [[nodiscard]] virtual FaceFrame frame() const = 0;
  virtual void advance() = 0;
};

/// Something that has a face for every moment: a performance, a file of frames. Immutable: any thread. To play another
/// kind of thing into streams, write one of these and give it to StreamHub::play.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  /// What people see in the stream's status: "performance", "fap", "recording".
  [[nodiscard]] virtual std::string_view kind() const = 0;
  /// For people; may be empty.
  [[nodiscard]] virtual std::string name() const = 0;
  /// ms; 0: it has no end.
  [[nodiscard]] virtual double duration() const = 0;
  /// The face `ms` after the beginning, 0..duration. `played_ms`: the same without falling back where it is looped, for
  /// what should not repeat with it.
  [[nodiscard]] virtual FaceFrame frame_at(double ms, double played_ms) const = 0;
  /// For a source that is frames at times of their own: they are played one by one at these times, none left out and
  /// none made up between them, from the first at or after `ms` on. Null: it is played at a rate.
  [[nodiscard]] virtual std::unique_ptr<FrameCursor> frames_from(double /*ms*/) const { return nullptr; }
  /// About how much memory it holds.
  [[nodiscard]] virtual std::size_t bytes() const = 0;
};

}  // namespace semblante::streams
