#include "server/net/tls_session.h"

#include <algorithm>
#include <new>

#include <openssl/err.h>
#include <openssl/ssl.h>

namespace semblante::net {

TlsSession::TlsSession(SSL_CTX* context, int descriptor) : ssl_(SSL_new(context)) {
  if (ssl_ == nullptr || SSL_set_fd(ssl_, descriptor) != 1) {
    SSL_free(ssl_);
    throw std::bad_alloc();
  }
  SSL_set_accept_state(ssl_);
}

TlsSession::~TlsSession() { SSL_free(ssl_); }

TlsSession::Step TlsSession::step_of(int result) {
  switch (SSL_get_error(ssl_, result)) {
    case SSL_ERROR_WANT_READ:
      return Step::wants_read;
    case SSL_ERROR_WANT_WRITE:
      return Step::wants_write;
    default:
      // After a fatal error OpenSSL allows no further call, close_notify included.
      failed_ = true;
      return Step::ended;
  }
}

TlsSession::Step TlsSession::handshake() {
  const std::lock_guard lock(mutex_);
  if (failed_) return Step::ended;
  ERR_clear_error();
  const int result = SSL_do_handshake(ssl_);
  if (result != 1) return step_of(result);
  established_ = true;
  return Step::done;
}

TlsSession::Progress TlsSession::read(std::span<char> into) {
  const std::lock_guard lock(mutex_);
  if (failed_) return {};
  ERR_clear_error();
  std::size_t count = 0;
  const int result = SSL_read_ex(ssl_, into.data(), into.size(), &count);
  if (result == 1) return {Step::done, count};
  if (SSL_get_error(ssl_, result) == SSL_ERROR_ZERO_RETURN) return {};  // close_notify: the client reads on
  return {step_of(result), 0};
}

TlsSession::Progress TlsSession::write(std::string_view bytes) {
  const std::lock_guard lock(mutex_);
  if (failed_) return {};
  if (bytes.empty()) return {Step::done, 0};
  ERR_clear_error();
  std::size_t count = 0;
  const int result = SSL_write_ex(ssl_, bytes.data(), bytes.size(), &count);
  holds_write_ = false;
  if (result == 1) return {Step::done, count};
  const auto step = step_of(result);
  holds_write_ = step == Step::wants_write;
  // Without renegotiation a write never needs a read; a caller that waits for the socket to be writable would spin.
  if (step == Step::wants_read) failed_ = true;
  return {step == Step::wants_read ? Step::ended : step, 0};
}

bool TlsSession::holds_write() const {
  const std::lock_guard lock(mutex_);
  return holds_write_;
}

void TlsSession::close() {
  const std::lock_guard lock(mutex_);
  if (failed_ || !established_ || holds_write_) return;
  ERR_clear_error();
  SSL_shutdown(ssl_);
  ERR_clear_error();
}

bool TlsSession::kernel_encrypts() const {
  const std::lock_guard lock(mutex_);
#ifdef BIO_get_ktls_send
  return BIO_get_ktls_send(SSL_get_wbio(ssl_)) != 0;
#else
  return false;
#endif
}

}  // namespace semblante::net
