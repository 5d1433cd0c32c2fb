#include "server/streams/stream_connection.h"

#include <algorithm>
#include <span>
#include <utility>
#include <variant>

#include "protocol/cpp/json_codec.h"
#include "server/streams/encoding.h"

namespace semblante::streams {
namespace {

template <class... T>
struct Overloaded : T... {
  using T::operator()...;
};
template <class... T>
Overloaded(T...) -> Overloaded<T...>;

http::SharedWire encoded(const Message& message, bool binary, const QuantizerSteps& steps) {
  http::WireMessage wire;
  append_encoded(wire.bytes, message, binary, steps);
  return std::make_shared<const http::WireMessage>(std::move(wire));
}

}  // namespace

StreamConnection::StreamConnection(std::shared_ptr<StreamAccess> stream, bool binary, bool subprotocol_offered,
                                   ConnectionRights rights)
    : StreamPeer(std::move(rights)),
      stream_(std::move(stream)),
      binary_(binary),
      subprotocol_offered_(subprotocol_offered) {}

StreamConnection::~StreamConnection() = default;

// ---- WebSocketPeer

std::string_view StreamConnection::subprotocol() const {
  if (!subprotocol_offered_) return {};
  return binary_ ? binary_subprotocol : json_subprotocol;
}

std::size_t StreamConnection::max_message_bytes() const {
  return binary_ ? max_binary_message_bytes : max_json_message_bytes;
}

http::OutboxLimits StreamConnection::outbox_limits() const { return stream_->outbox_limits(); }

void StreamConnection::attach(std::shared_ptr<http::WebSocketSink> sink) {
  std::unique_ptr<LastWords> last_words;
  {
    const std::lock_guard lock(mutex_);
    sink_ = std::move(sink);
    last_words = std::move(last_words_);
  }
  if (last_words) sink_->close(std::move(last_words->reason), last_words->last);
}

void StreamConnection::writable() { stream_->writable(*this); }

void StreamConnection::disconnected() {
  closing_ = true;
  stream_->leave(*this);
}

Result<Message> StreamConnection::read(std::string_view bytes, bool binary) {
  if (binary != binary_)
    return Error{ErrorCode::malformed, "",
                 binary_ ? "text message in a binary subprotocol" : "binary message in a text subprotocol"};
  if (!binary_) return decode_json(bytes, stream_->steps());
  FrameDecoder decoder_of_one;
  return (decoder_ ? *decoder_ : decoder_of_one)
      .decode(std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
}

bool StreamConnection::may_send_message() {
  if (messages_.take(1, TokenBucket::Clock::now())) return true;
  close(Message(StreamError{StreamErrorCode::throttled, "", "too many messages"}), {1008, "sends too many messages"});
  return false;
}

void StreamConnection::receive(std::string_view bytes, bool binary) {
  if (closing_) return;
  auto message = read(bytes, binary);
  const bool has_media =
      message && (std::holds_alternative<Frames>(*message) || std::holds_alternative<Keyframe>(*message) ||
                  std::holds_alternative<SoundPacket>(*message));
  // The frames and the sound of a publisher have limits of their own.
  if (!(has_media && role_ == Role::publishes) && !may_send_message()) return;
  // An invalid message is answered with an error and the connection stays open. The stream closes a client that sends
  // no hello in time.
  if (message)
    handle(std::move(*message));
  else
    send(Message(to_stream_error(message.error())));
}

void StreamConnection::handle(Message message) {
  if (role_ == Role::unknown && !std::holds_alternative<Hello>(message)) {
    refuse(StreamErrorCode::missing, "", "the first message must be a hello");
    return;
  }
  std::visit(
      Overloaded{
          [&](const Hello& hello) { handle_hello(hello); },
          [&](const Frames& frames) { handle_frames(frames.media_time, frames.frames); },
          [&](const Keyframe& key) {
            handle_frames(key.media_time, {TimedFrame{0, key.state}});
          },
          [&](const Ping& ping) {
            send(Message(Pong{ping.id, ping.client_time, server_time_now(), stream_->media_time_now()}));
          },
          [&](const End&) {
            stream_->end_publishing(*this);
            close(Message(End{EndReason::finished}), {1000, "bye"});
          },
          [&](const Pong&) {}, [&](const StreamError&) {}, [&](SoundPacket& sound) { handle_sound(std::move(sound)); },
          [&](const SpeechText&) { refuse(StreamErrorCode::invalid_argument, "", "only the server sends text"); },
          [&](const Spoken& spoken) { handle_spoken(spoken); },
          [&](const CaptionsWish& wish) { handle_captions(wish.on); },
          [&](const Header&) { refuse(StreamErrorCode::invalid_argument, "", "only the server sends a header"); }},
      message);
}

void StreamConnection::handle_hello(const Hello& hello) {
  if (role_ != Role::unknown) {
    refuse(StreamErrorCode::invalid_argument, "", "the hello was sent before");
    return;
  }
  // The hello has the highest version that the client knows; the header then has the version in use.
  if (hello.version < protocol_version) {
    close(Message(StreamError{StreamErrorCode::unsupported, "/version",
                              "this server speaks version " + std::to_string(protocol_version)}),
          {1008, "unsupported version"});
    return;
  }
  if (hello.role == StreamRole::subscribe) {
    role_ = Role::subscribes;
    stream_->subscribe(*this, *sink_, hello, binary_);
    return;
  }
  if (!may_publish()) {
    close(Message(StreamError{StreamErrorCode::unauthorized, "/role",
                              "to publish here needs a token with the scope publish that is accepted for this stream"}),
          {1008, "the token does not allow to publish"});
    return;
  }
  role_ = Role::publishes;
  decoder_ = std::make_unique<FrameDecoder>();
  has_sound_ = hello.sound;
  if (const auto header = stream_->begin_publishing(*this, hello)) {
    send(Message(*header));
  } else {
    close(Message(StreamError{StreamErrorCode::conflict, "/role",
                              "another source holds this stream; `take_over` in the hello replaces it"}),
          {1008, "another source holds the stream"});
  }
}

void StreamConnection::handle_spoken(const Spoken& spoken) {
  if (role_ != Role::subscribes) {
    refuse(StreamErrorCode::invalid_argument, "", "this connection publishes: only a subscriber has a voice");
    return;
  }
  if (const auto taken = stream_->spoken(*this, spoken); !taken) send(Message(to_stream_error(taken.error())));
}

void StreamConnection::handle_captions(bool on) {
  if (role_ != Role::subscribes) {
    refuse(StreamErrorCode::invalid_argument, "", "this connection publishes: only a subscriber shows captions");
    return;
  }
  stream_->show_captions(*this, on);
}

void StreamConnection::handle_sound(SoundPacket sound) {
  Status taken = Error{ErrorCode::invalid_argument, "", "only a publisher whose hello has `sound` sends sound"};
  if (has_sound_) taken = stream_->publish_sound(*this, std::move(sound));
  // Each refusal is answered, so it counts as a message.
  if (taken || (role_ == Role::publishes && !may_send_message())) return;
  auto error = to_stream_error(taken.error());
  if (error.code == StreamErrorCode::too_large) error.code = StreamErrorCode::throttled;
  send(Message(std::move(error)));
}

void StreamConnection::handle_frames(std::uint64_t media_time, const std::vector<TimedFrame>& frames) {
  if (role_ != Role::publishes) {
    refuse(StreamErrorCode::invalid_argument, "", "this connection subscribes: only a publisher sends frames");
    return;
  }
  const auto refusal = stream_->publish(*this, media_time, frames);
  if (!refusal || refusal->flood == FloodGuard::Verdict::drop) return;
  if (!refusal->flood) {
    send(Message(to_stream_error(refusal->error)));
    return;
  }
  const Message throttled(StreamError{StreamErrorCode::throttled, refusal->error.where, refusal->error.message});
  if (refusal->flood == FloodGuard::Verdict::close)
    close(throttled, {1008, "sends too many frames for too long"});
  else
    send(throttled);
}

void StreamConnection::send(const Message& message) {
  if (closing_) return;
  if (sink_->send(encoded(message, binary_, stream_->steps()), http::Purpose::answer) == http::Sent::refused)
    stream_->answer_dropped();
}

void StreamConnection::refuse(StreamErrorCode code, std::string where, std::string message) {
  send(Message(StreamError{code, std::move(where), std::move(message)}));
}

// ---- StreamPeer

bool StreamConnection::close(const Message& last, http::CloseReason reason) {
  if (closing_.exchange(true)) return false;
  auto words = encoded(last, binary_, stream_->steps());
  {
    const std::lock_guard lock(mutex_);
    if (sink_ == nullptr) {
      last_words_ = std::make_unique<LastWords>(LastWords{std::move(words), std::move(reason)});
      return true;
    }
  }
  sink_->close(std::move(reason), words);
  return true;
}

}  // namespace semblante::streams
