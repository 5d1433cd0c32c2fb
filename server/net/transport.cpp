#include "server/net/transport.h"

#include <array>
#include <span>
#include <utility>
#include <vector>

#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>

#include "server/net/error_value.h"

namespace semblante::net {

namespace asio = boost::asio;
using asio::ip::tcp;

namespace {

constexpr std::size_t dropped_piece_bytes = std::size_t{64} * 1024;
constexpr std::size_t most_dropped_bytes = std::size_t{64} << 20U;
constexpr std::chrono::seconds time_of_closing{2};

}  // namespace

/// Shared with the pending wait of the timer, which may complete after the transport is gone.
struct Transport::Timed {
  explicit Timed(tcp::socket s) : socket(std::move(s)), timer(socket.get_executor()) {}
  tcp::socket socket;
  asio::steady_timer timer;  ///< far in the future between two steps
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();
};

Transport::Transport(tcp::socket socket, std::shared_ptr<TlsSession> tls)
    : timed_(std::make_shared<Timed>(std::move(socket))), tls_(std::move(tls)) {}

// Asio declares that cancelling or setting a timer may throw; its timers never do.
Transport::~Transport() {  // NOLINT(bugprone-exception-escape)
  if (!timed_) return;
  timed_->timer.cancel();
  boost::system::error_code ignored;
  timed_->socket.close(ignored);
}

asio::any_io_executor Transport::get_executor() { return timed_->socket.get_executor(); }

void Transport::expires_after(std::chrono::steady_clock::duration time) {
  timed_->deadline = std::chrono::steady_clock::now() + time;
}

/// Applies the deadline to one step: between steps, while a handler works, none passes.
class Transport::Limited {
 public:
  explicit Limited(const std::shared_ptr<Timed>& timed) : timed_(timed) {
    timed->timer.expires_at(timed->deadline);
    timed->timer.async_wait([weak = std::weak_ptr<Timed>(timed)](ErrorCode error) {
      const auto late = weak.lock();
      // The wait may have completed just before its step did, and the next step has set the timer again.
      if (error || !late || late->timer.expiry() > std::chrono::steady_clock::now()) return;
      // Not closed: a session of TLS still has the descriptor. Pending and later steps end.
      ErrorCode ignored;
      late->socket.shutdown(tcp::socket::shutdown_both, ignored);
      late->socket.cancel(ignored);
    });
  }
  ~Limited() {  // NOLINT(bugprone-exception-escape): as above
    timed_->timer.expires_at(asio::steady_timer::time_point::max());
  }
  Limited(const Limited&) = delete;
  Limited& operator=(const Limited&) = delete;

 private:
  const std::shared_ptr<Timed> timed_;
};

asio::awaitable<Transport::ErrorCode> Transport::wait(TlsSession::Step step) {
  ErrorCode error;
  if (step == TlsSession::Step::ended) co_return asio::error::eof;
  co_await timed_->socket.async_wait(
      step == TlsSession::Step::wants_write ? tcp::socket::wait_write : tcp::socket::wait_read, error_into(error));
  co_return error;
}

asio::awaitable<Transport::ErrorCode> Transport::handshake() {
  const Limited limited(timed_);
  while (tls_) {
    const auto step = tls_->handshake();
    if (step == TlsSession::Step::done) break;
    if (const auto error = co_await wait(step)) co_return error;
  }
  co_return ErrorCode();
}

asio::awaitable<std::size_t> Transport::read_some(asio::mutable_buffer into, ErrorCode& error) {
  const Limited limited(timed_);
  if (!tls_) co_return co_await timed_->socket.async_read_some(asio::buffer(into), error_into(error));
  error = {};
  while (!error) {
    const auto progress = tls_->read(std::span(static_cast<char*>(into.data()), into.size()));
    if (progress.step == TlsSession::Step::done) co_return progress.bytes;
    error = co_await wait(progress.step);
  }
  co_return 0;
}

asio::awaitable<Transport::ErrorCode> Transport::write(std::string_view first, std::string_view second) {
  const Limited limited(timed_);
  ErrorCode error;
  if (!tls_) {
    const std::array<asio::const_buffer, 2> both = {asio::buffer(first), asio::buffer(second)};
    co_await asio::async_write(timed_->socket, both, error_into(error));
    co_return error;
  }
  for (auto rest : {first, second}) {
    while (!rest.empty()) {
      const auto progress = tls_->write(rest);
      rest.remove_prefix(progress.bytes);
      if (progress.step == TlsSession::Step::done) continue;
      if ((error = co_await wait(progress.step))) co_return error;
    }
  }
  co_return error;
}

asio::awaitable<void> Transport::close_gently() {
  if (tls_) tls_->close();
  ErrorCode error;
  timed_->socket.shutdown(tcp::socket::shutdown_send, error);
  std::vector<char> dropped(dropped_piece_bytes);
  expires_after(time_of_closing);
  const Limited limited(timed_);
  error = {};
  for (std::size_t total = 0; !error && total < most_dropped_bytes;)
    total += co_await timed_->socket.async_read_some(asio::buffer(dropped), error_into(error));
}

tcp::socket Transport::release_socket() {
  timed_->timer.cancel();
  return std::move(timed_->socket);
}

}  // namespace semblante::net
