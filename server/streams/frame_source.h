#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "protocol/cpp/face_frame.h"

namespace semblante::streams {

/// Something that has a face for every moment: a performance, a file of frames. Immutable: any thread. To play another
/// kind of thing into streams, write one of these and give it to StreamHub::play.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  /// What people see in the stream's status: "performance", "fap".
  [[nodiscard]] virtual std::string_view kind() const = 0;
  /// For people; may be empty.
  [[nodiscard]] virtual std::string name() const = 0;
  /// ms; 0: it has no end.
  [[nodiscard]] virtual double duration() const = 0;
  /// The face `ms` after the beginning, 0..duration. `played_ms`: the same without falling back where it is looped, for
  /// what should not repeat with it.
  [[nodiscard]] virtual FaceFrame frame_at(double ms, double played_ms) const = 0;
  /// About how much memory it holds.
  [[nodiscard]] virtual std::size_t bytes() const = 0;
};

}  // namespace semblante::streams
