#include "server/net/server.h"

#include <algorithm>
#include <csignal>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <unistd.h>
#include <vector>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/dispatch.hpp>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/asio/write.hpp>

#include "server/http/problem.h"
#include "server/http/request_id.h"
#include "server/log/guard.h"
#include "server/log/log.h"
#include "server/log/thread_rank.h"
#include "server/net/error_value.h"
#include "server/net/handshake.h"
#include "server/net/http_session.h"
#include "server/net/log_fault.h"
#include "server/net/state.h"

namespace semblante::net {

namespace asio = boost::asio;
using asio::ip::tcp;

/// A socket that listens.
struct Door {
  tcp::acceptor acceptor;
  bool tls = false;
};

struct Server::State : SharedState {
  State(ServerConfig c, http::Application& a) : SharedState(std::move(c), a), signals(io), hangup(io), drain_step(io) {}
  std::deque<Door> doors;
  mutable std::mutex tls_mutex;
  std::shared_ptr<const TlsContext> tls;  ///< guarded by tls_mutex
  asio::signal_set signals, hangup;
  asio::steady_timer drain_step;
  std::function<void()> on_stopping;
};

namespace {

/// Answers a connection over the limit with 503 and closes it. One that would begin with TLS is only closed: a
/// handshake costs more than the answer.
asio::awaitable<void> turn_away(tcp::socket socket) {
  auto refusal = http::to_response(http::make_problem("overloaded", "try again later"));
  const auto id = http::new_request_id();
  http::add_request_id(refusal, id);
  const auto& body = std::get<std::string>(refusal.body);
  const std::string text =
      "HTTP/1.1 503 Service Unavailable\r\nContent-Type: application/problem+json\r\nRetry-After: 1\r\nConnection: "
      "close\r\n" +
      std::string(http::request_id_header) + ": " + id + "\r\nContent-Length: " + std::to_string(body.size()) +
      "\r\n\r\n" + body;
  boost::system::error_code ignored;
  co_await asio::async_write(socket, asio::buffer(text), error_into(ignored));
}

/// The address whose connections are counted; nullopt for this machine and for proxies.
template <class Socket>
std::optional<http::AddressBytes> counted_address(const Socket& socket, const ServerConfig& config) {
  boost::system::error_code error;
  const auto end = socket.remote_endpoint(error);
  if (error) return std::nullopt;
  const auto address = http::parse_address(end.address().to_string());
  const auto is_proxy = [&](const auto& range) { return range.contains(*address); };
  if (!address || http::is_loopback(*address) || std::any_of(config.proxies.begin(), config.proxies.end(), is_proxy))
    return std::nullopt;
  return http::client_network(*address);
}

/// Accepts and starts one connection, on the context of its listener. False when that failed. `context` returns the TLS
/// context of now, or null.
template <class Context>
asio::awaitable<bool> accept_one(tcp::acceptor& acceptor, const Context& context,
                                 const std::shared_ptr<SharedState>& state) {
  boost::system::error_code error;
  auto socket =
      co_await acceptor.async_accept(asio::make_strand(co_await asio::this_coro::executor), error_into(error));
  if (error) {
    if (!state->stopping && error != asio::error::operation_aborted) log::warning("cannot accept: " + error.message());
    co_return false;
  }
  const auto& limits = state->config.limits;
  const auto executor = socket.get_executor();
  const auto address = counted_address(socket, state->config);
  auto tls = context();
  const bool has_room = state->connections_open < limits.max_connections &&
                        (!address || state->addresses.of(*address) < limits.max_connections_per_address) &&
                        (!address || !tls || state->handshakes.of(*address) < limits.max_handshakes_per_address);
  if (!has_room) {
    ++state->connections_total;
    ++state->connections_refused;
    if (!tls) asio::co_spawn(executor, turn_away(std::move(socket)), log_fault);
    co_return true;
  }
  ConnectionCount count(state, address, tls != nullptr);
  if (tls)
    asio::co_spawn(executor, shake_hands(std::move(socket), std::move(tls), state, std::move(count)), log_fault);
  else
    asio::co_spawn(executor, serve_connection(std::move(socket), nullptr, state, std::move(count)), log_fault);
  co_return true;
}

template <class Context>
asio::awaitable<void> accept_connections(tcp::acceptor& acceptor, Context context, std::shared_ptr<SharedState> state) {
  while (!state->stopping) {
    bool accepted = false;
    try {
      accepted = co_await accept_one(acceptor, context, state);
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

/// Not the default effect of the signal, which the first process of a container does not have.
extern "C" void end_at_once(int signal) {
  constexpr int ended_by_signal = 128;  // the convention of shells: 128 and the number of the signal
  ::_exit(ended_by_signal + signal);
}

/// Ends the I/O loop when no answer and no WebSocket is pending, or at `end`; idle connections are closed then. Polled
/// in short steps, so that an idle server stops soon. `quiet`: steps in a row without anything pending; more than one,
/// because a request may be on its way through the kernel.
template <class State>
void drain(const std::shared_ptr<State>& state, std::chrono::steady_clock::time_point end, int quiet) {
  constexpr int enough = 3;
  constexpr std::chrono::milliseconds step{20};
  quiet = state->busy == 0 ? quiet + 1 : 0;
  if (quiet >= enough || std::chrono::steady_clock::now() >= end) {
    for (auto* context : {&state->front, &state->io, &state->live}) context->stop();
    return;
  }
  state->drain_step.expires_after(step);
  state->drain_step.async_wait([state, end, quiet](const boost::system::error_code&) { drain(state, end, quiet); });
}

}  // namespace

Server::Server(ServerConfig config, http::Application& application)
    : state_(std::make_shared<State>(std::move(config), application)) {}

Server::~Server() {
  state_->workers.stop();
  state_->workers.join();
  // Connections that a stop has cut off, and what was posted after the contexts had stopped.
  state_->live.drop_pending();
  state_->io.drop_pending();
  state_->front.drop_pending();
}

Result<std::vector<std::uint16_t>> Server::listen() {
  std::vector<std::uint16_t> ports;
  for (const auto& listener : state_->config.listeners) {
    boost::system::error_code error;
    const auto address = asio::ip::make_address(listener.address, error);
    if (error) return Error{ErrorCode::invalid_argument, "--listen", listener.address + " is not an IP address"};
    const bool six = address.is_v6();
    const auto place = (six ? "[" + listener.address + "]" : listener.address) + ":" + std::to_string(listener.port);
    const tcp::endpoint endpoint(address, listener.port);
    auto& acceptor =
        state_->doors.emplace_back(Door{tcp::acceptor(listener.tls ? state_->front : state_->io), listener.tls})
            .acceptor;
    acceptor.open(endpoint.protocol(), error);
    if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
    if (!error) acceptor.bind(endpoint, error);
    if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (error == asio::error::address_in_use)
      return Error{ErrorCode::io, "--listen",
                   place + " is in use by another program; choose another port (0 takes any)"};
    if (error == asio::error::access_denied)
      return Error{ErrorCode::io, "--listen",
                   place +
                       ": ports below 1024 need the capability CAP_NET_BIND_SERVICE; give it (systemd: "
                       "AmbientCapabilities) or choose a port above 1023"};
    if (error) return Error{ErrorCode::io, "--listen", "cannot listen on " + place + ": " + error.message()};
    ports.push_back(acceptor.local_endpoint().port());
  }
  return ports;
}

void Server::set_tls(std::shared_ptr<const TlsContext> context) {
  const std::lock_guard lock(state_->tls_mutex);
  state_->tls = std::move(context);
}

void Server::stop_on_signals(bool at_hangup) {
  state_->signals.add(SIGINT);
  state_->signals.add(SIGTERM);
  struct sigaction hangup {};
  ::sigaction(SIGHUP, nullptr, &hangup);
  if (at_hangup && hangup.sa_handler != SIG_IGN) state_->signals.add(SIGHUP);
  state_->signals.async_wait([this](const boost::system::error_code& error, int) {
    if (error) return;
    boost::system::error_code ignored;
    state_->signals.clear(ignored);
    for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, end_at_once);
    std::signal(SIGHUP, SIG_IGN);  // the terminal's shell may send another
    stop();
  });
}

void Server::reload_on_signal(const std::function<void()>& reload) {
  state_->hangup.add(SIGHUP);
  struct Step {
    static void wait(const std::shared_ptr<State>& state, const std::function<void()>& reload) {
      state->hangup.async_wait([state, reload](const boost::system::error_code& error, int) {
        if (error) return;
        asio::post(state->workers.executor(), [reload] { log::guarded("reloading", reload); });
        wait(state, reload);
      });
    }
  };
  Step::wait(state_, reload);
}

void Server::stop() {
  asio::post(state_->io, [state = state_] {
    if (state->stopping.exchange(true)) return;
    boost::system::error_code ignored;
    for (auto& door : state->doors)
      asio::dispatch(door.acceptor.get_executor(), [state, &door] {
        boost::system::error_code already;
        door.acceptor.close(already);
      });
    state->signals.cancel(ignored);
    state->hangup.cancel(ignored);
    if (state->on_stopping) log::guarded("stopping", state->on_stopping);
    drain(state, std::chrono::steady_clock::now() + state->config.limits.drain_time, 0);
  });
}

void Server::run(const std::function<void()>& on_stopping) {
  state_->on_stopping = on_stopping;
  for (auto& door : state_->doors) {
    const auto context = [state = state_.get(), tls = door.tls]() -> std::shared_ptr<const TlsContext> {
      if (!tls) return nullptr;
      const std::lock_guard lock(state->tls_mutex);
      return state->tls;
    };
    asio::co_spawn(door.acceptor.get_executor(), accept_connections(door.acceptor, context, state_), log_fault);
  }
  // Threads of their own also for the first: ranks are only lowered, and the caller keeps its own.
  const auto live_work = asio::make_work_guard(state_->live), front_work = asio::make_work_guard(state_->front);
  std::vector<std::thread> threads;
  const auto serve = [&threads](asio::io_context& io, log::ThreadRank rank, std::string_view who) {
    threads.emplace_back([&io, rank, who] {
      log::set_thread_rank(rank);
      run_guarded(io, who);
    });
  };
  const auto join = [&threads] {
    for (auto& thread : threads) thread.join();
  };
  try {
    serve(state_->front, log::ThreadRank::handshakes, "thread of handshakes");
    for (unsigned i = 0; i < state_->config.io_threads; ++i) {
      serve(state_->live, log::ThreadRank::live, "thread of WebSockets");
      serve(state_->io, log::ThreadRank::requests, "thread of requests");
    }
  } catch (...) {  // the system gives no more threads
    for (auto* io : {&state_->front, &state_->live, &state_->io}) io->stop();
    join();
    throw;
  }
  join();
  state_->workers.join();
}

ServerCounts Server::counts() const {
  return {state_->connections_open, state_->connections_total, state_->connections_refused, state_->requests_total,
          state_->websockets_open};
}

}  // namespace semblante::net
