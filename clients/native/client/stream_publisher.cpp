#include "clients/native/client/stream_publisher.h"

#include <random>
#include <span>
#include <utility>

#include <nlohmann/json.hpp>

#include "clients/native/client/carry.h"
#include "clients/native/client/stream_refusal.h"
#include "protocol/http/http_client.h"

namespace semblante::client {
namespace {

runtime::StreamOptions machine_options(const PublisherOptions& from) {
  runtime::StreamOptions options;
  options.role = StreamRole::publish;
  options.take_over = from.take_over;
  options.retry_first = static_cast<double>(from.retry_first.count());
  options.retry_longest = static_cast<double>(from.retry_most.count());
  options.seed = std::random_device{}();
  return options;
}

}  // namespace

StreamPublisher::StreamPublisher(ServerAddress server, std::string stream, PublisherOptions options)
    : server_(std::move(server)),
      stream_(std::move(stream)),
      options_(std::move(options)),
      machine_(machine_options(options_)),
      start_at_(now()) {}

double StreamPublisher::now() {
  return std::chrono::duration<double, std::milli>(Clock::now().time_since_epoch()).count();
}

Status StreamPublisher::look_after() {
  if (start_at_ && *start_at_ <= now()) {
    start_at_.reset();
    machine_.start(now());
  }
  if (auto done = obey(); !done) return done;
  // The connection's handlers run only while it is polled for messages.
  if (socket_) listen(std::chrono::milliseconds(1));
  return obey();
}

Status StreamPublisher::obey() {
  machine_.tick(now());
  while (!machine_.events().empty()) {
    const runtime::Event event = machine_.events().take();
    switch (event.type) {
      case SEMBLANTE_EVENT_CONNECT:
        if (auto connected = connect(); !connected) return connected;
        break;
      case SEMBLANTE_EVENT_CLOSE:
        socket_.reset();
        break;
      case SEMBLANTE_EVENT_REFUSED:
        trouble("error of the server: ", event.error->message);
        break;
      case SEMBLANTE_EVENT_FAULT:
        trouble("no connection to " + stream_ + ": ", event.error->message);
        break;
      case SEMBLANTE_EVENT_END:
        trouble("no connection to " + stream_ + ": ", end_of_stream(event.code, stream_).message);
        if (event.is_final) start_at_ = now() + static_cast<double>(options_.retry_first.count());
        break;
      default:
        break;
    }
  }
  if (socket_) {
    if (auto sent = send_all(machine_, *socket_); !sent) lose(sent.error().message);
  }
  return Unit{};
}

Status StreamPublisher::connect() {
  const SocketOptions wanted{.timeout = options_.timeout};
  auto socket = StreamSocket::open(server_, stream_, wanted);
  if (!socket && socket.error().code == ErrorCode::missing) {
    if (!options_.create) return std::move(socket).error();
    if (auto made = make_stream(); !made) return made;
    socket = StreamSocket::open(server_, stream_, wanted);
  }
  if (!socket) {
    if (socket.error().code == ErrorCode::invalid_argument) return std::move(socket).error();
    lose(socket.error().message);
    return Unit{};
  }
  socket_ = *std::move(socket);
  machine_.opened(now());
  if (auto sent = send_all(machine_, *socket_); !sent) lose(sent.error().message);
  const Clock::time_point deadline = Clock::now() + options_.timeout;
  while (socket_ && machine_.state() == SEMBLANTE_STREAM_CONNECTING && Clock::now() < deadline) {
    listen(std::chrono::milliseconds(50));
  }
  if (socket_ && machine_.state() == SEMBLANTE_STREAM_CONNECTING) lose("the server sends no header");
  if (connected()) {
    last_trouble_.clear();
    news_ = "publishing to " + stream_;
  }
  return Unit{};
}

Status StreamPublisher::make_stream() {
  nlohmann::json body = {{"name", stream_}};
  if (!options_.model.empty()) body["model"] = options_.model;
  HttpLimits limits;
  limits.timeout = options_.timeout;
  const auto answer = HttpClient(server_, limits).post("/v1/streams", body.dump(), "application/json");
  if (!answer) {
    trouble("no connection to " + stream_ + ": ", answer.error().message);
    return Unit{};
  }
  // Another client may have made it meanwhile.
  if (answer->status == 201 || answer->status == 409) return Unit{};
  return Error{ErrorCode::invalid_argument, stream_, "the server does not create this stream: " + words_of(*answer)};
}

void StreamPublisher::listen(std::chrono::milliseconds patience) {
  auto bytes = socket_->read(patience);
  if (!bytes) {
    const std::string reason = socket_->close_reason();
    return lose(reason.empty() ? bytes.error().message : reason);
  }
  if (*bytes) machine_.receive(**bytes, now());
}

bool StreamPublisher::publish(const semblante_frame& frame, std::uint64_t media_time) {
  if (!connected()) return false;
  const semblante_timed_frame timed{0, frame};
  const auto published = machine_.publish({&timed, 1}, static_cast<double>(media_time), now());
  if (published != runtime::Stream::Published::sent) return false;
  if (auto sent = send_all(machine_, *socket_); !sent) {
    lose(sent.error().message);
    return false;
  }
  return true;
}

void StreamPublisher::lose(const std::string& why) {
  socket_.reset();
  machine_.closed(now());
  trouble("no connection to " + stream_ + ": ", why);
}

void StreamPublisher::trouble(const std::string& what, const std::string& why) {
  if (last_trouble_ != why) news_ = what + why;
  last_trouble_ = why;
}

std::optional<std::string> StreamPublisher::take_news() { return std::exchange(news_, std::nullopt); }

void StreamPublisher::close() {
  machine_.stop();
  start_at_.reset();
  if (socket_) socket_->close();
  socket_.reset();
}

}  // namespace semblante::client
