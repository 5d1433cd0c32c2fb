#include "server/net/websocket_session.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>
#include <boost/beast/websocket/stream.hpp>

#include "server/http/request_id.h"
#include "server/log/guard.h"
#include "server/net/outbox.h"
#include "server/net/outbox_stream.h"

namespace semblante::net {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = boost::beast::websocket;

namespace {

using boost::system::error_code;

/// Deadline of closing: for the last write and the client's own close frame.
constexpr std::chrono::seconds closing_time{5};
/// The same for a client that floods: its close frame is not read.
constexpr std::chrono::seconds flood_closing_time{1};
/// A small send buffer: bytes that wait in the kernel are stale for a face and cost memory for each slow client. The
/// kernel doubles the value for its own bookkeeping.
constexpr int send_buffer_bytes = 16 * 1024;
/// Maximum length of a close frame's reason (RFC 6455 section 5.5); Beast throws on more.
constexpr std::size_t longest_reason = 123;
/// Size of the first piece of a message: most messages of clients (hello, ping) fit into it. An idle connection keeps
/// no larger buffer.
constexpr std::size_t first_piece_bytes = 128;
constexpr std::size_t largest_piece_bytes = std::size_t{64} * 1024;

/// One WebSocket. Owned by its pending operations; guarded by the strand of its socket.
class WebSocketConnection : public OutboxOwner, public std::enable_shared_from_this<WebSocketConnection> {
 public:
  static void start(asio::ip::tcp::socket socket, std::shared_ptr<TlsSession> tls, std::string_view key,
                    std::string_view request_id, std::shared_ptr<http::WebSocketPeer> peer,
                    std::shared_ptr<SharedState> state, ConnectionCount count) {
    auto& live = state->live;
    const auto self = std::make_shared<WebSocketConnection>(std::move(peer), std::move(state), std::move(count));
    const auto protocol = socket.local_endpoint().protocol();
    asio::ip::tcp::socket moved(asio::make_strand(live), protocol, socket.release());
    const auto executor = moved.get_executor();
    asio::post(executor,
               [self, moved = std::move(moved), tls = std::move(tls), key = std::string(key),
                id = std::string(request_id)]() mutable { self->accept(std::move(moved), std::move(tls), key, id); });
  }

  WebSocketConnection(std::shared_ptr<http::WebSocketPeer> peer, std::shared_ptr<SharedState> state,
                      ConnectionCount count)
      : state_(std::move(state)), peer_(std::move(peer)), count_(std::move(count)) {
    ++state_->busy;
  }
  ~WebSocketConnection() override {
    leave();
    if (outbox_) outbox_->detach();  // after a fault the socket is closed now
  }
  WebSocketConnection(const WebSocketConnection&) = delete;
  WebSocketConnection& operator=(const WebSocketConnection&) = delete;

  // ---- any thread
  void on_blocked() override {
    asio::post(executor_, [self = shared_from_this()] { self->wait_writable(); });
  }
  void on_close(const http::CloseReason& reason) override {
    asio::post(executor_, [self = shared_from_this(), reason] { self->close(reason); });
  }

  /// A client may keep its socket open long after the closing handshake: neither its stream nor a shutdown waits for
  /// that.
  void on_over() override { leave(); }

 private:
  using Stream = websocket::stream<OutboxStream, false>;

  /// The upgrade request for Beast: already checked, so the client's other fields are not needed.
  static beast::http::request<beast::http::empty_body> upgrade_with(std::string_view key) {
    using Field = beast::http::field;
    beast::http::request<beast::http::empty_body> request(beast::http::verb::get, "/", 11);
    request.set(Field::host, "localhost");
    request.set(Field::connection, "upgrade");
    request.set(Field::upgrade, "websocket");
    request.set(Field::sec_websocket_version, "13");
    request.set(Field::sec_websocket_key, std::string(key));
    return request;
  }

  void accept(asio::ip::tcp::socket socket, std::shared_ptr<TlsSession> tls, std::string_view key,
              std::string_view request_id) {
    error_code ignored;
    socket.set_option(asio::socket_base::send_buffer_size(send_buffer_bytes), ignored);
    executor_ = socket.get_executor();
    outbox_ = std::make_shared<Outbox>(socket.native_handle(), peer_->outbox_limits(), weak_from_this(), tls);
    // Posted: Beast is reading.
    ws_.emplace(std::move(socket), std::move(tls), outbox_, FrameGuard(state_->config.limits),
                [this](const FrameGuard::Fault& fault) {
                  asio::post(executor_, [self = shared_from_this(), fault] {
                    self->close({fault.code, std::string(fault.words)}, flood_closing_time);
                  });
                });
    websocket::stream_base::timeout clocks{};
    clocks.handshake_timeout = state_->config.limits.header_timeout;
    clocks.idle_timeout = state_->config.limits.idle_timeout;
    clocks.keep_alive_pings = true;
    ws_->set_option(clocks);
    ws_->read_message_max(peer_->max_message_bytes());
    ws_->set_option(websocket::stream_base::decorator(
        [name = std::string(peer_->subprotocol()), id = std::string(request_id)](websocket::response_type& response) {
          response.set(std::string(http::request_id_header), id);
          response.set(beast::http::field::server, "semblante");  // otherwise the library's name and version
          if (!name.empty()) response.set(beast::http::field::sec_websocket_protocol, name);
        }));
    auto request = std::make_unique<beast::http::request<beast::http::empty_body>>(upgrade_with(key));
    const auto& head = *request;
    ws_->async_accept(
        head, [self = shared_from_this(), request = std::move(request)](error_code error) { self->accepted(error); });
  }

  void accepted(error_code error) {
    if (error) return end();
    ++state_->websockets_open;
    open_ = true;
    if (!told([this] { peer_->attach(outbox_); })) return end();
    read();
  }

  void read() {
    const std::size_t piece = std::clamp(read_, first_piece_bytes, largest_piece_bytes);
    message_.resize(read_ + piece);
    ws_->async_read_some(
        asio::buffer(message_.data() + read_, piece),
        [self = shared_from_this()](error_code error, std::size_t count) { self->have_read(error, count); });
  }

  void have_read(error_code error, std::size_t count) {
    if (error) return end();
    read_ += count;
    if (ws_->is_message_done()) {
      if (!receive()) return end();
      read_ = 0;
      if (message_.size() > first_piece_bytes) message_ = std::string();
    }
    read();
  }

  /// False when the peer is gone, or threw: an internal error ends only its own connection.
  template <class Tell>
  bool told(Tell tell) {
    return peer_ && log::guarded("a WebSocket", tell);
  }

  bool receive() {
    return told([this] { peer_->receive({message_.data(), read_}, ws_->got_binary()); });
  }

  void wait_writable() {
    if (ended_) return;
    ws_->next_layer().socket().async_wait(asio::socket_base::wait_write, [self = shared_from_this()](error_code error) {
      if (!error) self->flush();
    });
  }

  void flush() {
    if (ended_) return;
    const auto flushed = outbox_->flush();
    if (flushed == Outbox::Flushed::some) return wait_writable();
    if (flushed == Outbox::Flushed::all && open_ && !told([this] { peer_->writable(); })) end();
  }

  void close(const http::CloseReason& reason, std::chrono::seconds time = closing_time) {
    if (ended_ || deadline_) return;
    // A client that reads nothing does not get the close frame: its socket is closed at the deadline.
    deadline_.emplace(executor_, time);
    deadline_->async_wait([weak = weak_from_this()](error_code error) {
      const auto self = weak.lock();
      if (!error && self && !self->ended_) self->ws_->next_layer().close();
    });
    const std::string_view text = std::string_view(reason.text).substr(0, longest_reason);
    websocket::close_reason words(beast::string_view(text.data(), text.size()));
    words.code = reason.code;
    ws_->async_close(words, [self = shared_from_this()](error_code) {});
  }

  /// The read operation is always pending until the end, so only its completion ends the connection.
  void end() {
    if (ended_) return;
    ended_ = true;
    ws_->next_layer().close();
    if (deadline_) deadline_->cancel();
    leave();
  }

  void leave() {
    if (!peer_) return;
    told([this] { peer_->disconnected(); });  // also called by the destructor
    peer_ = nullptr;
    if (open_) --state_->websockets_open;
    open_ = false;
    --state_->busy;
  }

  const std::shared_ptr<SharedState> state_;
  std::shared_ptr<http::WebSocketPeer> peer_;
  const ConnectionCount count_;
  asio::any_io_executor executor_;
  std::shared_ptr<Outbox> outbox_;
  std::optional<Stream> ws_;
  std::optional<asio::steady_timer> deadline_;
  std::string message_;   ///< the part received so far
  std::size_t read_ = 0;  ///< bytes of it
  bool open_ = false;     ///< the handshake is complete
  bool ended_ = false;
};

}  // namespace

void serve_websocket(asio::ip::tcp::socket socket, std::shared_ptr<TlsSession> tls, std::string_view key,
                     std::string_view request_id, std::shared_ptr<http::WebSocketPeer> peer,
                     std::shared_ptr<SharedState> state, ConnectionCount connection) {
  WebSocketConnection::start(std::move(socket), std::move(tls), key, request_id, std::move(peer), std::move(state),
                             std::move(connection));
}

}  // namespace semblante::net
