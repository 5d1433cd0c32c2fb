#pragma once

// Private to net/: the layer under Beast's WebSocket.

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include <boost/asio/buffer.hpp>
#include <boost/asio/compose.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/websocket/teardown.hpp>

#include "server/net/frame_guard.h"
#include "server/net/outbox.h"

namespace semblante::net {

/// A socket whose writes go through the connection's Outbox, so that control frames of Beast and messages of the peer
/// have one writer. Meets Beast's AsyncStream.
class OutboxStream {
 public:
  using executor_type = boost::asio::ip::tcp::socket::executor_type;

  /// `tls` decrypts what is read; null for a plain socket. `on_fault` gets what `guard` finds, within a read. Nothing
  /// more is read then: a flood that is read until the connection is closed takes the thread that others need. Beast
  /// does not get the bytes of a wrong close frame, because it would answer them itself.
  OutboxStream(boost::asio::ip::tcp::socket socket, std::shared_ptr<TlsSession> tls, std::shared_ptr<Outbox> outbox,
               FrameGuard guard, std::function<void(const FrameGuard::Fault&)> on_fault)
      : socket_(std::move(socket)),
        tls_(std::move(tls)),
        outbox_(std::move(outbox)),
        guard_(guard),
        on_fault_(std::move(on_fault)) {}

  executor_type get_executor() { return socket_.get_executor(); }
  [[nodiscard]] boost::asio::ip::tcp::socket& socket() { return socket_; }

  template <class Buffers, class Handler>
  auto async_read_some(const Buffers& buffers, Handler&& handler) {
    return boost::asio::async_compose<Handler, void(boost::system::error_code, std::size_t)>(
        Read<Buffers>{*this, buffers}, handler, socket_);
  }

  /// Completes when the kernel has accepted the bytes, after all waiting ones. So a client that causes answers (pings)
  /// without reading them is not read from.
  template <class Buffers, class Handler>
  auto async_write_some(const Buffers& buffers, Handler&& handler) {
    std::string bytes(boost::asio::buffer_size(buffers), '\0');
    boost::asio::buffer_copy(boost::asio::buffer(bytes), buffers);
    return boost::asio::async_compose<Handler, void(boost::system::error_code, std::size_t)>(
        Write{*this, std::move(bytes)}, handler, socket_);
  }

  /// Strand only. Nothing is written after this; reading continues until the client closes its socket.
  void finish() { outbox_->finish(); }

  /// Strand only. The descriptor is not used after this.
  void close() {
    outbox_->detach();
    boost::system::error_code ignored;
    socket_.close(ignored);
  }

 private:
  template <class Buffers>
  struct Read {
    OutboxStream& stream;
    Buffers buffers;
    enum class Step { begin, plain, wait, posted, held } step = Step::begin;
    std::size_t count = 0;

    template <class Self>
    void operator()(Self& self, boost::system::error_code error = {}, std::size_t plain_count = 0) {
      namespace asio = boost::asio;
      if (step == Step::held) return self.complete(error ? error : asio::error::connection_aborted, 0);
      if (step == Step::begin && stream.is_over_) return hold(self);
      if (step == Step::begin && !stream.tls_) {
        step = Step::plain;
        stream.socket_.async_read_some(buffers, std::move(self));
        return;
      }
      if (step == Step::plain) return done(self, error, plain_count);
      if (step == Step::posted || error) return done(self, error ? error : result, count);
      const asio::mutable_buffer first = first_of(buffers);
      const auto progress = stream.tls_->read({static_cast<char*>(first.data()), first.size()});
      if (progress.step == TlsSession::Step::wants_read || progress.step == TlsSession::Step::wants_write) {
        step = Step::wait;
        stream.socket_.async_wait(progress.step == TlsSession::Step::wants_read ? asio::socket_base::wait_read
                                                                                : asio::socket_base::wait_write,
                                  std::move(self));
        return;
      }
      count = progress.bytes;
      if (progress.step == TlsSession::Step::ended) result = asio::error::eof;
      if (step == Step::wait) return done(self, result, count);
      // Posted, so that it never runs before the initiating function has returned.
      step = Step::posted;
      asio::post(stream.get_executor(), std::move(self));
    }
    boost::system::error_code result = {};

   private:
    template <class Self>
    void done(Self& self, boost::system::error_code error, std::size_t bytes) {
      if (stream.look(buffers, bytes)) return hold(self);
      self.complete(error, bytes);
    }

    /// Until the socket is closed.
    template <class Self>
    void hold(Self& self) {
      step = Step::held;
      stream.socket_.async_wait(boost::asio::socket_base::wait_error, std::move(self));
    }

    /// The first buffer that has room; an empty one if none has.
    static boost::asio::mutable_buffer first_of(const Buffers& buffers) {
      for (auto at = boost::asio::buffer_sequence_begin(buffers); at != boost::asio::buffer_sequence_end(buffers); ++at)
        if (boost::asio::mutable_buffer(*at).size() > 0) return *at;
      return {};
    }
  };

  struct Write {
    OutboxStream& stream;
    std::string bytes;
    std::size_t size = bytes.size();
    enum class Step { send, wait, done } step = Step::send;

    template <class Self>
    void operator()(Self& self, boost::system::error_code error = {}) {
      namespace asio = boost::asio;
      if (step == Step::send) {
        const auto sent = stream.outbox_->send_control(std::move(bytes));
        step = sent == http::Sent::waits ? Step::wait : Step::done;
        closed = sent == http::Sent::closed;
        // Posted, so that it never runs before the initiating function has returned.
        if (step == Step::done) {
          asio::post(stream.get_executor(), std::move(self));
          return;
        }
      } else if (step == Step::wait && !error) {
        const auto flushed = stream.outbox_->flush();
        closed = flushed == Outbox::Flushed::closed;
        if (flushed != Outbox::Flushed::some) step = Step::done;
      }
      if (step == Step::wait && !error) {
        stream.socket_.async_wait(asio::socket_base::wait_write, std::move(self));
        return;
      }
      if (closed && !error) error = asio::error::operation_aborted;
      self.complete(error, error ? 0 : size);
    }
    bool closed = false;
  };

  /// `count`: bytes that were read into the buffers. Whether they must not be passed on.
  template <class Buffers>
  bool look(const Buffers& buffers, std::size_t count) {
    for (auto at = boost::asio::buffer_sequence_begin(buffers); count > 0; ++at) {
      const boost::asio::mutable_buffer piece(*at);
      const auto size = std::min(count, piece.size());
      if (const auto fault = guard_.look({static_cast<const char*>(piece.data()), size})) {
        is_over_ = true;
        on_fault_(*fault);
        if (fault->code != FrameGuard::policy_violation) return true;
      }
      count -= size;
    }
    return false;
  }

  boost::asio::ip::tcp::socket socket_;
  std::shared_ptr<TlsSession> tls_;
  std::shared_ptr<Outbox> outbox_;
  FrameGuard guard_;
  std::function<void(const FrameGuard::Fault&)> on_fault_;
  bool is_over_ = false;
};

/// Called by Beast at a timeout.
inline void beast_close_socket(OutboxStream& stream) { stream.close(); }

/// Called by Beast at the end of a closing handshake: all bytes have been sent by then, see async_write_some.
template <class Handler>
void async_teardown(boost::beast::role_type role, OutboxStream& stream, Handler&& handler) {
  stream.finish();
  boost::beast::websocket::async_teardown(role, stream.socket(), std::forward<Handler>(handler));
}

}  // namespace semblante::net
