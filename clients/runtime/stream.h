#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "clients/runtime/clock_estimate.h"
#include "clients/runtime/events.h"
#include "clients/runtime/outbox.h"
#include "clients/runtime/semblante.h"
#include "clients/runtime/times.h"
#include "core/types/result.h"
#include "core/types/split_mix.h"
#include "protocol/cpp/frame_codec.h"
#include "protocol/cpp/messages.h"
#include "protocol/cpp/packed_codec.h"
#include "protocol/cpp/quantizers.h"

namespace semblante::runtime {

class Player;

struct StreamOptions {
  StreamRole role = StreamRole::subscribe;
  bool take_over = false;
  double retry_first = 250, retry_longest = 10'000;  ///< ms
  std::uint64_t seed = 0;
  double ping_interval = 5000;    ///< ms; 0: no pings
  double silence_limit = 20'000;  ///< ms; infinity: none
  double batch = 0;               ///< ms
  std::size_t max_message_bytes = max_binary_message_bytes;
  std::optional<ResumePoint> resume;
  bool sound = false;
  bool text = false;      ///< the client has a voice of its own
  bool captions = false;  ///< text beside frames and sound
  /// Writes a message in another form than the binary one, for programs that also speak JSON; null: binary. Such a
  /// program reads messages itself and gives them to `take`.
  void (*encode)(const Message&, const QuantizerSteps&, std::vector<std::uint8_t>& to) = nullptr;
};

/// The protocol for one stream, across connections: what semblante.h says of semblante_stream. Times in ms.
class Stream {
 public:
  /// More than this waiting to be sent, bytes: what is published is refused, and pings are left out.
  static constexpr std::size_t most_waiting = std::size_t{256} * 1024;

  explicit Stream(const StreamOptions& options);
  ~Stream();
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;

  void start(double now);
  void stop();
  void opened(double now);
  void closed(double now);
  void tick(double now);
  [[nodiscard]] double wake_time() const;
  void receive(std::span<const std::uint8_t> bytes, double now);
  /// One decoded message of the server.
  void take(const Message& message, double now);
  /// A message that cannot be used: the connection is lost.
  void fail(Error error, double now);

  enum class Published { sent, unavailable, invalid };
  Published publish(std::span<const semblante_timed_frame> frames, double media_time, double now);
  /// One packet of sound; its media time is on the clock of the frames.
  Published publish_sound(std::span<const std::uint8_t> packet, double media_time);
  void measure_clock(double now);
  /// What the client's own voice does; its media time is set here.
  Published spoken(Spoken spoken, double now);
  /// False: not a subscriber.
  bool set_captions(bool on);

  Outbox& outbox() { return outbox_; }
  Events& events() { return events_; }
  ClockEstimate& clock() { return clock_; }
  [[nodiscard]] const ClockEstimate& clock() const { return clock_; }
  [[nodiscard]] semblante_stream_state state() const { return state_; }
  [[nodiscard]] const std::optional<Header>& header() const { return header_; }
  /// How the newest header continued: SEMBLANTE_FRESH ...
  [[nodiscard]] std::uint32_t resumed() const { return resumed_; }
  [[nodiscard]] const QuantizerSteps& steps() const { return steps_; }
  /// For the next hello, and of the last one.
  [[nodiscard]] const std::optional<ResumePoint>& resume() const { return resume_; }
  [[nodiscard]] const std::optional<ResumePoint>& sent_resume() const { return sent_resume_; }
  [[nodiscard]] std::optional<double> server_offset() const { return server_offset_; }
  /// The newest keyframe or batch, and when it came; no frames: none.
  [[nodiscard]] const Frames& newest() const { return newest_; }
  [[nodiscard]] double newest_at() const { return newest_at_; }
  /// The frames of newest() in FAP units.
  std::span<const semblante_timed_frame> frames();

  void add(Player& player);
  void remove(Player& player);

 private:
  enum class Link : std::uint8_t { none, opening, open };

  void become(semblante_stream_state state);
  void ask_for_connection(double now);
  /// Ends the connection on this side.
  void close(std::uint32_t code);
  /// The connection is gone; another follows after a pause.
  void wait_to_retry(double now);
  void send(const Message& message);
  void send_ping(double now);
  void flush();
  void add_to_batch(const TimedFrame& frame, std::uint64_t media_time, double now);
  void take_header(const Header& header, double now);
  /// What was changed between the hello of this connection and its header.
  void tell_changed_wishes(double now);
  void take_frames(double now, bool is_keyframe);
  void take_sound(const SoundPacket& sound);
  void take_text(const SpeechText& text);
  void take_pong(const Pong& pong, double now);
  void take_end(const End& end, double now);

  StreamOptions options_;
  semblante_stream_state state_ = SEMBLANTE_STREAM_CLOSED;
  Link link_ = Link::none;
  bool greeted_ = false;                            ///< the header of this connection has come
  bool told_text_ = false, told_captions_ = false;  ///< by the hello of this connection
  bool ended_ = false;                              ///< and its end
  std::optional<Header> header_;
  std::uint32_t resumed_ = SEMBLANTE_FRESH;
  QuantizerSteps steps_ = standard_quantizers();
  FrameDecoder decoder_;
  Frames newest_;
  double newest_at_ = 0;
  bool is_newest_converted_ = false;
  std::vector<semblante_timed_frame> converted_;
  std::optional<ResumePoint> resume_, sent_resume_;

  ClockEstimate clock_;
  std::optional<double> server_offset_;
  double hello_at_ = 0;
  double next_ping_ = never;
  std::size_t pings_ = 0;  ///< since the header, or since measure_clock
  std::uint32_t ping_id_ = 0;
  /// Since when the server owes an answer.
  double unanswered_since_ = never;

  std::uint32_t attempts_ = 0;
  double retry_at_ = never;
  SplitMix random_;

  std::optional<PackedEncoder> encoder_;  ///< of a publisher; none: a keyframe must be next
  Frames batch_;                          ///< what waits to be published
  double batch_until_ = never;

  Outbox outbox_;
  Events events_;
  std::vector<Player*> followers_;
};

}  // namespace semblante::runtime
