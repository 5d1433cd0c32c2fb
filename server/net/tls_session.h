#pragma once

#include <cstddef>
#include <mutex>
#include <span>
#include <string_view>

struct ssl_ctx_st;
struct ssl_st;

namespace semblante::net {

/// The server's side of TLS on one socket that does not block. Any thread: OpenSSL's state of a connection is one for
/// both directions, so a mutex guards it. No call waits.
class TlsSession {
 public:
  TlsSession(ssl_ctx_st* context, int descriptor);
  ~TlsSession();
  TlsSession(const TlsSession&) = delete;
  TlsSession& operator=(const TlsSession&) = delete;

  enum class Step {
    done,
    wants_read,   ///< call again when the socket is readable
    wants_write,  ///< call again when the socket is writable
    ended,        ///< the client has closed its side, or has violated the protocol
  };
  struct Progress {
    Step step = Step::ended;
    std::size_t bytes = 0;  ///< of the application, when done
  };

  Step handshake();
  Progress read(std::span<char> into);
  /// At least one byte when done. After wants_write the next call must begin with the same bytes: they are encrypted
  /// already.
  Progress write(std::string_view bytes);
  /// Bytes of an unfinished write() are encrypted and must be offered again.
  [[nodiscard]] bool holds_write() const;
  /// Tells the client that nothing follows, if the socket accepts that now.
  void close();
  /// Whether the kernel encrypts what is written (kTLS).
  [[nodiscard]] bool kernel_encrypts() const;

 private:
  Step step_of(int result);

  mutable std::mutex mutex_;
  ssl_st* ssl_;
  bool established_ = false, failed_ = false, holds_write_ = false;
};

}  // namespace semblante::net
