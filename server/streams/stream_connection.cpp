#include "server/streams/stream_connection.h"

#include <algorithm>
#include <span>
#include <utility>
#include <variant>

#include "protocol/cpp/json_codec.h"
#include "server/streams/encoding.h"

namespace semblante::streams {
namespace {

using Clock = std::chrono::steady_clock;

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

struct StreamConnection::Publishing {
  explicit Publishing(const FloodLimits& limits) : guard(limits, Clock::now()) {}

  FrameDecoder decoder;
  FloodGuard guard;
};

StreamConnection::StreamConnection(std::shared_ptr<Stream> stream, bool binary, bool subprotocol_offered)
    : stream_(std::move(stream)), binary_(binary), subprotocol_offered_(subprotocol_offered) {}

StreamConnection::~StreamConnection() = default;

// ---- net's side
// ------------------------------------------------------------------------------------------------------

std::string_view StreamConnection::subprotocol() const {
  if (!subprotocol_offered_) return {};
  return binary_ ? binary_subprotocol : json_subprotocol;
}

std::size_t StreamConnection::max_message_bytes() const {
  return binary_ ? max_binary_message_bytes : max_json_message_bytes;
}

http::OutboxLimits StreamConnection::outbox_limits() const {
  http::OutboxLimits limits;
  limits.messages = stream_->limits().pending_messages;
  limits.bytes = stream_->limits().pending_bytes;
  return limits;
}

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

void StreamConnection::receive(std::string_view bytes, bool binary) {
  if (closing_) return;
  // Whatever comes, it is answered and the connection goes on; who never says hello is closed by the clock.
  if (binary != binary_) {
    refuse(StreamErrorCode::malformed, "",
           binary_ ? "this subprotocol is binary, a text came" : "this subprotocol is text, bytes came");
    return;
  }
  // Only what a publisher sends refers to what it sent before.
  FrameDecoder decoder_of_one;
  auto& decoder = publishing_ ? publishing_->decoder : decoder_of_one;
  auto decoded = binary_ ? decoder.decode(std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()))
                         : decode_json(bytes, stream_->steps());
  if (decoded)
    handle(std::move(*decoded));
  else
    send(Message(to_stream_error(decoded.error())));
}

void StreamConnection::handle(Message message) {
  if (!said_hello() && !std::holds_alternative<Hello>(message)) {
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
            send(Message(Pong{ping.id, ping.client_time, Stream::server_time_now(), stream_->media_time_now()}));
          },
          [&](const End&) {
            stream_->end_publishing(*this);
            close(Message(End{EndReason::finished}), {1000, "bye"});
          },
          [&](const Pong&) {}, [&](const StreamError&) {},
          [&](const Header&) { refuse(StreamErrorCode::invalid_argument, "", "a header is the server's to send"); }},
      message);
}

void StreamConnection::handle_hello(const Hello& hello) {
  if (said_hello()) {
    refuse(StreamErrorCode::invalid_argument, "", "the hello was said already");
    return;
  }
  // The hello names the highest version the client knows; the header then says which one is spoken.
  if (hello.version < protocol_version) {
    close(Message(StreamError{StreamErrorCode::unsupported, "/version",
                              "this server speaks version " + std::to_string(protocol_version)}),
          {1008, "unsupported version"});
    return;
  }
  if (hello.role == StreamRole::subscribe) {
    role_ = Role::subscribes;
    stream_->subscribe(*this, hello);
    return;
  }
  role_ = Role::publishes;
  publishing_ = std::make_unique<Publishing>(stream_->limits().publisher);
  if (!stream_->begin_publishing(*this, hello.take_over)) {
    close(Message(StreamError{StreamErrorCode::conflict, "/role",
                              "somebody else publishes or plays to this stream: one source at a time; `take_over` in "
                              "the hello takes its place"}),
          {1008, "another source is there"});
  }
}

void StreamConnection::handle_frames(std::uint64_t media_time, const std::vector<TimedFrame>& frames) {
  if (!publishing_) {
    refuse(StreamErrorCode::invalid_argument, "", "this connection subscribes: only a publisher sends frames");
    return;
  }
  if (!admit(frames.size())) return;
  if (auto taken = stream_->publish(Source::connection, media_time, frames, this); !taken)
    send(Message(to_stream_error(taken.error())));
}

bool StreamConnection::admit(std::size_t frames) {
  const auto verdict = publishing_->guard.offer(frames, Clock::now());
  if (verdict == FloodGuard::Verdict::take) return true;
  stream_->count_throttled(frames);
  if (verdict == FloodGuard::Verdict::drop) return false;
  StreamError error{StreamErrorCode::throttled, "/frames", publishing_->guard.words()};
  if (verdict == FloodGuard::Verdict::drop_and_say) {
    send(Message(std::move(error)));
    return false;
  }
  stream_->dismiss(*this);
  close(Message(std::move(error)), {1008, "sends too many frames for too long"});
  return false;
}

// ---- the stream's side
// -----------------------------------------------------------------------------------------------

void StreamConnection::send(const Message& message) {
  // What came before attach() has nobody to send it; there is nothing but close() that does.
  if (closing_ || sink_ == nullptr) return;
  if (sink_->send(encoded(message, binary_, stream_->steps()), http::Purpose::answer) == http::Sent::refused)
    stream_->count_dropped();
}

void StreamConnection::close(const std::optional<Message>& last, http::CloseReason reason) {
  if (closing_.exchange(true)) return;
  auto words = last ? encoded(*last, binary_, stream_->steps()) : nullptr;
  {
    const std::lock_guard lock(mutex_);
    if (sink_ == nullptr) {
      last_words_ = std::make_unique<LastWords>(LastWords{std::move(words), std::move(reason)});
      return;
    }
  }
  sink_->close(std::move(reason), words);
}

void StreamConnection::refuse(StreamErrorCode code, std::string where, std::string message) {
  send(Message(StreamError{code, std::move(where), std::move(message)}));
}

}  // namespace semblante::streams
