#include "server/streams/stream_connection.h"

#include <algorithm>
#include <span>
#include <utility>
#include <variant>

#include "protocol/cpp/json_codec.h"

namespace semblante::streams {
namespace {

using Clock = std::chrono::steady_clock;
/// Answers to a client's own messages (errors, pongs) wait here at most; a client that asks without reading gets no
/// more.
constexpr std::size_t max_answers = 256;

template <class... T>
struct Overloaded : T... {
  using T::operator()...;
};
template <class... T>
Overloaded(T...) -> Overloaded<T...>;

}  // namespace

StreamConnection::StreamConnection(std::shared_ptr<Stream> stream, bool binary, bool subprotocol_offered)
    : stream_(std::move(stream)),
      binary_(binary),
      subprotocol_offered_(subprotocol_offered),
      rate_tokens_(stream_->limits().frames_burst) {}

// ---- net's side
// ------------------------------------------------------------------------------------------------------

void StreamConnection::attach(std::function<void()> wake) {
  const std::lock_guard lock(mutex_);
  wake_ = std::move(wake);
  if (wake_ && (!pending_.empty() || closing_)) wake_();
}

void StreamConnection::wake() {
  if (wake_) wake_();
}

std::optional<http::FeedItem> StreamConnection::take() {
  bool behind = false;
  {
    const std::lock_guard lock(mutex_);
    stalled_since_.reset();
    behind = behind_ && pending_.empty() && !closing_;
  }
  // Outside the mutex: the stream's comes first.
  if (behind) stream_->catch_up(*this);
  const std::lock_guard lock(mutex_);
  if (pending_.empty()) return std::nullopt;
  http::FeedItem item{std::move(pending_.front()), binary_};
  pending_.pop_front();
  return item;
}

bool StreamConnection::finished() const {
  const std::lock_guard lock(mutex_);
  return closing_.has_value();
}

std::string_view StreamConnection::subprotocol() const {
  if (!subprotocol_offered_) return {};
  return binary_ ? binary_subprotocol : json_subprotocol;
}

std::size_t StreamConnection::max_message_bytes() const {
  return binary_ ? max_binary_message_bytes : max_json_message_bytes;
}

http::CloseReason StreamConnection::close_reason() const {
  const std::lock_guard lock(mutex_);
  return closing_.value_or(http::CloseReason{});
}

void StreamConnection::disconnected() { stream_->leave(*this); }

void StreamConnection::receive(std::string_view bytes, bool binary) {
  if (finished()) return;
  // Whatever comes, it is answered and the connection goes on; who never says hello is closed by the clock.
  if (binary != binary_) {
    refuse(StreamErrorCode::malformed, "",
           binary_ ? "this subprotocol is binary, a text came" : "this subprotocol is text, bytes came");
    return;
  }
  auto decoded = binary_ ? decoder_.decode(std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()))
                         : decode_json(bytes);
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
  {
    const std::lock_guard lock(mutex_);
    role_ = hello.role;
  }
  if (hello.role == StreamRole::subscribe) {
    stream_->subscribe(*this, hello);
  } else if (!stream_->begin_publishing(*this)) {
    close(Message(StreamError{StreamErrorCode::conflict, "/role",
                              "somebody else publishes or plays to this stream: one source at a time"}),
          {1008, "another source is there"});
  }
}

bool StreamConnection::within_rate(std::size_t frames) {
  const auto now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - rate_time_).count();
  const auto& limits = stream_->limits();
  rate_time_ = now;
  rate_tokens_ = std::min<double>(limits.frames_burst, rate_tokens_ + seconds * limits.frames_per_second);
  if (rate_tokens_ < static_cast<double>(frames)) return false;
  rate_tokens_ -= static_cast<double>(frames);
  return true;
}

void StreamConnection::handle_frames(std::uint64_t media_time, const std::vector<TimedFrame>& frames) {
  bool publishes = false;
  {
    const std::lock_guard lock(mutex_);
    publishes = role_ == StreamRole::publish;
  }
  if (!publishes) {
    refuse(StreamErrorCode::invalid_argument, "", "this connection subscribes: only a publisher sends frames");
    return;
  }
  if (!within_rate(frames.size())) {
    refuse(StreamErrorCode::throttled, "/frames",
           "more than " + std::to_string(stream_->limits().frames_per_second) + " frames a second");
    return;
  }
  if (auto taken = stream_->publish(Source::connection, media_time, frames); !taken)
    send(Message(to_stream_error(taken.error())));
}

// ---- the stream's side
// -----------------------------------------------------------------------------------------------

SharedBytes StreamConnection::encode(const Message& message) const {
  if (!binary_) return std::make_shared<const std::string>(encode_json(message));
  const auto bytes = FrameEncoder().encode(message);
  return std::make_shared<const std::string>(bytes.begin(), bytes.end());
}

bool StreamConnection::subscribed() const {
  const std::lock_guard lock(mutex_);
  return subscribed_ && !closing_;
}

bool StreamConnection::said_hello() const {
  const std::lock_guard lock(mutex_);
  return role_.has_value();
}

void StreamConnection::set_subscribed() {
  const std::lock_guard lock(mutex_);
  subscribed_ = true;
}

std::size_t StreamConnection::send(const SharedBytes& bytes) {
  const std::lock_guard lock(mutex_);
  if (closing_) return 0;
  if (!pending_.empty() && !stalled_since_) stalled_since_ = Clock::now();
  if (behind_) return 1;
  if (pending_.size() >= stream_->limits().pending_messages) {
    const auto dropped = pending_.size() + 1;
    pending_.clear();
    behind_ = true;
    wake();
    return dropped;
  }
  pending_.push_back(bytes);
  wake();
  return 0;
}

void StreamConnection::send(const Message& message) {
  auto bytes = encode(message);
  const std::lock_guard lock(mutex_);
  if (closing_ || pending_.size() >= max_answers) return;
  pending_.push_back(std::move(bytes));
  wake();
}

void StreamConnection::resume_with(const Message& keyframe) {
  auto bytes = encode(keyframe);
  const std::lock_guard lock(mutex_);
  if (closing_ || !behind_) return;
  behind_ = false;
  pending_.push_front(std::move(bytes));
}

void StreamConnection::close(const std::optional<Message>& last, http::CloseReason reason) {
  auto bytes = last ? encode(*last) : nullptr;
  const std::lock_guard lock(mutex_);
  if (closing_) return;
  if (reason.code == 1013) pending_.clear();
  if (bytes) pending_.push_back(std::move(bytes));
  closing_ = std::move(reason);
  wake();
}

void StreamConnection::refuse(StreamErrorCode code, std::string where, std::string message) {
  send(Message(StreamError{code, std::move(where), std::move(message)}));
}

std::optional<std::chrono::steady_clock::time_point> StreamConnection::stalled_since() const {
  const std::lock_guard lock(mutex_);
  return stalled_since_;
}

}  // namespace semblante::streams
