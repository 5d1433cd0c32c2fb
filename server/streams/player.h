#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "server/streams/frame_source.h"
#include "server/streams/stream.h"

namespace semblante::streams {

inline constexpr double least_play_rate = 1.0;  ///< frames a second
inline constexpr double most_play_rate = 120.0;

struct PlayOptions {
  double rate = 25.0;  ///< frames a second; of a source with times of its own only what its listeners are told
  bool loop = false;
  double from = 0.0;       ///< ms after the beginning of the source
  bool take_over = false;  ///< from whoever publishes or plays; else that is refused
};

/// Plays one source into one stream, frame k at begin + k / rate: deadlines that do not drift, and media times without
/// the jitter of the thread that calls. Who comes late plays the frame that is due and not those before it. Of a source
/// with times of its own every frame is played at begin + its time, late ones too. The caller sees to it that one
/// thread at a time is in here.
class Player {
 public:
  using Clock = std::chrono::steady_clock;

  /// `ticket`: what Stream::begin_playing gave; 0: the stream's own filling, which gives way to everyone.
  Player(std::string id, std::shared_ptr<Stream> stream, std::uint64_t ticket,
         std::shared_ptr<const FrameSource> source, PlayOptions options, Clock::time_point begin);

  /// When the next frame is due. Clock::time_point::max() when there is none.
  [[nodiscard]] Clock::time_point next() const { return next_; }
  [[nodiscard]] bool finished() const { return finished_; }
  [[nodiscard]] const std::string& id() const { return id_; }

  /// Publishes the newest frame due by now, or all that are, at most `most_at_once`. Finished after the last, or when
  /// the stream has gone to somebody else.
  void play(Clock::time_point now);

  /// Ends it before its time; the face returns to neutral.
  void stop();

  [[nodiscard]] PlayStatus status(Clock::time_point now) const;

  /// Of a source with times of its own, in one call of play(): the rest is due at once.
  static constexpr std::size_t most_at_once = 512;

 private:
  bool publish(double played_ms, const FaceFrame& face);
  void play_at_rate(Clock::time_point now);
  void play_frames(Clock::time_point now);
  [[nodiscard]] Clock::time_point time_of(double played_ms) const;
  [[nodiscard]] double frame_ms() const { return 1000.0 / options_.rate; }

  const std::string id_;
  const std::shared_ptr<Stream> stream_;
  const std::uint64_t ticket_;
  const std::shared_ptr<const FrameSource> source_;
  const PlayOptions options_;
  const Clock::time_point begin_;
  double end_;  ///< ms after begin_; infinite when looped or without end
  Clock::time_point next_;
  std::uint64_t frame_ = 0;
  std::unique_ptr<FrameCursor> frames_;  ///< null: at a rate
  double rounds_ms_ = 0.0;               ///< played in rounds of a loop before this one, less where the first began
  bool finished_ = false;
};

}  // namespace semblante::streams
