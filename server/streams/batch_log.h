#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "protocol/cpp/messages.h"
#include "protocol/cpp/packed_codec.h"
#include "protocol/cpp/quantizers.h"
#include "server/http/wire_message.h"
#include "server/streams/encoding.h"
#include "server/streams/stream_limits.h"

namespace semblante::streams {

/// Frames that are sent as one message.
struct Batch {
  using Clock = std::chrono::steady_clock;

  std::uint64_t number = 0;  ///< 1 for a stream's first batch
  Frames message;
  PackedEncoder before;                              ///< the encoder, and with it the face, before this batch
  std::array<http::SharedWire, coding_count> wires;  ///< packed: encoded on closing; JSON: by BatchLog::wire
  Clock::time_point closed;
  Clock::time_point due;  ///< deadline for closing it; lateness is measured from it
};

/// The first message for one reader.
struct Beginning {
  http::SharedWire wire;   ///< a keyframe, after a successful resume also the batches since
  bool recovered = false;  ///< the reader has no gap since its resume point
};

struct BatchLogOptions {
  std::uint64_t epoch = 0;                ///< resume points of other epochs are rejected
  std::chrono::milliseconds interval{0};  ///< duration of a batch
  QuantizerSteps steps = standard_quantizers();
  StreamLimits limits{};                                 ///< held_*, resumed_*
  Batch::Clock::time_point began{};                      ///< batches are due at multiples of the interval after it
  std::shared_ptr<metrics::LatenessHistogram> lateness;  ///< passed to every batch's wires; may be null
};

/// The frames of a stream, in batches: gathers frames, closes batches on request, encodes each batch once per coding,
/// and holds recent batches for readers that resume. Time is passed in. Not synchronized.
class BatchLog {
 public:
  using Clock = Batch::Clock;

  explicit BatchLog(BatchLogOptions options);

  /// Appends frames, of which the first has the given media time; media time must not decrease. If they do not fit into
  /// the open batch, that batch is closed first and returned.
  std::shared_ptr<Batch> add(std::uint64_t media_time, const std::vector<TimedFrame>& frames, Clock::time_point now);
  /// When the open batch is due; time_point::max() without an open batch.
  [[nodiscard]] Clock::time_point due() const { return gathering_.frames.empty() ? Clock::time_point::max() : due_; }
  /// Closes the open batch, which must not be empty.
  std::shared_ptr<Batch> close(Clock::time_point due, Clock::time_point now);

  /// Sequence number of the newest frame added.
  [[nodiscard]] std::uint64_t taken() const { return taken_; }
  /// Sequence number of the newest frame in a closed batch, as of the join point.
  [[nodiscard]] std::uint64_t sequence() const { return packed_.sequence(); }
  /// Number of closed batches, which is the number of the newest.
  [[nodiscard]] std::uint64_t batches() const { return batches_; }

  /// The encoded batch, WebSocket header included. All readers of a coding share it.
  const http::SharedWire& wire(Batch& batch, Coding coding);
  /// The state after the newest closed batch. Shared like batches.
  const http::SharedWire& join_point(Coding coding);
  /// For a new reader, or one that resumes at `resume`: the keyframe of that moment and all batches since, if they are
  /// held and within the limits of a resume; otherwise the join point. The next closed batch is the reader's next.
  Beginning begin(Coding coding, const std::optional<ResumePoint>& resume);

  /// Time spent on encoding batches and beginnings, in all codings.
  [[nodiscard]] double encode_seconds() const { return encode_seconds_; }

 private:
  /// Index in held_ of the first batch after the resume point; held_.size() when it is unknown or too old.
  [[nodiscard]] std::size_t find_held(const ResumePoint& resume) const;
  /// Null when it would be too long.
  [[nodiscard]] http::SharedWire gap_from(std::size_t held, Coding coding);
  template <class Write>
  http::SharedWire encode(Clock::time_point due, const std::shared_ptr<metrics::LatenessHistogram>& lateness,
                          const Write& write);

  const BatchLogOptions options_;
  PackedEncoder packed_;  ///< state after the newest closed batch
  Frames gathering_;      ///< the open batch; no frames: none
  Clock::time_point due_;
  std::uint64_t taken_ = 0;
  std::uint64_t batches_ = 0;
  std::deque<std::shared_ptr<Batch>> held_;  ///< oldest first
  std::array<http::SharedWire, coding_count> join_points_;
  double encode_seconds_ = 0.0;
};

}  // namespace semblante::streams
