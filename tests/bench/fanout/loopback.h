#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <netinet/in.h>

#include "tests/bench/fanout/socket.h"

namespace semblante::bench {

/// Where a server listens. Loopback only: this program makes thousands of connections, which is nobody else's to bear.
struct Endpoint {
  sockaddr_in address{};
  bool tls = false;
  [[nodiscard]] std::string authority() const;  ///< "127.0.0.1:8080"
};

/// "http://127.0.0.1:8080" or https, also as a part of a longer line. Ends the program for what is not in 127.0.0.0/8.
Endpoint parse_endpoint(std::string_view text);

/// A connection, its handshake of TLS done; ends the program when there is none. `receive_buffer`: bytes the kernel may
/// hold for a reader that does not read; 0: as the system has it.
Socket connect_to(const Endpoint& endpoint, int receive_buffer = 0);
/// A connection that comes about in the background; with TLS its handshake follows. `number` chooses the source
/// address, so that ports do not run out.
Socket begin_connect(const Endpoint& endpoint, std::size_t number);
/// Ends the program when the far side is gone or takes no more.
void send_all(const Socket& socket, std::string_view bytes);

struct Reply {
  int status = 0;
  std::string body;
};
/// One request on a connection of its own. Ends the program when no answer comes.
Reply request(const Endpoint& endpoint, std::string_view method, std::string_view path, std::string_view body = {});

/// Says why and ends the program with status 2: what the bench needs is not there.
[[noreturn]] void give_up(const std::string& why);

/// ns of the monotonic clock, the same in every process of a machine.
std::int64_t now_ns();

}  // namespace semblante::bench
