#pragma once

#include <chrono>
#include <cstddef>
#include <string_view>

#include <sys/types.h>

struct ssl_st;

namespace semblante::bench {

/// A client's connection, with TLS or without. Closes itself; no call waits, except where it says so.
class Socket {
 public:
  Socket() = default;
  explicit Socket(int descriptor) : descriptor_(descriptor) {}
  ~Socket() { close(); }
  Socket(Socket&& other) noexcept;
  Socket& operator=(Socket&& other) noexcept;

  /// Far longer than anything takes on a busy machine: what is not done by then does not come.
  static constexpr std::chrono::milliseconds patience{120'000};

  [[nodiscard]] int get() const { return descriptor_; }
  [[nodiscard]] bool open() const { return descriptor_ >= 0; }
  void close();
  /// Without a farewell: no port stays in TIME_WAIT.
  void reset();

  /// From now on the connection is encrypted. Every certificate is trusted. Allowed before the connection has come
  /// about.
  void use_tls();
  enum class Step { done, wait, failed };
  /// `wait`: call again when the socket is readable. Done at once without TLS.
  Step handshake();
  [[nodiscard]] bool handshake_in_time(std::chrono::milliseconds limit = patience);

  /// At most so many bytes; 0 at the end; -1 with errno, EAGAIN when there is nothing.
  ssize_t receive(char* into, std::size_t most) const;
  /// Bytes were read from the kernel that receive() has not returned: the kernel does not report them again.
  [[nodiscard]] bool holds_more() const;
  /// The same, waiting for the first byte up to a limit.
  ssize_t receive_in_time(char* into, std::size_t most, std::chrono::milliseconds limit = patience) const;
  /// Like send(): how many were accepted, or -1 with errno.
  ssize_t send(std::string_view bytes) const;
  /// All of it, waiting until the far side takes it; false when that is gone or takes no more.
  [[nodiscard]] bool send_all_in_time(std::string_view bytes, std::chrono::milliseconds limit = patience) const;

 private:
  [[nodiscard]] ssize_t failed(int result) const;
  [[nodiscard]] bool wait(short events, std::chrono::milliseconds limit) const;

  int descriptor_ = -1;
  ssl_st* tls_ = nullptr;
};

}  // namespace semblante::bench
