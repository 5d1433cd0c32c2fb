#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "protocol/cpp/frame_codec.h"
#include "tests/bench/fanout/coding.h"

namespace semblante::bench {

/// When frames were sent, by number: written by the publisher, read by the subscribers' thread.
class SendTimes {
 public:
  explicit SendTimes(std::size_t frames) : times_(frames + 1) {}
  void set(std::uint64_t frame, std::int64_t when) {
    if (frame < times_.size()) times_[frame].store(when, std::memory_order_release);
  }
  /// 0: not sent, or beyond what is remembered.
  [[nodiscard]] std::int64_t get(std::uint64_t frame) const {
    return frame < times_.size() ? times_[frame].load(std::memory_order_acquire) : 0;
  }
  [[nodiscard]] std::size_t room() const { return times_.size() - 1; }

 private:
  std::vector<std::atomic<std::int64_t>> times_;
};

/// One message of a stream as its subscribers should get it.
struct Batch {
  std::uint64_t first = 0, last = 0;  ///< numbers of its frames
  std::int64_t due = 0;               ///< ns; when an ideal server would have sent it
  Frames frames;                      ///< empty for a baseline
};

/// What comes to a subscriber beside batches.
struct Notice {
  enum class Kind : std::uint8_t { header, join, error, end, other, wrong } kind = Kind::wrong;
  std::uint64_t sequence = 0;  ///< of a join: the newest frame it holds
};

/// Reads what one kind of server sends. One for all subscribers, which get the same bytes.
class Content {
 public:
  virtual ~Content() = default;
  /// The next batch after those read before; nullopt for what is not the next one. `now`: ns, when it came.
  virtual std::optional<Batch> next(std::string_view bytes, std::int64_t now) = 0;
  /// Number of the frame that the next batch begins with; 0: whichever comes.
  [[nodiscard]] virtual std::uint64_t next_frame() const = 0;
  /// A message to one subscriber alone. Where batches begin when nothing has been read yet.
  virtual Notice notice(std::string_view bytes) = 0;
  /// From here on lateness counts.
  virtual void begin_measuring() {}
  /// What a subscriber says after the handshake; empty: nothing, and batches begin at once.
  [[nodiscard]] virtual const std::string& hello() const = 0;
  [[nodiscard]] virtual std::string_view subprotocol() const = 0;
  /// Frames whose state is not the one that was published.
  [[nodiscard]] virtual std::uint64_t wrong_states() const { return 0; }
  /// A decoder of its own for one subscriber: whether it reads the message and sees what `batch` says (nullptr: any
  /// message before the first batch).
  class Sample {
   public:
    virtual ~Sample() = default;
    virtual bool agrees(std::string_view bytes, const Batch* batch) = 0;
  };
  [[nodiscard]] virtual std::unique_ptr<Sample> sample() const { return nullptr; }
};

/// What `semblante serve` sends when the bench's publisher feeds it. A batch is due when its newest frame was sent;
/// where the stream's header names a batch interval, as BatchGrid has it.
std::unique_ptr<Content> stream_content(Coding coding, const SendTimes& sent, bool heavy);
/// What the baselines send; see rivals/payload.h.
std::unique_ptr<Content> rival_content();

}  // namespace semblante::bench
