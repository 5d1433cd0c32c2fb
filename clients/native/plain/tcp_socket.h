#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/types/result.h"
#include "protocol/http/url.h"

namespace semblante::client {

/// A TCP connection by POSIX sockets. Each call ends at its deadline. For one thread.
class TcpSocket {
 public:
  using Clock = std::chrono::steady_clock;

  /// Tries the addresses of the host in turn; finding them takes as long as the system takes. Errors: unsupported
  /// (https), io.
  static Result<TcpSocket> open(const Url& url, Clock::time_point deadline);
  ~TcpSocket();
  TcpSocket(TcpSocket&& other) noexcept;
  TcpSocket& operator=(TcpSocket&& other) noexcept;

  /// Errors: io.
  Status send(std::span<const std::uint8_t> bytes, Clock::time_point deadline);
  /// The number of bytes that were there, up to the size of `into`; 0 when the server has closed; nullopt at the
  /// deadline. Errors: io.
  Result<std::optional<std::size_t>> receive(std::span<std::uint8_t> into, Clock::time_point deadline);

 private:
  explicit TcpSocket(int descriptor) : descriptor_(descriptor) {}
  int descriptor_;
};

}  // namespace semblante::client
