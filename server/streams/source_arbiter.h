#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "core/types/result.h"
#include "protocol/cpp/face_frame.h"
#include "server/streams/flood_guard.h"
#include "server/streams/sound_guard.h"
#include "server/streams/source.h"
#include "server/streams/timeline.h"

namespace semblante::streams {

/// Decides which source may feed a stream, and the media time of each frame. One source at a time may *hold* the
/// stream: a publishing connection, or a player. Requests and the stream's own filling feed it only while no source
/// holds it. A state machine: its inputs are events with their time, its outputs decisions. Not synchronized.
class SourceArbiter {
 public:
  using Clock = std::chrono::steady_clock;
  /// Identifies one hold; never reused. 0: no hold.
  using Ticket = std::uint64_t;

  struct Claim {
    Ticket ticket = 0;
    bool replaces_publisher = false;  ///< a connection held the stream until now; the caller must notify and close it
  };
  struct Refusal {
    Error error;
    /// Set when frames came too fast: `close` (the publisher no longer holds the stream), `drop_and_say` or `drop`
    /// (silently; `error` is empty).
    std::optional<FloodGuard::Verdict> flood;
  };
  /// The media time of the first frame in ms, or the reason why the frames are refused.
  using Placement = std::variant<std::uint64_t, Refusal>;

  /// `began`: the zero of the stream's clock. `limits` apply to each publisher, and to all requests together. The
  /// stream's own filling returns after `filling_patience` of silence.
  SourceArbiter(bool has_filling, FloodLimits limits, std::chrono::milliseconds filling_patience,
                Clock::time_point began);

  /// Makes `source`, which is neither request nor demo, the holder. `rate`: frames per second, 0 when unknown. Errors:
  /// `mismatch` when there is a holder and `take_over` is not set.
  Result<Claim> claim(Source source, double rate, bool take_over, Clock::time_point now);
  /// Ends a hold; false when it had ended before.
  bool release(Ticket ticket, Clock::time_point now);
  /// Whether this claim still holds the stream.
  [[nodiscard]] bool holds(Ticket ticket) const { return holder_ && holder_->ticket == ticket; }

  /// Frames of a publisher. `media_time` is by its own clock, 0: now. May change the frames' times, so that media time
  /// never decreases. Errors: `mismatch` (it no longer holds the stream), `out_of_range` (the frames last too long),
  /// `too_large` (too many frames, see Refusal::flood, or too far ahead of the stream's clock).
  Placement place_published(Ticket ticket, std::uint64_t media_time, std::vector<TimedFrame>& frames,
                            Clock::time_point now);
  /// A packet of a publisher's sound: its media time on the stream's clock; nullopt when it is to be dropped because
  /// the sound of an earlier source has not ended. Errors: `mismatch` (the publisher no longer holds the stream), those
  /// of SoundGuard.
  Result<std::optional<std::uint64_t>> place_sound(Ticket ticket, const SoundPacket& sound, Clock::time_point now);
  /// A player's sound was sent.
  void sound_played(std::uint64_t media_time, double lasts) { timeline_.sound_played(media_time, lasts); }
  /// Frames of a request. Errors as above; `mismatch` when there is a holder.
  Placement place_request(std::vector<TimedFrame>& frames, Clock::time_point now);
  /// One frame of a player, due at `when`. nullopt when it no longer holds the stream.
  std::optional<std::uint64_t> place_played(Ticket ticket, Clock::time_point when, Clock::time_point now);
  /// One frame of the stream's own filling. nullopt while another source feeds the stream or did so recently.
  std::optional<std::uint64_t> place_filling(Clock::time_point when, Clock::time_point now);

  [[nodiscard]] bool is_held_by(Source source) const { return holder_ && holder_->source == source; }
  /// The source that feeds the stream now; requests count for some seconds after the last one.
  [[nodiscard]] std::optional<Source> active(Clock::time_point now) const;
  /// Frames per second of the current source, 0: unknown.
  [[nodiscard]] double rate() const;
  /// When the newest frame is to be shown. No later frame is shown earlier.
  [[nodiscard]] Clock::time_point newest_frame_time() const;

 private:
  struct Holder {
    Ticket ticket;
    Source source;
    double rate;
    FloodGuard guard;
    SoundGuard sound;
  };
  [[nodiscard]] std::uint64_t media_time_at(Clock::time_point when) const {
    return streams::media_time_at(began_, when);
  }
  void heard(bool request, Clock::time_point now);

  bool has_filling_;
  std::chrono::milliseconds filling_patience_;
  FloodLimits limits_;
  Clock::time_point began_;
  std::optional<Holder> holder_;
  Ticket last_ticket_ = 0;
  Timeline timeline_;
  FloodGuard requests_;
  std::optional<Clock::time_point> last_heard_;  ///< when a source other than the filling last fed the stream
  bool last_was_request_ = false;
};

}  // namespace semblante::streams
