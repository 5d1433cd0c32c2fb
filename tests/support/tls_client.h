#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

struct ssl_ctx_st;
struct ssl_st;

namespace semblante::testing {

/// A blocking client of TLS on a port of this machine. It trusts every certificate.
class TlsClient {
 public:
  static constexpr std::uint32_t loopback = 0x7F000001;

  /// Versions as OpenSSL numbers them, such as TLS1_1_VERSION; 0: any. `receive_buffer`: bytes of the socket; 0: usual.
  /// `address`: of this machine, in the byte order of the host.
  explicit TlsClient(std::uint16_t port, int least_version = 0, int greatest_version = 0, int receive_buffer = 0,
                     std::uint32_t address = loopback);
  ~TlsClient();
  TlsClient(const TlsClient&) = delete;
  TlsClient& operator=(const TlsClient&) = delete;

  [[nodiscard]] bool connected() const { return connected_; }
  [[nodiscard]] std::string version() const;
  /// Common name of the server's certificate.
  [[nodiscard]] std::string certificate_name() const;
  [[nodiscard]] bool send(std::string_view bytes);
  /// So many bytes, or fewer when the connection ends before.
  std::string read(std::size_t count);
  /// To the empty line, and with it.
  std::string read_head();
  /// True when the server has said that nothing follows (close_notify); false for a bare end of the socket.
  bool ended_cleanly();
  /// Asks for new keys (TLS 1.3).
  void update_keys();

 private:
  int socket_ = -1;
  ssl_ctx_st* context_ = nullptr;
  ssl_st* ssl_ = nullptr;
  bool connected_ = false;
};

}  // namespace semblante::testing
