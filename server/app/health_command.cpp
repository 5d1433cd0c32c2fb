#include <array>
#include <cerrno>
#include <cstring>
#include <iostream>
#include <memory>
#include <string>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>

#include "server/app/commands.h"
#include "server/app/option_sources.h"
#include "server/cli/command_failure.h"

namespace semblante {
namespace {

struct HealthOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 8080;
  std::string path = "/readyz";
  unsigned timeout = 5;  ///< seconds
};

class Socket {
 public:
  explicit Socket(int family) : descriptor_(::socket(family, SOCK_STREAM | SOCK_CLOEXEC, 0)) {}
  ~Socket() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  [[nodiscard]] int get() const { return descriptor_; }

 private:
  int descriptor_;
};

[[noreturn]] void fail_health(const std::string& message) {
  throw CommandFailure(CommandFailure::has_errors, "health: " + message);
}

/// The status line of the answer, without its line break.
std::string ask(const HealthOptions& options) {
  sockaddr_in four{};
  sockaddr_in6 six{};
  four.sin_family = AF_INET;
  four.sin_port = htons(options.port);
  six.sin6_family = AF_INET6;
  six.sin6_port = htons(options.port);
  const bool is_four = ::inet_pton(AF_INET, options.address.c_str(), &four.sin_addr) == 1;
  if (!is_four && ::inet_pton(AF_INET6, options.address.c_str(), &six.sin6_addr) != 1)
    throw CommandFailure(CommandFailure::bad_input, "health: --address: " + options.address + " is not an IP address");
  const auto* const address =
      is_four ? reinterpret_cast<const sockaddr*>(&four) : reinterpret_cast<const sockaddr*>(&six);

  const Socket socket(address->sa_family);
  const timeval patience{static_cast<time_t>(options.timeout), 0};
  ::setsockopt(socket.get(), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  ::setsockopt(socket.get(), SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
  if (::connect(socket.get(), address, is_four ? sizeof four : sizeof six) != 0)
    fail_health("no server at " + options.address + " port " + std::to_string(options.port) + ": " +
                std::strerror(errno));
  const auto request = "GET " + options.path + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";
  std::string answer;
  bool open =
      ::send(socket.get(), request.data(), request.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(request.size());
  while (open && answer.find("\r\n") == std::string::npos) {
    std::array<char, 512> piece{};
    const auto bytes = ::recv(socket.get(), piece.data(), piece.size(), 0);
    open = bytes > 0;
    if (open) answer.append(piece.data(), static_cast<std::size_t>(bytes));
  }
  const auto end = answer.find("\r\n");
  if (end == std::string::npos) fail_health("no answer within " + std::to_string(options.timeout) + " s");
  return answer.substr(0, end);
}

}  // namespace

void add_health_command(CLI::App& app) {
  const auto options = std::make_shared<HealthOptions>();
  auto* command = app.add_subcommand(
      "health",
      "Ask a running server on this machine whether it is ready. Exit status 0 or 1: the health check of a container.");
  command->add_option("--address", options->address, "Its address")
      ->envname("SEMBLANTE_ADDRESS")
      ->capture_default_str();
  command->add_option("--port", options->port, "Its port")->envname("SEMBLANTE_PORT")->capture_default_str();
  command->add_option("--path", options->path, "/readyz: it can do its work; /healthz: it answers")
      ->check(CLI::IsMember({"/readyz", "/healthz"}))
      ->capture_default_str();
  command->add_option("--timeout", options->timeout, "Seconds to wait")
      ->check(CLI::Range(1, 60))
      ->capture_default_str();
  const auto sources = OptionSources::declare(*command, OptionSources::Offers::environment);
  command->callback([options, sources] {
    sources->apply();
    const auto status = ask(*options);
    if (status.substr(0, 13) != "HTTP/1.1 200 ") fail_health("the server answers " + status);
    std::cout << (options->path == "/readyz" ? "ready\n" : "alive\n");
  });
}

}  // namespace semblante
