#include "server/streams/stream.h"

#include <exception>
#include <utility>

#include "protocol/cpp/fap_ranges.h"
#include "protocol/cpp/opus_packet.h"
#include "protocol/cpp/speech_score.h"
#include "server/streams/batch_listener.h"
#include "server/streams/batch_sender.h"
#include "server/streams/encoding.h"
#include "server/streams/stream_header.h"

namespace semblante::streams {
namespace {

using Clock = Stream::Clock;

Error has_ended() { return {ErrorCode::missing, "", "the stream has ended"}; }
Error has_no_frame() { return {ErrorCode::empty, "/frames", "there are no frames"}; }

void close_as_slow(StreamPeer& client) {
  client.close(Message(End{EndReason::slow}), {1013, "reads too slowly: reconnect later"});
}

}  // namespace

/// Sends accepted frames when the stream has no sender. Declared before the lock, so that it runs after the mutex has
/// been released.
class Stream::SendAfter {
 public:
  explicit SendAfter(Stream& stream) : stream_(stream) {}
  ~SendAfter() {
    if (stream_.sender_) return;
    auto now = Clock::now();
    while (stream_.advance(now) <= now) now = Clock::now();
  }
  SendAfter(const SendAfter&) = delete;
  SendAfter& operator=(const SendAfter&) = delete;

 private:
  Stream& stream_;
};

Stream::Stream(StreamInfo info, StreamLimits limits, std::shared_ptr<BatchSender> sender)
    : made_(std::move(info)),
      limits_(limits),
      steps_(scaled_quantizers(made_.settings.quantizer_scale)),
      sender_(std::move(sender)),
      lateness_(std::make_shared<metrics::LatenessHistogram>(metrics::lateness_bounds)),
      sources_(made_.source == "demo", limits.publisher, limits.filling_patience, began_),
      log_({.epoch = made_.epoch,
            .interval = std::chrono::milliseconds(made_.settings.batch_interval),
            .steps = steps_,
            .limits = limits,
            .began = began_,
            .lateness = lateness_}) {}

http::OutboxLimits Stream::outbox_limits() const {
  http::OutboxLimits limits;
  limits.messages = limits_.pending_messages;
  limits.bytes = limits_.pending_bytes;
  return limits;
}

// ---- status

StreamInfo Stream::info() const {
  StreamInfo info = made_;
  const std::lock_guard lock(mutex_);
  info.counts = all_counts();
  info.clamped_values = counts_.clamped_values;
  info.sequence = log_.taken();
  info.publishers = publisher_ != nullptr ? 1 : 0;
  info.subscribers = fan_out_.size();
  info.subscribers_by_coding = fan_out_.by_coding();
  info.active_source = sources_.active(Clock::now());
  return info;
}

StreamCounts Stream::counts() const {
  const std::lock_guard lock(mutex_);
  return all_counts();
}

StreamCounts Stream::all_counts() const {
  StreamCounts counts = counts_;
  counts.messages_dropped += answers_dropped_;
  counts.batches = log_.batches();
  counts.encode_seconds = log_.encode_seconds();
  counts.lateness = lateness_->values();
  return counts;
}

Header Stream::header() const {
  const std::lock_guard lock(mutex_);
  auto header = stream_header(made_, log_.taken());
  header.sound = stream_sound;
  return header;
}

Header Stream::header_for(bool recovered, bool sound) const {
  return connection_header(made_, log_.sequence(), media_time_now(), sources_.rate(), recovered, sound);
}

void Stream::set_listener(std::shared_ptr<BatchListener> listener) {
  const std::lock_guard lock(mutex_);
  listener_ = std::move(listener);
}

// ---- sources

PublishReceipt Stream::take(Source source, std::uint64_t media_time, std::vector<TimedFrame> frames,
                            Clock::time_point now) {
  std::size_t clamped = 0;
  for (auto& frame : frames) clamped += clamp_to_ranges(frame.state, made_.settings.quantizer_scale);
  counts_.clamped_values += clamped;
  counts_.frames += frames.size();
  counts_.frames_by_source[static_cast<std::size_t>(source)] += frames.size();
  // The listener is called first: a frame that is acknowledged to a client must be in a recording that ends now.
  if (listener_) listener_->taken(made_.id, made_.epoch, {log_.taken() + 1, media_time, frames});
  if (auto full = log_.add(media_time, frames, now)) fan_out_.push(std::move(full));
  if (made_.settings.batch_interval == 0 && fan_out_.has_room()) fan_out_.push(log_.close(now, now));
  want(next_work(now));
  return PublishReceipt{frames.size(), log_.taken(), clamped};
}

Result<PublishReceipt> Stream::publish_request(const std::vector<TimedFrame>& frames) {
  if (frames.empty()) return has_no_frame();
  const SendAfter after(*this);
  const std::lock_guard lock(mutex_);
  if (ended_) return has_ended();
  const auto now = Clock::now();
  auto placed = frames;
  auto placement = sources_.place_request(placed, now);
  if (auto* refusal = std::get_if<SourceArbiter::Refusal>(&placement)) {
    if (refusal->flood) counts_.throttled += frames.size();
    return std::move(refusal->error);
  }
  return take(Source::request, std::get<std::uint64_t>(placement), std::move(placed), now);
}

std::optional<SourceArbiter::Refusal> Stream::publish(StreamPeer& client, std::uint64_t media_time,
                                                      const std::vector<TimedFrame>& frames) {
  using Refusal = SourceArbiter::Refusal;
  if (frames.empty()) return Refusal{has_no_frame(), std::nullopt};
  const SendAfter after(*this);
  const std::lock_guard lock(mutex_);
  if (ended_) return Refusal{has_ended(), std::nullopt};
  const auto now = Clock::now();
  auto placed = frames;
  auto placement = sources_.place_published(client.notes().ticket, media_time, placed, now);
  if (auto* refusal = std::get_if<Refusal>(&placement)) {
    if (refusal->flood) counts_.throttled += frames.size();
    if (refusal->flood == FloodGuard::Verdict::close) {
      ++counts_.closed_flooding;
      publisher_ = nullptr;
    }
    return std::move(*refusal);
  }
  take(Source::connection, std::get<std::uint64_t>(placement), std::move(placed), now);
  return std::nullopt;
}

Result<Stream::Ticket> Stream::claim(Source source, double rate, bool take_over, StreamPeer* publisher) {
  if (ended_) return has_ended();
  auto claim = sources_.claim(source, rate, take_over, Clock::now());
  if (!claim) return std::move(claim).error();
  if (claim->replaces_publisher) {
    publisher_->close(Message(End{EndReason::replaced}), {1000, "another source took over"});
    ++counts_.closed_replaced;
  }
  end_text();
  publisher_ = publisher;
  return claim->ticket;
}

void Stream::release(StreamPeer& publisher) {
  if (sources_.release(publisher.notes().ticket, Clock::now())) publisher_ = nullptr;
}

Result<Header> Stream::begin_publishing(StreamPeer& client, const Hello& hello) {
  const std::lock_guard lock(mutex_);
  client.notes().said_hello = true;
  auto ticket = claim(Source::connection, 0.0, hello.take_over, &client);
  if (!ticket) {
    if (!ended_) ++counts_.closed_conflict;
    return std::move(ticket).error();
  }
  client.notes().ticket = *ticket;
  return header_for(false, hello.sound);
}

void Stream::end_publishing(StreamPeer& client) {
  const std::lock_guard lock(mutex_);
  release(client);
}

Result<Stream::Ticket> Stream::begin_playing(double rate, bool take_over, Source source) {
  const std::lock_guard lock(mutex_);
  return claim(source, rate, take_over, nullptr);
}

Status Stream::publish_playing(Ticket ticket, Clock::time_point when, const TimedFrame& frame) {
  const SendAfter after(*this);
  const std::lock_guard lock(mutex_);
  const auto now = Clock::now();
  const auto source = sources_.active(now);
  const auto media_time = ended_ ? std::nullopt : sources_.place_played(ticket, when, now);
  if (!media_time) return Error{ErrorCode::mismatch, "", "the play has ended"};
  take(*source, *media_time, {frame}, now);
  return Unit{};
}

void Stream::take_sound(SoundPacket sound, Clock::time_point due, Clock::time_point now) {
  ++counts_.sound_packets;
  if (listener_) listener_->heard(made_.id, made_.epoch, sound);
  fan_out_.push_sound(std::move(sound), due);
  want(next_work(now));
}

void Stream::play_sound(Ticket ticket, Clock::time_point when, const std::vector<std::uint8_t>& packet) {
  const SendAfter after(*this);
  const std::lock_guard lock(mutex_);
  if (ended_ || !sources_.holds(ticket)) return;
  SoundPacket sound{media_time_at(began_, when), packet};
  sources_.sound_played(sound.media_time, opus_packet_ms(packet).value_or(0.0));
  take_sound(std::move(sound), when, Clock::now());
}

Status Stream::publish_sound(StreamPeer& client, SoundPacket sound) {
  const SendAfter after(*this);
  const std::lock_guard lock(mutex_);
  if (ended_) return has_ended();
  const auto now = Clock::now();
  const auto placed = sources_.place_sound(client.notes().ticket, sound, now);
  if (!placed) return placed.error();
  if (!*placed) return Unit{};
  sound.media_time = **placed;
  take_sound(std::move(sound), now, now);
  return Unit{};
}

void Stream::publish_text(Ticket ticket, Clock::time_point when, SpeechText text, bool replaces) {
  const SendAfter after(*this);
  const std::lock_guard lock(mutex_);
  if (ended_ || !sources_.holds(ticket)) return;
  if (text.text.empty()) return hush(when, Clock::now());
  text.speech = ++speeches_;
  text.media_time = media_time_at(began_, when);
  const auto score = read_score(text.score);
  const auto until = when + std::chrono::milliseconds(score ? score->duration() : 0);
  const auto now = Clock::now();
  if (until < now) return;  // the player was late
  if (listener_) listener_->said(made_.id, made_.epoch, text);
  fan_out_.push_text(std::move(text), now, until, replaces);
  want(next_work(now));
}

void Stream::hush(Clock::time_point when, Clock::time_point now) {
  SpeechText hush{++speeches_, media_time_at(began_, when), "", "", {}};
  if (listener_) listener_->said(made_.id, made_.epoch, hush);
  fan_out_.hush(std::move(hush), now);
  want(next_work(now));
}

void Stream::end_text() {
  const auto now = Clock::now();
  if (fan_out_.says(now)) hush(now, now);
  if (!fan_out_.is_text()) return;
  fan_out_.end_text(now);
  want(next_work(now));
}

void Stream::show_captions(StreamPeer& client, bool on) {
  const std::lock_guard lock(mutex_);
  fan_out_.set_captions(client, on);
}

Status Stream::spoken(StreamPeer& client, const Spoken& spoken) {
  const std::lock_guard lock(mutex_);
  if (spoken.speech > speeches_) return Error{ErrorCode::out_of_range, "/speech", "no such text was sent"};
  const bool reads = fan_out_.reads(client);
  switch (spoken.state) {
    case VoiceState::ready:
      fan_out_.set_reads(client, true, log_);
      return Unit{};
    case VoiceState::failed:
      if (reads) ++counts_.voices_failed;
      fan_out_.set_reads(client, false, log_);
      return Unit{};
    case VoiceState::reached:
      if (reads) ++counts_.words_reached;
      break;
    case VoiceState::ended:
      break;
  }
  if (!reads) return Error{ErrorCode::invalid_argument, "", "this client gets frames: its voice is not ready"};
  return Unit{};
}

void Stream::end_playing(Ticket ticket, bool neutral) {
  if (neutral) static_cast<void>(publish_playing(ticket, Clock::now(), TimedFrame{}).ok());
  const SendAfter after(*this);
  const std::lock_guard lock(mutex_);
  if (sources_.release(ticket, Clock::now())) end_text();
}

Status Stream::fill(Clock::time_point when, const TimedFrame& frame) {
  const SendAfter after(*this);
  const std::lock_guard lock(mutex_);
  if (ended_) return has_ended();
  const auto now = Clock::now();
  if (const auto media_time = sources_.place_filling(when, now)) take(Source::demo, *media_time, {frame}, now);
  return Unit{};
}

Clock::time_point Stream::newest_frame_time() const {
  const std::lock_guard lock(mutex_);
  return sources_.newest_frame_time();
}

// ---- connections

bool Stream::admit(const std::shared_ptr<StreamPeer>& client) {
  const std::lock_guard lock(mutex_);
  if (ended_ || clients_.size() >= limits_.max_connections) {
    ++counts_.refused;
    return false;
  }
  clients_.add(client, Clock::now());
  return true;
}

void Stream::leave(StreamPeer& client) {
  std::shared_ptr<StreamPeer> kept;  // let go of after the mutex
  const std::lock_guard lock(mutex_);
  release(client);
  fan_out_.remove(client);
  kept = clients_.remove(client);
}

void Stream::subscribe(StreamPeer& client, http::WebSocketSink& sink, const Hello& hello, bool binary) {
  const std::lock_guard lock(mutex_);
  client.notes().said_hello = true;
  if (ended_) return;
  const auto coding = binary ? Coding::packed : Coding::json;
  // Whoever gets the text of a speech needs none of its frames.
  const bool reads_now = hello.text && fan_out_.is_text();
  const auto begin = log_.begin(coding, reads_now ? std::nullopt : hello.resume);
  http::WireMessage header;
  append_encoded(header.bytes, Message(header_for(begin.recovered, hello.sound)), binary, steps_);
  const auto told = sink.send(std::make_shared<const http::WireMessage>(std::move(header)), http::Purpose::answer);
  if (told == http::Sent::closed) return;
  if (told == http::Sent::refused) ++counts_.messages_dropped;
  const auto sent = sink.send(begin.wire, http::Purpose::answer);
  if (sent == http::Sent::closed) return;
  if (sent == http::Sent::refused) {
    // It has not read the many answers before its hello, and batches without a beginning cannot be decoded.
    ++counts_.closed_slow;
    close_as_slow(client);
    return;
  }
  fan_out_.add(client, sink, coding, {hello.sound, hello.text, hello.captions}, *begin.wire, sent != http::Sent::handed,
               log_);
}

void Stream::writable(StreamPeer& client) {
  const std::lock_guard lock(mutex_);
  fan_out_.writable(client, log_);
}

void Stream::look_after_connections() {
  std::vector<std::shared_ptr<StreamPeer>> silent;  // let go of after the mutex
  const std::lock_guard lock(mutex_);
  const auto now = Clock::now();
  for (auto* client : fan_out_.remove_stalled(limits_.stalled, now)) {
    ++counts_.closed_slow;
    close_as_slow(*client);
  }
  silent = clients_.silent(limits_.hello_time, now);
  for (const auto& client : silent) {
    if (client->close(Message(StreamError{StreamErrorCode::missing, "", "no hello received in time"}),
                      {1008, "no hello received in time"}))
      ++counts_.closed_silent;
  }
  for (const auto& client : clients_.all())
    if (client->rights_ended())
      client->close(Message(StreamError{StreamErrorCode::unauthorized, "", "the token was revoked or has expired"}),
                    {1008, "the token was revoked or has expired"});
}

void Stream::end(EndReason reason) {
  // Waits for the slice that is being sent: later messages must follow it.
  const std::lock_guard pass(pass_mutex_);
  const std::lock_guard lock(mutex_);
  if (ended_) return;
  const auto now = Clock::now();
  if (log_.due() != Clock::time_point::max()) fan_out_.push(log_.close(now, now));
  fan_out_.send_rest(log_);
  if (listener_) listener_->ended(made_.id);
  ended_ = true;
  const bool stops = reason == EndReason::shutdown;
  for (const auto& client : clients_.all())
    client->close(Message(End{reason}), {static_cast<std::uint16_t>(stops ? 1001 : 1000),
                                         stops ? "the server is shutting down" : "the stream has ended"});
  counts_.closed_ended += clients_.size();
  fan_out_.remove_all();
}

// ---- sending

Clock::time_point Stream::next_work(Clock::time_point now) const { return fan_out_.is_idle() ? log_.due() : now; }

void Stream::want(Clock::time_point when) {
  if (when >= wanted_) return;
  wanted_ = when;
  if (sender_) sender_->wake(weak_from_this(), when);
}

Clock::time_point Stream::work(Clock::time_point asked) {
  {
    const std::lock_guard lock(mutex_);
    if (asked != wanted_) return Clock::time_point::max();
  }
  return advance(Clock::now());
}

Clock::time_point Stream::advance(Clock::time_point now) {
  const std::lock_guard pass(pass_mutex_);
  {
    const std::lock_guard lock(mutex_);
    if (ended_) return wanted_ = Clock::time_point::max();
    if (now >= log_.due() && fan_out_.has_room()) fan_out_.push(log_.close(log_.due(), now));
    if (!fan_out_.next_slice(slice_, log_)) return wanted_ = next_work(now);
    clients_.begin_slice();
  }
  // After a fault the slice is finished all the same: targets that were not reached get the newest state.
  std::exception_ptr fault;
  try {
    http::GroupSender one_by_one;
    slice_.send(sender_ ? sender_->group_sender() : one_by_one, *lateness_);
  } catch (...) {
    fault = std::current_exception();
  }
  std::vector<std::shared_ptr<StreamPeer>> left;  // let go of after the mutex
  const std::lock_guard lock(mutex_);
  left = clients_.end_slice();
  fan_out_.finish_slice(slice_, log_);
  if (fault) std::rethrow_exception(fault);
  return wanted_ = next_work(now);
}

}  // namespace semblante::streams
