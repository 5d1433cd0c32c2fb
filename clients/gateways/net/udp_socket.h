#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/types/result.h"

namespace semblante::gateways {

/// "host:port" with a number for a port, an IPv6 address in brackets; without a port the default port is used.
struct Endpoint {
  std::string host;
  std::string port;
};
Result<Endpoint> parse_endpoint(const std::string& text, const std::string& usual_port);

/// One UDP socket, for one thread.
class UdpSocket {
 public:
  /// Receives at an address of this machine (numeric, not a name). Port 0: any free port.
  static Result<UdpSocket> listen(const Endpoint& at);
  /// Sends to one address. Unless `anywhere`, only loopback addresses are accepted: with UDP the receiver does not
  /// consent to the packets.
  static Result<UdpSocket> send_to(const Endpoint& to, bool anywhere);
  ~UdpSocket();
  UdpSocket(UdpSocket&& other) noexcept;
  UdpSocket& operator=(UdpSocket&& other) noexcept;

  [[nodiscard]] std::uint16_t port() const;

  /// Waits for a packet; false at the timeout (or a signal).
  bool wait(std::chrono::milliseconds timeout);
  /// The received packet, valid until the next call; nullopt when there is none.
  std::optional<std::span<const std::uint8_t>> receive();
  /// False when the system does not accept it; delivery is unknown with UDP.
  bool send(std::span<const std::uint8_t> packet);

 private:
  explicit UdpSocket(int handle);

  int handle_ = -1;
  std::vector<std::uint8_t> buffer_;
};

}  // namespace semblante::gateways
