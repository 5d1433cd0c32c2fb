#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <latch>
#include <memory>
#include <stdexcept>
#include <string>
#include <unistd.h>

#include <sys/resource.h>

#include "server/http/application.h"

namespace semblante::net {

/// Nice of the calling thread.
inline int rank_of_this_thread() { return ::getpriority(PRIO_PROCESS, static_cast<id_t>(::gettid())); }

/// Says back what it is told, and ends like a fault of ours at "throw".
class Echo : public http::WebSocketPeer {
 public:
  explicit Echo(std::atomic<int>& here) : here_(here) { ++here_; }
  [[nodiscard]] std::string_view subprotocol() const override { return {}; }
  [[nodiscard]] std::size_t max_message_bytes() const override { return 1 << 20; }
  [[nodiscard]] http::OutboxLimits outbox_limits() const override { return {}; }
  void attach(std::shared_ptr<http::WebSocketSink> sink) override { sink_ = std::move(sink); }
  void receive(std::string_view bytes, bool binary) override {
    if (bytes == "rank") return say(std::to_string(rank_of_this_thread()));
    if (bytes == "throw") throw std::runtime_error("a fault of ours");
    if (bytes == "bye") return sink_->close({1000, "bye"}, nullptr);
    sink_->send(http::make_wire(bytes, binary), http::Purpose::answer);
  }
  void writable() override {}
  void disconnected() override { --here_; }

 private:
  void say(const std::string& text) { sink_->send(http::make_wire(text, false), http::Purpose::answer); }
  std::atomic<int>& here_;
  std::shared_ptr<http::WebSocketSink> sink_;
};

struct EchoApplication : http::Application {
  std::variant<http::BodyPlan, http::Response> plan(const http::Request& head) override {
    if (head.path == "/bad-plan") throw std::runtime_error("a fault of ours");
    http::BodyPlan plan;
    plan.max_bytes = 100;
    plan.immediate = head.path.starts_with("/immediate");
    if (head.path == "/upload") plan = {.max_bytes = 100, .to_file = true};
    return plan;
  }
  http::Response handle(http::Request& request) override {
    if (request.path == "/throw") throw 42;  // NOLINT(hicpp-exception-baseclass): not even a std::exception
    if (request.path == "/slow") {
      ++waiting;
      released.wait();
    }
    http::Response response;
    if (request.path == "/rank" || request.path == "/immediate/rank") {
      response.body = std::to_string(rank_of_this_thread());
      return response;
    }
    if (request.path == "/file") {
      response.headers = {{"ETag", "\"file\""}, {"Content-Type", "text/plain"}, {"X-Frame-Options", "DENY"}};
      response.body = http::FileBody{file, 0, file_bytes};
      return response;
    }
    if (request.path == "/removed") {
      response.body = http::FileBody{file, 0, file_bytes, nullptr, std::make_shared<const http::OpenFile>(file)};
      std::filesystem::remove(file);
      return response;
    }
    response.body = request.body;
    return response;
  }
  std::variant<std::shared_ptr<http::WebSocketPeer>, http::Response> open_websocket(const http::Request&) override {
    ++opened;
    return std::shared_ptr<http::WebSocketPeer>(std::make_shared<Echo>(peers));
  }
  void decorate(const http::Request&, http::Response&) override {}
  std::filesystem::path file;
  std::uint64_t file_bytes = 0;
  std::atomic<int> opened{0}, peers{0}, waiting{0};
  std::latch released{1};
};

}  // namespace semblante::net
