// The HTTP session of the server, and the WebSocket it may become, fed with the input over a local socket. Nothing
// stands around the I/O loop here: an exception ends the program, as does a connection that does not end with its
// client.
//
// The input is the client's bytes, but for what follows 0xFF:
//   0xFF 's'       the bytes so far are sent, and the server runs until it waits for more
//   0xFF 'r' n c   the byte c, 256 * n times (long fields of a short input)
//   0xFF, else     0xFF itself
// An input that begins with 'W' (no method does) has its requests handled on a worker thread; the rest is the client's.

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <unistd.h>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/strand.hpp>
#include <sys/socket.h>

#include "server/http/problem.h"
#include "server/net/http_session.h"
#include "server/net/state.h"

using namespace semblante;
namespace asio = boost::asio;

namespace {

constexpr std::size_t max_body = 64 * 1024;
constexpr std::size_t max_sent = 1024 * 1024;

/// Says back what it is told; throws at "throw", says good-bye at "bye".
class Echo : public http::WebSocketPeer {
 public:
  explicit Echo(int& here) : here_(here) { ++here_; }
  [[nodiscard]] std::string_view subprotocol() const override { return "echo"; }
  [[nodiscard]] std::size_t max_message_bytes() const override { return max_body; }
  [[nodiscard]] http::OutboxLimits outbox_limits() const override { return {}; }
  void attach(std::shared_ptr<http::WebSocketSink> sink) override { sink_ = std::move(sink); }
  void receive(std::string_view bytes, bool binary) override {
    if (bytes.size() > max_body) std::abort();
    if (bytes == "throw") throw std::runtime_error("a fault of ours");
    if (bytes == "bye") return sink_->close({1000, std::string(bytes)}, nullptr);
    sink_->send(http::make_wire(bytes, binary), http::Purpose::answer);
  }
  void writable() override {}
  void disconnected() override { --here_; }

 private:
  int& here_;
  std::shared_ptr<http::WebSocketSink> sink_;
};

struct Application : http::Application {
  std::variant<http::BodyPlan, http::Response> plan(const http::Request& head) override {
    if (head.path == "/missing") return http::to_response(http::make_problem("not-found", "there is nothing"));
    return http::BodyPlan{max_body, head.path == "/file", head.method == "PUT", immediate};
  }
  http::Response handle(http::Request& request) override {
    if (request.body_size > max_body || (!request.body_file && request.body.size() != request.body_size)) std::abort();
    if (request.path == "/throw") throw std::runtime_error("a fault of ours");
    http::Response response;
    response.headers["Content-Type"] = std::string(request.header("Content-Type").value_or("text/plain"));
    response.body = std::to_string(request.body_size);
    return response;
  }
  std::variant<std::shared_ptr<http::WebSocketPeer>, http::Response> open_websocket(const http::Request&) override {
    return std::shared_ptr<http::WebSocketPeer>(std::make_shared<Echo>(peers));
  }
  void decorate(const http::Request&, http::Response&) override {}

  bool immediate = true;
  int peers = 0;
};

/// The client's end of the connection.
class Client {
 public:
  Client(int socket, net::SharedState& state) : socket_(socket), state_(state) {}
  ~Client() { ::close(socket_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  /// Sends all of it, or as much as a server that has closed takes, and lets the server work on it.
  void send(std::string_view bytes) {
    while (!bytes.empty()) {
      const auto count = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
      if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
      if (count < 0 && errno != EAGAIN) return;
      settle();
    }
    settle();
  }
  void finish() { ::shutdown(socket_, SHUT_WR); }
  /// What is ready is done, and what the server says is read.
  void settle() {
    while (poll() > 0) drain();
    drain();
  }
  std::size_t poll() {
    std::size_t done = 0;
    for (auto* io : {&state_.io, &state_.live}) {
      io->restart();
      done += io->poll();
    }
    return done;
  }
  void drain() {
    std::array<char, 16 * 1024> piece;  // NOLINT(cppcoreguidelines-pro-type-member-init): written by recv
    while (true) {
      const auto count = ::recv(socket_, piece.data(), piece.size(), MSG_DONTWAIT);
      if (count <= 0) return;
      if (!begun_ && piece[0] != 'H') std::abort();  // whatever came, the answer is HTTP
      begun_ = true;
    }
  }

 private:
  const int socket_;
  net::SharedState& state_;
  bool begun_ = false;
};

net::ServerConfig config() {
  net::ServerConfig config;
  config.worker_threads = 1;
  config.upload_directory = "/tmp";
  return config;
}

void talk(Client& client, std::string_view input) {
  std::string piece;
  std::size_t sent = 0;
  for (std::size_t i = 0; i < input.size() && sent < max_sent; ++i) {
    const char next = i + 1 < input.size() ? input[i + 1] : '\0';
    if (input[i] != '\xFF') {
      piece += input[i];
    } else if (next == 's') {
      client.send(piece);
      sent += piece.size();
      piece.clear();
      ++i;
    } else if (next == 'r' && i + 3 < input.size() && piece.size() < max_sent) {
      piece.append(std::size_t{256} * static_cast<unsigned char>(input[i + 2]), input[i + 3]);
      i += 3;
    } else {
      piece += input[i];
    }
  }
  client.send(piece);
  client.finish();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Application application;
  static const auto state = std::make_shared<net::SharedState>(config(), application);

  std::string_view input(reinterpret_cast<const char*>(data), size);
  application.immediate = !input.starts_with('W');
  if (!application.immediate) input.remove_prefix(1);

  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) std::abort();
  Client client(ends[0], *state);
  asio::ip::tcp::socket socket(asio::make_strand(state->io));
  socket.assign(asio::ip::tcp::v4(), ends[1]);
  const auto executor = socket.get_executor();
  asio::co_spawn(executor, net::serve_connection(std::move(socket), nullptr, state, net::ConnectionCount(state)),
                 [](const std::exception_ptr& fault) {
                   if (fault) std::rethrow_exception(fault);
                 });
  talk(client, input);
  // The client has said its last: the connection ends by itself, long before any of the server's clocks runs out.
  for (const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(4); state->connections_open > 0;) {
    if (std::chrono::steady_clock::now() > end) std::abort();
    client.settle();
    // What remains are its clocks.
    auto& io = state->websockets_open > 0 ? state->live : state->io;
    io.restart();
    io.run_one_for(std::chrono::milliseconds(1));
    client.drain();
  }
  client.settle();
  if (state->busy != 0 || state->websockets_open != 0 || application.peers != 0) std::abort();
  return 0;
}
