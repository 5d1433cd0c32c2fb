#include "clients/runtime/stream.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "clients/runtime/border.h"
#include "clients/runtime/player.h"
#include "core/types/decimal.h"
#include "protocol/cpp/kernel_values.h"

namespace semblante::runtime {
namespace {

constexpr std::uint32_t normal_closure = 1000;
/// Of the range for applications: a message could not be used, or the server is silent.
constexpr std::uint32_t unreadable = 4000;

Event event_of(semblante_event_type type) {
  Event event;
  event.type = type;
  return event;
}

}  // namespace

Stream::Stream(const StreamOptions& options) : options_(options), resume_(options.resume), random_(options.seed) {}

Stream::~Stream() {
  while (!followers_.empty()) followers_.back()->follow(nullptr);
}

void Stream::become(semblante_stream_state state) {
  if (state == state_) return;
  state_ = state;
  Event event = event_of(SEMBLANTE_EVENT_STATE);
  event.state = state;
  events_.push(std::move(event));
}

void Stream::start(double now) {
  if (state_ == SEMBLANTE_STREAM_CONNECTING || state_ == SEMBLANTE_STREAM_OPEN) return;
  attempts_ = 0;
  ask_for_connection(now);
}

void Stream::ask_for_connection(double now) {
  link_ = Link::opening;
  greeted_ = ended_ = false;
  retry_at_ = never;
  unanswered_since_ = now;
  decoder_.reset();
  encoder_.reset();
  outbox_.clear();
  become(SEMBLANTE_STREAM_CONNECTING);
  events_.push(event_of(SEMBLANTE_EVENT_CONNECT));
}

void Stream::close(std::uint32_t code) {
  if (link_ != Link::none) {
    Event event = event_of(SEMBLANTE_EVENT_CLOSE);
    event.code = code;
    events_.push(std::move(event));
  }
  link_ = Link::none;
  greeted_ = false;
  next_ping_ = unanswered_since_ = retry_at_ = batch_until_ = never;
  batch_.frames.clear();
  outbox_.clear();
}

void Stream::stop() {
  close(normal_closure);
  become(SEMBLANTE_STREAM_CLOSED);
}

void Stream::wait_to_retry(double now) {
  close(unreadable);
  const double pause = std::min(options_.retry_longest, std::ldexp(options_.retry_first, static_cast<int>(attempts_)));
  attempts_ = std::min(attempts_ + 1, 60U);
  // Half of the pause is random, so that many clients do not reconnect at the same time.
  retry_at_ = now + pause * (0.5 + random_.next() / 2);
  become(SEMBLANTE_STREAM_WAITING);
}

void Stream::closed(double now) {
  if (link_ == Link::none) return;
  link_ = Link::none;  // nothing is left to close
  wait_to_retry(now);
}

void Stream::fail(Error error, double now) {
  Event event = event_of(SEMBLANTE_EVENT_FAULT);
  event.code = result_of(error.code);
  event.error = std::make_unique<Error>(std::move(error));
  events_.push(std::move(event));
  // All later differences depend on a lost message, so only a new connection helps.
  wait_to_retry(now);
}

void Stream::opened(double now) {
  if (link_ != Link::opening) return;
  link_ = Link::open;
  hello_at_ = unanswered_since_ = now;
  sent_resume_ = resume_;
  Hello hello;
  hello.role = options_.role;
  hello.resume = resume_;
  hello.take_over = options_.take_over;
  hello.sound = options_.sound;
  hello.text = options_.text && options_.role == StreamRole::subscribe;
  hello.captions = options_.captions && options_.role == StreamRole::subscribe;
  told_text_ = options_.text;
  told_captions_ = options_.captions;
  send(hello);
}

void Stream::send(const Message& message) {
  std::vector<std::uint8_t>& to = outbox_.bytes();
  if (options_.encode != nullptr) {
    options_.encode(message, steps_, to);
  } else {
    encode_message(message, to);
  }
  outbox_.end_message();
}

void Stream::tick(double now) {
  if (retry_at_ <= now) ask_for_connection(now);
  if (now - unanswered_since_ >= options_.silence_limit) {
    fail({ErrorCode::io, "", "the server does not answer"}, now);
    return;
  }
  if (!greeted_) return;
  if (next_ping_ <= now) send_ping(now);
  if (batch_until_ <= now) flush();
}

double Stream::wake_time() const {
  return std::min({retry_at_, next_ping_, batch_until_, unanswered_since_ + options_.silence_limit});
}

void Stream::measure_clock(double now) {
  if (!greeted_ || options_.ping_interval <= 0) return;
  pings_ = 0;
  send_ping(now);
}

void Stream::send_ping(double now) {
  ++pings_;
  next_ping_ = now + std::min(options_.ping_interval,
                              ping_pause(pings_, clock_.uncertainty().value_or(0), options_.ping_interval));
  if (outbox_.waiting() > most_waiting) return;
  Ping ping;
  ping.id = ++ping_id_;
  ping.client_time = now;
  send(ping);
  unanswered_since_ = std::min(unanswered_since_, now);
}

void Stream::receive(std::span<const std::uint8_t> bytes, double now) {
  if (link_ != Link::open || ended_) return;
  if (bytes.size() > options_.max_message_bytes) {
    return fail({ErrorCode::too_large, "", "a message of " + natural_text(bytes.size()) + " bytes"}, now);
  }
  if (!bytes.empty() && is_frames(bytes[0])) {
    Status status = decoder_.decode_frames(bytes, newest_);
    if (!status) {
      newest_.frames.clear();
      return fail(std::move(status).error(), now);
    }
    return take_frames(now, false);
  }
  auto message = decoder_.decode_from_server(bytes);
  if (message) return take(*message, now);
  unanswered_since_ = never;
  const Error& error = message.error();
  if (error.code == ErrorCode::unsupported && error.where == "/type") return;  // of a later version
  fail(std::move(message).error(), now);
}

void Stream::take(const Message& message, double now) {
  if (link_ != Link::open || ended_) return;
  if (const auto* header = std::get_if<Header>(&message)) {
    take_header(*header, now);
  } else if (const auto* keyframe = std::get_if<Keyframe>(&message)) {
    newest_.sequence = keyframe->sequence;
    newest_.media_time = keyframe->media_time;
    newest_.frames.assign(1, TimedFrame{0, keyframe->state});
    take_frames(now, true);
  } else if (const auto* frames = std::get_if<Frames>(&message)) {
    newest_ = *frames;
    take_frames(now, false);
  } else if (const auto* sound = std::get_if<SoundPacket>(&message)) {
    take_sound(*sound);
  } else if (const auto* text = std::get_if<SpeechText>(&message)) {
    take_text(*text);
  } else if (const auto* pong = std::get_if<Pong>(&message)) {
    take_pong(*pong, now);
  } else if (const auto* end = std::get_if<End>(&message)) {
    take_end(*end, now);
  } else if (const auto* refused = std::get_if<StreamError>(&message)) {
    unanswered_since_ = never;
    encoder_.reset();  // the server may not have the frame before the next difference
    Event event = event_of(SEMBLANTE_EVENT_REFUSED);
    event.code = static_cast<std::uint32_t>(refused->code);
    event.error = std::make_unique<Error>(Error{ErrorCode::invalid_argument, refused->where, refused->message});
    events_.push(std::move(event));
  }
}

void Stream::take_header(const Header& header, double now) {
  unanswered_since_ = never;
  if (header.version > protocol_version) {
    fail({ErrorCode::unsupported, "/version", "version " + natural_text(header.version) + " of the protocol"}, now);
    return stop();  // the next connection would begin in the same way
  }
  if (header_ && header_->epoch != header.epoch) clock_.clear();
  clock_.answered(hello_at_, now, static_cast<double>(header.media_time));
  header_ = header;
  steps_ = quantizers_of(header);
  resumed_ = !sent_resume_ || sent_resume_->epoch != header.epoch ? SEMBLANTE_FRESH
             : header.recovered                                   ? SEMBLANTE_RESUMED
                                                                  : SEMBLANTE_RESUMED_WITH_GAP;
  if (resume_ && resume_->epoch != header.epoch)
    resume_.reset();  // until the keyframe there is no point to resume from
  attempts_ = 0;
  greeted_ = true;
  Event event = event_of(SEMBLANTE_EVENT_HEADER);
  event.resumed = resumed_;
  event.epoch = header.epoch;
  event.sequence = header.sequence;
  event.media_time = static_cast<double>(header.media_time);
  events_.push(std::move(event));
  become(SEMBLANTE_STREAM_OPEN);
  for (Player* player : followers_) player->begin(*header_);
  tell_changed_wishes(now);
  measure_clock(now);
}

void Stream::tell_changed_wishes(double now) {
  if (options_.captions != told_captions_) send(CaptionsWish{options_.captions});
  if (options_.text != told_text_) {
    Spoken voice;
    voice.state = options_.text ? VoiceState::ready : VoiceState::failed;
    spoken(voice, now);
  }
}

void Stream::take_frames(double now, bool is_keyframe) {
  unanswered_since_ = never;
  if (!greeted_) {
    newest_.frames.clear();
    return fail({ErrorCode::mismatch, "/type", "frames before the header"}, now);
  }
  newest_at_ = now;
  is_newest_converted_ = false;
  resume_ = ResumePoint{header_->epoch, newest_.sequence + newest_.frames.size() - 1};
  for (Player* player : followers_) player->push(newest_, now);
  Event event = event_of(is_keyframe ? SEMBLANTE_EVENT_KEYFRAME : SEMBLANTE_EVENT_FRAMES);
  event.sequence = newest_.sequence;
  event.media_time = static_cast<double>(newest_.media_time) + newest_.frames.back().time;
  events_.push(std::move(event));
}

void Stream::take_sound(const SoundPacket& sound) {
  unanswered_since_ = never;
  if (!greeted_ || !options_.sound) return;
  Event event = event_of(SEMBLANTE_EVENT_SOUND);
  event.media_time = static_cast<double>(sound.media_time);
  event.sound = std::make_unique<SoundPacket>(sound);
  events_.push(std::move(event));
}

void Stream::take_text(const SpeechText& text) {
  unanswered_since_ = never;
  if (!greeted_ || !(options_.text || options_.captions)) return;
  Event event = event_of(SEMBLANTE_EVENT_TEXT);
  event.sequence = text.speech;
  event.media_time = static_cast<double>(text.media_time);
  event.text = std::make_unique<SpeechText>(text);
  events_.push(std::move(event));
}

Stream::Published Stream::spoken(Spoken spoken, double now) {
  if (options_.role != StreamRole::subscribe) return Published::invalid;
  if (spoken.state == VoiceState::failed) options_.text = false;
  if (spoken.state == VoiceState::ready) options_.text = true;
  if (!greeted_ || outbox_.waiting() > most_waiting) return Published::unavailable;
  spoken.media_time =
      static_cast<std::uint64_t>(std::clamp(clock_.at(now).value_or(0), 0.0, static_cast<double>(max_media_time)));
  send(spoken);
  return Published::sent;
}

bool Stream::set_captions(bool on) {
  if (options_.role != StreamRole::subscribe) return false;
  if (on == options_.captions) return true;
  options_.captions = on;
  if (greeted_) send(CaptionsWish{on});
  return true;
}

void Stream::take_pong(const Pong& pong, double now) {
  unanswered_since_ = never;
  const double round_trip = std::max(0.0, now - pong.client_time);
  clock_.answered(pong.client_time, now, static_cast<double>(pong.media_time));
  server_offset_ = pong.server_time + round_trip / 2 - now;
  Event event = event_of(SEMBLANTE_EVENT_CLOCK);
  event.round_trip = round_trip;
  event.server_offset = *server_offset_;
  event.media_time = static_cast<double>(pong.media_time) + round_trip / 2;
  events_.push(std::move(event));
}

void Stream::take_end(const End& end, double now) {
  ended_ = true;
  next_ping_ = never;
  unanswered_since_ = now;  // the server closes the connection
  Event event = event_of(SEMBLANTE_EVENT_END);
  event.code = static_cast<std::uint32_t>(end.reason);
  event.is_final =
      end.reason == EndReason::finished || end.reason == EndReason::deleted || end.reason == EndReason::replaced;
  const bool is_final = event.is_final;
  events_.push(std::move(event));
  if (is_final) stop();
}

std::span<const semblante_timed_frame> Stream::frames() {
  if (!is_newest_converted_) {
    converted_.clear();
    converted_.reserve(newest_.frames.size());
    for (const TimedFrame& frame : newest_.frames) {
      converted_.push_back(
          {static_cast<double>(newest_.media_time) + frame.time, to_kernel_frame(to_values(frame.state, steps_))});
    }
    is_newest_converted_ = true;
  }
  return converted_;
}

void Stream::add(Player& player) { followers_.push_back(&player); }

void Stream::remove(Player& player) { followers_.erase(std::find(followers_.begin(), followers_.end(), &player)); }

}  // namespace semblante::runtime
