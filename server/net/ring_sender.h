#pragma once

#include <memory>

#include "server/http/group_sender.h"

namespace semblante::net {

/// Hands the messages of a group to the kernel by one system call (io_uring) where the system has that and permits it,
/// otherwise by one call each. Sinks that are not Outboxes, and connections with TLS, get theirs by
/// WebSocketSink::send.
std::unique_ptr<http::GroupSender> make_group_sender();

}  // namespace semblante::net
