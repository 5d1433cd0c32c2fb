#include "tests/bench/fanout/pressures.h"

#include <algorithm>
#include <cerrno>
#include <poll.h>
#include <sched.h>
#include <thread>
#include <unistd.h>

#include <sys/socket.h>

#include "tests/bench/fanout/websocket_wire.h"

namespace semblante::bench {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds pause{100};

/// What there is; false at the end of the connection.
bool drain(const Socket& socket, std::size_t* bytes = nullptr) {
  char buffer[16 * 1024];
  ssize_t size = 0;
  while ((size = socket.receive(buffer, sizeof buffer)) > 0)
    if (bytes != nullptr) *bytes += static_cast<std::size_t>(size);
  return size < 0 && errno == EAGAIN;
}

void reset_all(std::vector<Socket>& sockets) {
  for (Socket& socket : sockets) socket.reset();
}

/// Half of them read nothing, the others 256 bytes at a time: less than comes, and never so little that they are sent
/// away.
Outcome slow_readers(const Endpoint& endpoint, const std::string& path, Coding coding, std::size_t number,
                     const std::atomic<bool>& enough) {
  const auto come = [&] {
    Socket socket = open_websocket(endpoint, path, subprotocol_of(coding), small_receive_buffer);
    send_all(socket, hello_frame(coding));
    return socket;
  };
  std::vector<Socket> sockets;
  std::size_t again = 0;
  while (sockets.size() < number && !enough) sockets.push_back(come());
  while (!enough) {
    std::this_thread::sleep_for(pause);
    for (std::size_t i = 0; i < sockets.size() && !enough; ++i) {
      pollfd ended{sockets[i].get(), POLLRDHUP, 0};
      char buffer[256];
      const bool gone =
          i % 2 == 0 ? ::poll(&ended, 1, 0) == 1 : sockets[i].receive(buffer, sizeof buffer) <= 0 && errno != EAGAIN;
      if (!gone) continue;
      sockets[i].reset();
      sockets[i] = come();
      ++again;
    }
  }
  reset_all(sockets);
  return {std::to_string(number) + " readers, " + std::to_string(again) + " sent away and come again", {}};
}

/// Heads, bodies and messages that come in pieces: a byte of a head or a message, 128 of a body, which is over the
/// least rate of bodies.
Outcome slow_writers(const Endpoint& endpoint, const std::string& path, Coding coding, std::size_t number,
                     const std::atomic<bool>& enough) {
  struct Writer {
    Socket socket;
    std::string text;
    std::size_t piece = 1, at = 0;
  };
  const auto head = upgrade_request(endpoint.authority(), path, subprotocol_of(coding));
  const auto come = [&](std::size_t kind) {
    Writer writer;
    if (kind == 2) {
      writer.socket = open_websocket(endpoint, path, subprotocol_of(coding));
      send_all(writer.socket, hello_frame(coding));
      writer.text = client_frame(Opcode::binary, std::string(8000, 'x'));
      return writer;
    }
    writer.socket = connect_to(endpoint);
    writer.text = head;
    if (kind == 1) {
      constexpr std::size_t bytes = std::size_t{64} * 1024;
      writer.text = "POST /v1/models HTTP/1.1\r\nHost: " + endpoint.authority() +
                    "\r\nContent-Type: application/octet-stream\r\nContent-Length: " + std::to_string(bytes) +
                    "\r\n\r\n" + std::string(bytes, 'x');
      writer.piece = 128;
    }
    return writer;
  };
  std::vector<Writer> writers;
  std::size_t again = 0;
  while (writers.size() < number && !enough) writers.push_back(come(writers.size() % 3));
  while (!enough) {
    std::this_thread::sleep_for(pause);
    for (std::size_t i = 0; i < writers.size() && !enough; ++i) {
      Writer& writer = writers[i];
      const auto piece = std::string_view(writer.text).substr(writer.at, writer.piece);
      // The last byte is never sent: a complete request is answered and its writer is slow no longer.
      if (writer.at + piece.size() < writer.text.size() && writer.socket.send(piece) > 0) writer.at += piece.size();
      if (drain(writer.socket)) continue;
      writer.socket.reset();
      writer = come(i % 3);
      ++again;
    }
  }
  for (Writer& writer : writers) writer.socket.reset();
  return {std::to_string(number) + " writers, " + std::to_string(again) + " sent away and come again", {}};
}

/// Requests as fast as they are answered: three of four with a hundred fields, the fourth with more bytes than are
/// allowed, which costs it its connection.
Outcome header_flood(const Endpoint& endpoint, std::size_t number, const std::atomic<bool>& enough) {
  const auto request = [&](std::size_t fields) {
    std::string text = "GET /v1/streams HTTP/1.1\r\nHost: " + endpoint.authority() + "\r\n";
    for (std::size_t i = 0; i < fields; ++i)
      text += "X-Field-" + std::to_string(i) + ": " + std::string(100, 'x') + "\r\n";
    return text + "\r\n";
  };
  const std::string allowed = request(100), too_long = request(200);
  std::vector<Socket> sockets;
  std::vector<pollfd> waits;
  std::size_t answers = 0, refused = 0;
  const auto ask = [&](std::size_t i) { sockets[i].send(i % 4 == 3 ? too_long : allowed); };
  // A short phase may end on a busy machine before the first answer, which says nothing about the server.
  const auto deadline = std::chrono::steady_clock::now() + Socket::patience;
  const auto is_over = [&] { return enough && (answers > 0 || std::chrono::steady_clock::now() > deadline); };
  for (std::size_t i = 0; i < number && !is_over(); ++i) {
    sockets.push_back(connect_to(endpoint));
    waits.push_back({sockets.back().get(), POLLIN, 0});
    ask(i);
  }
  while (!is_over()) {
    ::poll(waits.data(), waits.size(), 100);
    for (std::size_t i = 0; i < sockets.size() && !is_over(); ++i) {
      if (waits[i].revents == 0) continue;
      std::size_t bytes = 0;
      if (drain(sockets[i], &bytes)) {
        if (bytes == 0 || i % 4 == 3) continue;
        ++answers;
      } else {
        ++refused;
        sockets[i].reset();
        sockets[i] = connect_to(endpoint);
        waits[i].fd = sockets[i].get();
      }
      ask(i);
    }
  }
  reset_all(sockets);
  Outcome outcome{std::to_string(answers) + " answered, " + std::to_string(refused) + " refused", {}};
  if (answers == 0) outcome.broken.emplace_back("no request with a hundred fields was answered");
  return outcome;
}

/// Every second has got an answer before it waits.
Outcome idle_connections(const Endpoint& endpoint, std::size_t number, const std::atomic<bool>& enough) {
  std::vector<Socket> sockets;
  while (sockets.size() < number && !enough) {
    sockets.push_back(connect_to(endpoint));
    if (sockets.size() % 2 == 0)
      send_all(sockets.back(), "GET /healthz HTTP/1.1\r\nHost: " + endpoint.authority() + "\r\n\r\n");
  }
  while (!enough) std::this_thread::sleep_for(milliseconds(10));
  const auto left = std::count_if(sockets.begin(), sockets.end(), [](const Socket& socket) { return drain(socket); });
  reset_all(sockets);
  return {std::to_string(left) + " of " + std::to_string(number) + " connections wait", {}};
}

/// With TLS, each says its ClientHello, which costs the server a signature, and nothing more; without, half a head.
Outcome half_open(const Endpoint& endpoint, std::size_t number, const std::atomic<bool>& enough) {
  Endpoint plain = endpoint;
  plain.tls = false;
  const auto come = [&] {
    Socket socket = connect_to(plain);
    if (endpoint.tls) {
      socket.use_tls();
      socket.handshake();
    } else {
      send_all(socket, "GET / HTTP/1.1\r\nHost: ");
    }
    return socket;
  };
  std::vector<Socket> sockets;
  std::size_t begun = 0;
  while (!enough) {
    if (sockets.size() < number) {
      sockets.push_back(come());
      ++begun;
      continue;
    }
    std::this_thread::sleep_for(milliseconds(10));
    for (Socket& socket : sockets) {
      pollfd ended{socket.get(), POLLRDHUP, 0};
      if (::poll(&ended, 1, 0) != 1) continue;
      socket.reset();
      socket = come();
      ++begun;
    }
  }
  reset_all(sockets);
  return {std::to_string(begun) + " handshakes begun, " + std::to_string(sockets.size()) + " at a time", {}};
}

}  // namespace

std::vector<Attack> pressures(SemblanteServer& server, const std::string& path, const Options& options) {
  const Endpoint endpoint = server.endpoint();
  const auto coding = options.coding;
  const std::size_t tenth = std::max<std::size_t>(10, options.subscribers / 10);
  const std::size_t half_open_number = options.smoke ? 20 : 1000;
  const std::size_t idle = std::min<std::size_t>(4 * options.subscribers, 6000);
  std::vector<Attack> all = {
      {"slow readers",
       [=](const std::atomic<bool>& enough) { return slow_readers(endpoint, path, coding, tenth, enough); }},
      {"slow writers",
       [=](const std::atomic<bool>& enough) { return slow_writers(endpoint, path, coding, 3 * tenth, enough); }},
      {"header flood", [=](const std::atomic<bool>& enough) { return header_flood(endpoint, 32, enough); }},
      {"idle connections", [=](const std::atomic<bool>& enough) { return idle_connections(endpoint, idle, enough); }},
      {"half-open handshakes",
       [=](const std::atomic<bool>& enough) { return half_open(endpoint, half_open_number, enough); }}};
  std::erase_if(all, [&](const Attack& attack) { return attack.name.find(options.only) == std::string::npos; });
  for (auto& attack : all) {
    attack.run = [run = attack.run](const std::atomic<bool>& enough) {
      // Every other thread takes the processor from it at once: it must not hold up the subscribers, which are beside
      // it.
      const sched_param none{};
      ::sched_setscheduler(0, SCHED_IDLE, &none);
      return run(enough);
    };
  }
  return all;
}

}  // namespace semblante::bench
