#pragma once

#include <cstddef>
#include <span>

#include "server/http/websocket_peer.h"

namespace semblante::http {

/// A message of state for one connection, and what became of it.
struct Delivery {
  WebSocketSink* sink = nullptr;
  const SharedWire* message = nullptr;
  Sent sent = Sent::refused;  ///< until it is sent
};

/// Sends messages to many connections. One thread at a time.
class GroupSender {
 public:
  GroupSender() = default;
  virtual ~GroupSender() = default;
  GroupSender(const GroupSender&) = delete;
  GroupSender& operator=(const GroupSender&) = delete;

  /// Sets `sent` of each, in their order. A sink may be named once in a group.
  virtual void send(std::span<Delivery> group) {
    for (std::size_t i = 0; i < group.size(); ++i) {
      prefetch(group, i + looks_ahead);
      group[i].sent = group[i].sink->send(*group[i].message, Purpose::state);
    }
  }

 protected:
  /// Outboxes are scattered over memory: those of the next few deliveries are prefetched.
  static constexpr std::size_t looks_ahead = 4;
  static void prefetch(std::span<const Delivery> group, std::size_t index) {
    constexpr std::size_t line = 64;
    if (index >= group.size()) return;
    __builtin_prefetch(group[index].sink, 1);
    __builtin_prefetch(reinterpret_cast<const char*>(group[index].sink) + line, 1);
  }
};

}  // namespace semblante::http
