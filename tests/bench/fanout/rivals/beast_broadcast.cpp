// Broadcast as it is usually written with Beast: a strand and a queue of shared messages for each session, one
// async_write at a time.
//   bench_fanout_beast MESSAGES_PER_SECOND BYTES

#include <chrono>
#include <deque>
#include <memory>
#include <string>
#include <unordered_set>

#include <boost/asio/bind_executor.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>
#include <boost/beast/core/bind_handler.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/websocket/stream.hpp>

#include "tests/bench/fanout/rivals/rival.h"

namespace semblante::bench::rivals {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = boost::beast::websocket;
using tcp = asio::ip::tcp;
using Shared = std::shared_ptr<const std::string>;

class Session;
using Sessions = std::unordered_set<Session*>;

class Session : public std::enable_shared_from_this<Session> {
 public:
  Session(tcp::socket socket, Sessions& sessions) : ws_(std::move(socket)), sessions_(sessions) {}
  ~Session() { sessions_.erase(this); }

  void start() {
    ws_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    ws_.binary(true);
    ws_.async_accept(beast::bind_front_handler(&Session::accepted, shared_from_this()));
  }

  void send(const Shared& message) {
    asio::post(ws_.get_executor(), beast::bind_front_handler(&Session::queue, shared_from_this(), message));
  }

 private:
  void accepted(beast::error_code error) {
    if (error) return;
    sessions_.insert(this);
    read();
  }
  void read() { ws_.async_read(buffer_, beast::bind_front_handler(&Session::have_read, shared_from_this())); }
  void have_read(beast::error_code error, std::size_t) {
    if (error) return;
    buffer_.consume(buffer_.size());
    read();
  }
  void queue(const Shared& message) {
    queue_.push_back(message);
    if (queue_.size() == 1) write();
  }
  void write() {
    ws_.async_write(asio::buffer(*queue_.front()),
                    beast::bind_front_handler(&Session::have_written, shared_from_this()));
  }
  void have_written(beast::error_code error, std::size_t) {
    if (error) return;
    queue_.pop_front();
    if (!queue_.empty()) write();
  }

  websocket::stream<beast::tcp_stream> ws_;
  Sessions& sessions_;
  beast::flat_buffer buffer_;
  std::deque<Shared> queue_;
};

class Broadcast {
 public:
  explicit Broadcast(const Arguments& arguments)
      : arguments_(arguments), io_(1), acceptor_(io_, tcp::endpoint(asio::ip::address_v4::loopback(), 0)), timer_(io_) {
    acceptor_.listen(4096);
  }

  void run() {
    announce(acceptor_.local_endpoint().port());
    due_ = std::chrono::steady_clock::now();
    accept();
    wait();
    io_.run();
  }

 private:
  void accept() {
    acceptor_.async_accept(asio::make_strand(io_), [this](beast::error_code error, tcp::socket socket) {
      if (!error) {
        socket.set_option(tcp::no_delay(true), error);
        std::make_shared<Session>(std::move(socket), sessions_)->start();
      }
      accept();
    });
  }
  void wait() {
    due_ += std::chrono::duration_cast<std::chrono::nanoseconds>(
        std::chrono::duration<double>(1.0 / arguments_.messages_per_second));
    timer_.expires_at(due_);
    timer_.async_wait([this](beast::error_code) {
      const auto message = std::make_shared<const std::string>(next_payload(arguments_, ++sequence_));
      for (Session* session : sessions_) session->send(message);
      wait();
    });
  }

  const Arguments arguments_;
  asio::io_context io_;
  tcp::acceptor acceptor_;
  asio::steady_timer timer_;
  std::chrono::steady_clock::time_point due_;
  Sessions sessions_;
  std::uint64_t sequence_ = 0;
};

}  // namespace
}  // namespace semblante::bench::rivals

int main(int count, char** words) {
  using namespace semblante::bench::rivals;
  Broadcast(arguments_of(count, words)).run();
}
