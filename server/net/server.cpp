#include "server/net/server.h"

#include <csignal>
#include <exception>
#include <thread>
#include <vector>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/asio/write.hpp>

#include "server/http/problem.h"
#include "server/log/guard.h"
#include "server/log/log.h"
#include "server/net/error_value.h"
#include "server/net/http_session.h"
#include "server/net/state.h"

namespace semblante::net {

namespace asio = boost::asio;
using asio::ip::tcp;

struct Server::State : SharedState {
  State(ServerConfig c, http::Application& a) : SharedState(std::move(c), a), acceptor(io), signals(io), grace(io) {}
  tcp::acceptor acceptor;
  asio::signal_set signals;
  asio::steady_timer grace;
  std::function<void()> on_stopping;
};

namespace {

/// Answers a connection over the limit with 503 and closes it.
asio::awaitable<void> turn_away(tcp::socket socket) {
  const auto body = std::get<std::string>(http::to_response(http::make_problem("overloaded", "try again later")).body);
  const std::string text =
      "HTTP/1.1 503 Service Unavailable\r\nContent-Type: application/problem+json\r\nRetry-After: 1\r\nConnection: "
      "close\r\nContent-Length: " +
      std::to_string(body.size()) + "\r\n\r\n" + body;
  boost::system::error_code ignored;
  co_await asio::async_write(socket, asio::buffer(text), error_into(ignored));
}

/// For co_spawn: an exception that ends a coroutine ends only its connection.
void log_fault(const std::exception_ptr& fault) {
  if (!fault) return;
  log::guarded("a connection ended by a fault", [&] { std::rethrow_exception(fault); });
}

/// Accepts and starts one connection. False when that failed.
asio::awaitable<bool> accept_one(tcp::acceptor& acceptor, const std::shared_ptr<SharedState>& state) {
  boost::system::error_code error;
  auto socket = co_await acceptor.async_accept(asio::make_strand(state->io), error_into(error));
  if (error) {
    if (!state->stopping && error != asio::error::operation_aborted) log::warning("cannot accept: " + error.message());
    co_return false;
  }
  const auto executor = socket.get_executor();
  if (state->connections_open >= state->config.limits.max_connections) {
    ++state->connections_total;
    ++state->connections_refused;
    asio::co_spawn(executor, turn_away(std::move(socket)), log_fault);
    co_return true;
  }
  asio::co_spawn(executor, serve_connection(std::move(socket), state, ConnectionCount(state)), log_fault);
  co_return true;
}

asio::awaitable<void> accept_connections(tcp::acceptor& acceptor, std::shared_ptr<SharedState> state) {
  while (!state->stopping) {
    bool accepted = false;
    try {
      accepted = co_await accept_one(acceptor, state);
    } catch (...) {
      log::caught("cannot accept");  // most likely out of memory
    }
    if (accepted) continue;
    if (!acceptor.is_open()) co_return;
    // Most likely out of descriptors: waits until some are closed instead of spinning.
    asio::steady_timer pause(co_await asio::this_coro::executor, std::chrono::milliseconds(100));
    boost::system::error_code ignored;
    co_await pause.async_wait(error_into(ignored));
  }
}

}  // namespace

Server::Server(ServerConfig config, http::Application& application)
    : state_(std::make_shared<State>(std::move(config), application)) {}

Server::~Server() {
  state_->workers.stop();
  state_->workers.join();
}

Result<std::uint16_t> Server::listen() {
  const auto& config = state_->config;
  const auto place = config.address + ":" + std::to_string(config.port);
  boost::system::error_code error;
  const auto address = asio::ip::make_address(config.address, error);
  if (error) return Error{ErrorCode::invalid_argument, "--address", config.address + " is not an IP address"};
  const tcp::endpoint endpoint(address, config.port);
  auto& acceptor = state_->acceptor;
  acceptor.open(endpoint.protocol(), error);
  if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
  if (!error) acceptor.bind(endpoint, error);
  if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (error == asio::error::address_in_use)
    return Error{ErrorCode::io, "--port", place + " is in use by another program; choose another --port (0 takes any)"};
  if (error) return Error{ErrorCode::io, "--port", "cannot listen on " + place + ": " + error.message()};
  return acceptor.local_endpoint().port();
}

void Server::stop_on_signals() {
  state_->signals.add(SIGINT);
  state_->signals.add(SIGTERM);
  state_->signals.async_wait([this](const boost::system::error_code& error, int) {
    if (!error) stop();
  });
}

void Server::stop() {
  asio::post(state_->io, [state = state_] {
    if (state->stopping.exchange(true)) return;
    boost::system::error_code ignored;
    state->acceptor.close(ignored);
    state->signals.cancel(ignored);
    if (state->on_stopping) log::guarded("stopping", state->on_stopping);
    // Pending answers get the grace period, idle connections are closed. Polled in short steps, so that an idle server
    // stops immediately.
    struct Step {
      static void take(const std::shared_ptr<State>& state, std::chrono::steady_clock::time_point end) {
        if (state->busy == 0 || std::chrono::steady_clock::now() >= end) {
          state->io.stop();
          return;
        }
        state->grace.expires_after(std::chrono::milliseconds(20));
        state->grace.async_wait([state, end](const boost::system::error_code&) { take(state, end); });
      }
    };
    Step::take(state, std::chrono::steady_clock::now() + state->config.limits.shutdown_grace);
  });
}

void Server::run(const std::function<void()>& on_stopping) {
  state_->on_stopping = on_stopping;
  asio::co_spawn(state_->io, accept_connections(state_->acceptor, state_), log_fault);
  std::vector<std::thread> threads;
  for (unsigned i = 1; i < state_->config.io_threads; ++i)
    threads.emplace_back([this] { run_guarded(state_->io, "I/O thread"); });
  run_guarded(state_->io, "I/O thread");
  for (auto& thread : threads) thread.join();
  state_->workers.join();
}

ServerCounts Server::counts() const {
  return {state_->connections_open, state_->connections_total, state_->connections_refused, state_->requests_total,
          state_->websockets_open};
}

}  // namespace semblante::net
