#include "clients/native/client/stream_publisher.h"

#include <algorithm>
#include <utility>
#include <variant>

#include <nlohmann/json.hpp>

#include "protocol/cpp/kernel_values.h"
#include "protocol/http/http_client.h"

namespace semblante::client {

StreamPublisher::StreamPublisher(ServerAddress server, std::string stream, PublisherOptions options)
    : server_(std::move(server)),
      stream_(std::move(stream)),
      options_(std::move(options)),
      wait_(options_.retry_first) {}

Status StreamPublisher::look_after() {
  if (client_) {
    // The connection's handlers run only while it is polled for messages.
    static_cast<void>(listen(std::chrono::milliseconds(1)));
    return Unit{};
  }
  return Clock::now() < next_try_ ? Status(Unit{}) : connect();
}

Status StreamPublisher::connect() {
  StreamOptions wanted;
  wanted.role = StreamRole::publish;
  wanted.take_over = options_.take_over;
  wanted.timeout = options_.timeout;
  auto client = StreamClient::connect(server_, stream_, wanted);
  if (!client && client.error().code == ErrorCode::missing) {
    if (!options_.create) return std::move(client).error();
    if (auto made = make_stream(); !made) return made;
    client = StreamClient::connect(server_, stream_, wanted);
  }
  if (!client) {
    if (client.error().code == ErrorCode::invalid_argument) return std::move(client).error();
    lose(client.error().message);
    return Unit{};
  }
  client_ = *std::move(client);
  has_header_ = false;
  needs_keyframe_ = true;
  const Clock::time_point deadline = Clock::now() + options_.timeout;
  while (client_ && !has_header_ && Clock::now() < deadline) {
    static_cast<void>(listen(std::chrono::milliseconds(50)));
  }
  if (client_ && !has_header_) lose("the server sends no header");
  if (client_) {
    wait_ = options_.retry_first;
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
    lose(answer.error().message);
    return Unit{};
  }
  // Another client may have made it meanwhile.
  if (answer->status == 201 || answer->status == 409) return Unit{};
  return Error{
      ErrorCode::invalid_argument, stream_,
      "the server does not create this stream: " + std::to_string(answer->status) + " " + answer->body.substr(0, 500)};
}

bool StreamPublisher::listen(std::chrono::milliseconds patience) {
  auto message = client_->next(patience);
  if (!message) {
    const std::string reason = client_->close_reason();
    lose(reason.empty() ? message.error().message : reason);
    return false;
  }
  if (!*message) return true;
  if (const auto* header = std::get_if<Header>(&**message)) {
    steps_ = quantizers_of(*header);
    has_header_ = true;
  } else if (const auto* error = std::get_if<StreamError>(&**message)) {
    // The server's state is that before the refused message.
    needs_keyframe_ = true;
    if (last_trouble_ != error->message) news_ = "error of the server: " + error->message;
    last_trouble_ = error->message;
  } else if (std::holds_alternative<End>(**message)) {
    lose("the server ended the stream");
    return false;
  }
  return true;
}

bool StreamPublisher::publish(const semblante_frame& frame, std::uint64_t media_time) {
  if (!client_) return false;
  const FaceFrame state = quantized(frame, steps_);
  ++sequence_;
  const Message message = needs_keyframe_ ? Message(Keyframe{sequence_, media_time, state})
                                          : Message(Frames{sequence_, media_time, {TimedFrame{0, state}}});
  if (auto sent = client_->send(message); !sent) {
    lose(sent.error().message);
    return false;
  }
  needs_keyframe_ = false;
  return true;
}

void StreamPublisher::lose(const std::string& why) {
  client_.reset();
  next_try_ = Clock::now() + wait_;
  wait_ = std::min(2 * wait_, options_.retry_most);
  if (last_trouble_ != why) news_ = "no connection to " + stream_ + ": " + why;
  last_trouble_ = why;
}

std::optional<std::string> StreamPublisher::take_news() { return std::exchange(news_, std::nullopt); }

void StreamPublisher::close() {
  if (client_) client_->close();
  client_.reset();
}

}  // namespace semblante::client
