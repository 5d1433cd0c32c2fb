#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "server/streams/frame_source.h"
#include "server/streams/stream.h"

namespace semblante::streams {

inline constexpr double least_play_rate = 1.0;  ///< frames per second
inline constexpr double most_play_rate = 120.0;

struct PlayOptions {
  double rate = 25.0;  ///< frames per second; for a source with its own times only a hint for clients
  bool loop = false;
  double from = 0.0;       ///< ms after the beginning of the source
  bool take_over = false;  ///< replaces another holder of the stream, which otherwise is an error
};

/// Plays one source into one stream. Frame k is due at begin + k / rate and carries that media time, so deadlines do
/// not drift and the jitter of the calling thread is not in the media times. When play() is called late, it sends the
/// newest frame that is due and skips those before it. Of a source with its own times every frame is sent, at begin +
/// its time, even when late. Not synchronized.
class Player {
 public:
  using Clock = std::chrono::steady_clock;

  /// `ticket` is from Stream::begin_playing; 0: the stream's own filling, sent by Stream::fill.
  Player(std::string id, std::shared_ptr<Stream> stream, std::uint64_t ticket,
         std::shared_ptr<const FrameSource> source, PlayOptions options, Clock::time_point begin);

  /// When the next frame, sound or text is due; Clock::time_point::max() when there is none.
  [[nodiscard]] Clock::time_point next() const { return std::min({next_, next_sound_time(), next_text_time()}); }
  [[nodiscard]] bool finished() const { return finished_; }
  /// Memory use of its source. Any thread.
  [[nodiscard]] std::size_t source_bytes() const { return source_->bytes(); }
  [[nodiscard]] const std::string& id() const { return id_; }

  /// Sends the sentences that begin within `text_lead`, the sound that is due, without packets that are more than 200
  /// ms late, and the newest frame that is due; of a source with its own times all that are due, at most
  /// `most_at_once`. Finished after the last frame, or when another source has taken over the stream.
  void play(Clock::time_point now);

  /// So long before its first word a sentence is sent: a voice of a client's own needs time to begin.
  static constexpr std::chrono::milliseconds text_lead{1000};

  /// Ends the play early; the face returns to neutral.
  void stop();

  [[nodiscard]] PlayStatus status(Clock::time_point now) const;

  /// Limit of one call of play() for a source with its own times; next() is then in the past.
  static constexpr std::size_t most_at_once = 512;

 private:
  /// ms after begin_; infinite when looped, endless or not complete.
  [[nodiscard]] double end() const;
  bool publish(double played_ms, const FaceFrame& face);
  void play_at_rate(Clock::time_point now);
  void play_frames(Clock::time_point now);
  void play_sound(Clock::time_point now);
  void play_texts(Clock::time_point now);
  [[nodiscard]] Clock::time_point next_text_time() const;
  [[nodiscard]] Clock::time_point next_sound_time() const;
  [[nodiscard]] Clock::time_point time_of(double played_ms) const;
  [[nodiscard]] double frame_ms() const { return 1000.0 / options_.rate; }

  const std::string id_;
  const std::shared_ptr<Stream> stream_;
  const std::uint64_t ticket_;
  const std::shared_ptr<const FrameSource> source_;
  const PlayOptions options_;
  const Clock::time_point begin_;
  Clock::time_point next_;  ///< frame
  std::uint64_t frame_ = 0;
  std::unique_ptr<FrameCursor> frames_;  ///< null: played at a rate
  std::unique_ptr<SoundCursor> sound_;   ///< null: it has none
  std::unique_ptr<TextCursor> texts_;    ///< null: it has none
  double rounds_ms_ = 0.0;               ///< length of the loop's earlier rounds, minus options_.from
  bool finished_ = false;
};

}  // namespace semblante::streams
