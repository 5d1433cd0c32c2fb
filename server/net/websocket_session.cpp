#include "server/net/websocket_session.h"

#include <utility>

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket/stream.hpp>

#include "server/log/log.h"
#include "server/net/waker.h"

namespace semblante::net {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = boost::beast::websocket;

namespace {

constexpr auto use_tuple = asio::as_tuple(asio::use_awaitable);
/// After we decided to close: for the last write and the client's own close frame.
constexpr std::chrono::seconds closing_time{5};
/// A short send queue: what waits in the kernel is stale for a face, and costs memory for each slow client.
constexpr int send_buffer_bytes = 64 * 1024;

/// Shared by the reading and the writing coroutine, both on the strand of the socket.
struct Connection {
  Connection(beast::tcp_stream stream, std::shared_ptr<http::WebSocketPeer> p)
      : ws(std::move(stream)),
        peer(std::move(p)),
        waker(std::make_shared<Waker>(ws.get_executor())),
        deadline(ws.get_executor()) {}

  websocket::stream<beast::tcp_stream> ws;
  std::shared_ptr<http::WebSocketPeer> peer;
  std::shared_ptr<Waker> waker;
  asio::steady_timer deadline;
  bool closing = false;
};

/// A client that reads nothing cannot be told to go: its socket is closed when the time is over.
void close_by_deadline(const std::shared_ptr<Connection>& connection) {
  if (connection->closing || !connection->peer->finished()) return;
  connection->closing = true;
  connection->deadline.expires_after(closing_time);
  connection->deadline.async_wait([connection](const boost::system::error_code& error) {
    if (!error) beast::get_lowest_layer(connection->ws).close();
  });
}

asio::awaitable<void> write_messages(std::shared_ptr<Connection> connection) {
  auto& [ws, peer, waker, deadline, closing] = *connection;
  while (true) {
    if (const auto item = peer->take()) {
      ws.binary(item->binary);
      const auto [error, count] = co_await ws.async_write(asio::buffer(*item->bytes), use_tuple);
      if (error) co_return;
    } else if (peer->finished()) {
      const auto reason = peer->close_reason();
      websocket::close_reason close(reason.text);
      close.code = reason.code;
      co_await ws.async_close(close, use_tuple);
      co_return;
    } else {
      co_await waker->wait(std::chrono::hours(1));
      if (!ws.is_open()) co_return;
    }
  }
}

asio::awaitable<void> read_messages(std::shared_ptr<Connection> connection) {
  beast::flat_buffer buffer;
  while (true) {
    const auto [error, count] = co_await connection->ws.async_read(buffer, use_tuple);
    if (error) co_return;
    const auto data = buffer.cdata();
    connection->peer->receive({static_cast<const char*>(data.data()), data.size()}, connection->ws.got_binary());
    buffer.consume(buffer.size());
  }
}

}  // namespace

asio::awaitable<void> serve_websocket(beast::tcp_stream stream, beast::http::request<beast::http::empty_body> upgrade,
                                      std::shared_ptr<http::WebSocketPeer> peer, std::shared_ptr<SharedState> state) {
  stream.expires_never();  // the WebSocket stream has its own clocks
  boost::system::error_code ignored;
  stream.socket().set_option(asio::socket_base::send_buffer_size(send_buffer_bytes), ignored);
  const auto connection = std::make_shared<Connection>(std::move(stream), std::move(peer));
  auto& ws = connection->ws;
  websocket::stream_base::timeout clocks{};
  clocks.handshake_timeout = state->config.limits.header_timeout;
  clocks.idle_timeout = state->config.limits.idle_timeout;
  clocks.keep_alive_pings = true;
  ws.set_option(clocks);
  ws.read_message_max(connection->peer->max_message_bytes());
  ws.set_option(websocket::stream_base::decorator([&](websocket::response_type& response) {
    const auto name = connection->peer->subprotocol();
    if (!name.empty())
      response.set(beast::http::field::sec_websocket_protocol, boost::core::string_view(name.data(), name.size()));
  }));
  const auto [error] = co_await ws.async_accept(upgrade, use_tuple);
  if (error) {
    connection->peer->disconnected();
    co_return;
  }
  ++state->websockets_open;
  connection->waker->set_on_wake([connection] { close_by_deadline(connection); });
  connection->peer->attach(connection->waker->function());
  asio::co_spawn(ws.get_executor(), write_messages(connection), asio::detached);
  co_await read_messages(connection);

  connection->peer->attach({});
  connection->peer->disconnected();
  connection->waker->set_on_wake({});
  connection->waker->function()();  // the writer looks up and sees the closed socket
  connection->deadline.cancel();
  --state->websockets_open;
}

}  // namespace semblante::net
