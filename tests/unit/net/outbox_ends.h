#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <utility>

#include "server/net/outbox.h"

namespace semblante::net {

inline http::SharedWire wire(std::string bytes) {
  http::WireMessage message;
  message.bytes = std::move(bytes);
  return std::make_shared<const http::WireMessage>(std::move(message));
}

/// What an outbox asks of its connection.
struct Owner : OutboxOwner {
  void on_blocked() override { ++blocked; }
  void on_close(const http::CloseReason& reason) override { code = reason.code; }
  void on_over() override { over = true; }
  std::atomic<int> blocked{0};
  std::atomic<int> code{0};
  std::atomic<bool> over{false};
};

}  // namespace semblante::net
