#include "tests/bench/fanout/socket.h"

#include <cerrno>
#include <poll.h>
#include <unistd.h>
#include <utility>

#include <openssl/err.h>
#include <openssl/ssl.h>
#include <sys/socket.h>

namespace semblante::bench {
namespace {

/// One for all connections; never freed.
SSL_CTX* client_context() {
  static SSL_CTX* const context = [] {
    SSL_CTX* made = SSL_CTX_new(TLS_client_method());
    SSL_CTX_set_mode(made,
                     SSL_MODE_ENABLE_PARTIAL_WRITE | SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER | SSL_MODE_RELEASE_BUFFERS);
    SSL_CTX_set_read_ahead(made, 1);  // the head of a record and its bytes by one call
    SSL_CTX_set_session_cache_mode(made, SSL_SESS_CACHE_OFF);
    return made;
  }();
  return context;
}

}  // namespace

Socket::Socket(Socket&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), tls_(std::exchange(other.tls_, nullptr)) {}

Socket& Socket::operator=(Socket&& other) noexcept {
  if (this != &other) {
    close();
    descriptor_ = std::exchange(other.descriptor_, -1);
    tls_ = std::exchange(other.tls_, nullptr);
  }
  return *this;
}

void Socket::close() {
  SSL_free(std::exchange(tls_, nullptr));
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
}

void Socket::reset() {
  if (descriptor_ < 0) return;
  const linger now{1, 0};
  setsockopt(descriptor_, SOL_SOCKET, SO_LINGER, &now, sizeof now);
  close();
}

void Socket::use_tls() {
  tls_ = SSL_new(client_context());
  SSL_set_fd(tls_, descriptor_);
  SSL_set_connect_state(tls_);
}

Socket::Step Socket::handshake() {
  if (tls_ == nullptr) return Step::done;
  ERR_clear_error();
  const int result = SSL_do_handshake(tls_);
  if (result == 1) return Step::done;
  return SSL_get_error(tls_, result) == SSL_ERROR_WANT_READ ? Step::wait : Step::failed;
}

bool Socket::handshake_in_time(std::chrono::milliseconds limit) {
  while (true) {
    const auto step = handshake();
    if (step != Step::wait) return step == Step::done;
    if (!wait(POLLIN, limit)) return false;
  }
}

ssize_t Socket::failed(int result) const {
  switch (SSL_get_error(tls_, result)) {
    case SSL_ERROR_WANT_READ:
    case SSL_ERROR_WANT_WRITE:
      errno = EAGAIN;
      return -1;
    case SSL_ERROR_ZERO_RETURN:
      return 0;
    case SSL_ERROR_SYSCALL:
      if (errno == 0) errno = ECONNRESET;
      return -1;
    default:
      // The end of a connection without close_notify, as after close() of a plain one.
      if (ERR_GET_REASON(ERR_peek_error()) == SSL_R_UNEXPECTED_EOF_WHILE_READING) return 0;
      errno = EPROTO;
      return -1;
  }
}

ssize_t Socket::receive(char* into, std::size_t most) const {
  if (tls_ == nullptr) return ::recv(descriptor_, into, most, MSG_DONTWAIT);
  ERR_clear_error();
  errno = 0;
  std::size_t count = 0;
  const int result = SSL_read_ex(tls_, into, most, &count);
  return result == 1 ? static_cast<ssize_t>(count) : failed(result);
}

bool Socket::holds_more() const { return tls_ != nullptr && SSL_has_pending(tls_) == 1; }

ssize_t Socket::send(std::string_view bytes) const {
  if (tls_ == nullptr) return ::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  ERR_clear_error();
  errno = 0;
  std::size_t count = 0;
  const int result = SSL_write_ex(tls_, bytes.data(), bytes.size(), &count);
  return result == 1 ? static_cast<ssize_t>(count) : failed(result);
}

bool Socket::wait(short events, std::chrono::milliseconds limit) const {
  pollfd descriptor{descriptor_, events, 0};
  return ::poll(&descriptor, 1, static_cast<int>(limit.count())) == 1;
}

ssize_t Socket::receive_in_time(char* into, std::size_t most, std::chrono::milliseconds limit) const {
  while (true) {
    const ssize_t size = receive(into, most);
    if (size >= 0 || errno != EAGAIN) return size;
    if (!wait(POLLIN, limit)) {
      errno = EAGAIN;
      return -1;
    }
  }
}

bool Socket::send_all_in_time(std::string_view bytes, std::chrono::milliseconds limit) const {
  while (!bytes.empty()) {
    const ssize_t sent = send(bytes);
    if (sent > 0)
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    else if (errno != EAGAIN || !wait(POLLOUT, limit))
      return false;
  }
  return true;
}

}  // namespace semblante::bench
