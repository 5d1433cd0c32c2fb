#pragma once

#include <deque>
#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/performance/growing_performance.h"
#include "protocol/cpp/quantizers.h"
#include "server/streams/frame_source.h"

namespace semblante::streams {

/// A performance with sound and sentences that is played while it is made. One thread makes it, another plays it, from
/// its beginning and once. When the player reaches the end of what there is, the face rests until the next part comes.
class GrowingSource : public FrameSource {
 public:
  /// `steps`: of the stream that plays it.
  explicit GrowingSource(const QuantizerSteps& steps) : steps_(steps) {}

  // ---- for the thread that makes it
  /// GrowingPerformance::add(), so that nothing that was played changes. Errors: as there; `too_large`: more than
  /// most_bytes.
  Result<double> add_part(const PerformanceScript& part, double lead, double length);
  /// Packets after those that it has. Error `too_large`: more than most_bytes.
  Status add_sound(std::vector<SoundPacket> packets);
  /// Sentences after those that it has. Error `too_large`: more than most_bytes.
  Status add_texts(std::vector<SpeechText> texts);
  /// Nothing more comes.
  void finish();
  /// Nothing more comes, although it should have; it is played to where it was made.
  void fail(std::string why);

  /// As much memory as a source may take counts for it until it is complete.
  static constexpr std::size_t most_bytes = std::size_t{16} << 20U;

  // ---- for the player
  [[nodiscard]] std::string_view kind() const override { return "performance"; }
  [[nodiscard]] std::string name() const override { return "speech"; }
  [[nodiscard]] double duration() const override;
  [[nodiscard]] Making making() const override;
  [[nodiscard]] FaceFrame frame_at(double ms, double played_ms) const override;
  [[nodiscard]] std::unique_ptr<SoundCursor> sound_from(double ms) const override;
  [[nodiscard]] std::unique_ptr<TextCursor> texts_from(double ms) const override;
  [[nodiscard]] std::size_t bytes() const override;

 private:
  template <class Message>
  class Cursor;
  [[nodiscard]] std::size_t bytes_now() const { return face_.bytes() + sound_bytes_ + text_bytes_; }

  const QuantizerSteps steps_;
  mutable std::mutex mutex_;
  GrowingPerformance face_;
  std::deque<SoundPacket> sound_;  ///< packets stay where they are when others come
  std::size_t sound_bytes_ = 0;
  std::deque<SpeechText> texts_;  ///< stay where they are, too
  std::size_t text_bytes_ = 0;
  Making making_{false, {}};
  mutable double played_ =
      -std::numeric_limits<double>::infinity();  ///< the latest time of which the face was asked, ms
};

}  // namespace semblante::streams
