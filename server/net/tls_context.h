#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/types/result.h"

struct ssl_ctx_st;

namespace semblante::net {

class TlsSession;

/// PEM files of a server.
struct TlsFiles {
  std::filesystem::path certificate;  ///< the server's certificate first, then those that sign it
  std::filesystem::path key;          ///< the private key of the first, without a passphrase
};

/// A certificate with its key, and the protocol that is spoken with it: TLS 1.2 with ephemeral keys and authenticated
/// ciphers, and TLS 1.3. Immutable: a new certificate is a new context, and connections keep the one they began with.
class TlsContext {
 public:
  /// Errors: `io` (a file cannot be read), `malformed` (no PEM, a key that does not belong to the certificate). `where`
  /// is --tls-cert or --tls-key.
  static Result<std::shared_ptr<const TlsContext>> load(const TlsFiles& files);
  ~TlsContext();
  TlsContext(const TlsContext&) = delete;
  TlsContext& operator=(const TlsContext&) = delete;

  /// The server's side of a connection that was just accepted. The socket must not block, and must outlive the
  /// session's last call.
  [[nodiscard]] std::shared_ptr<TlsSession> session(int descriptor) const;
  /// Host names and IP addresses that the certificate is for; wildcards are left out.
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  /// When the certificate ends.
  [[nodiscard]] std::chrono::system_clock::time_point expires() const { return expires_; }

 private:
  explicit TlsContext(ssl_ctx_st* context) : context_(context) {}
  ssl_ctx_st* context_;
  std::chrono::system_clock::time_point expires_;
  std::vector<std::string> names_;
};

}  // namespace semblante::net
