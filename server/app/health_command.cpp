#include <iostream>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "protocol/http/http_client.h"
#include "server/app/commands.h"
#include "server/app/option_sources.h"
#include "server/cli/command_failure.h"
#include "server/http/address_range.h"

namespace semblante {
namespace {

struct HealthOptions {
  client::ServerOptions server{.address = {}};
  std::string address = "127.0.0.1";
  std::uint16_t port = 8080;
  std::string path = "/readyz";
  unsigned timeout = 5;  ///< seconds
};

[[noreturn]] void fail_health(const std::string& message) {
  throw CommandFailure(CommandFailure::has_errors, "health: " + message);
}

client::ServerAddress server_of(const HealthOptions& options) {
  auto named = options.server;
  if (named.address.empty()) {
    if (!http::parse_address(options.address))
      throw CommandFailure(CommandFailure::bad_input,
                           "health: --address: " + options.address + " is not an IP address");
    const bool is_six = options.address.find(':') != std::string::npos;
    named.address =
        "http://" + (is_six ? "[" + options.address + "]" : options.address) + ":" + std::to_string(options.port);
  }
  auto server = named.parse();
  if (!server) throw CommandFailure(CommandFailure::bad_input, "health: --server: " + server.error().message);
  return *std::move(server);
}

void check_health(const HealthOptions& options) {
  constexpr std::size_t longest_answer = std::size_t{64} * 1024;
  const client::HttpLimits limits{.max_body = longest_answer, .timeout = std::chrono::seconds(options.timeout)};
  const client::HttpClient client(server_of(options), limits);
  const auto answer = client.get(options.path);
  if (!answer) fail_health(answer.error().where + ": " + answer.error().message);
  if (answer->status != 200) fail_health("the server answers " + std::to_string(answer->status) + " " + answer->reason);
}

}  // namespace

void add_health_command(CLI::App& app) {
  const auto options = std::make_shared<HealthOptions>();
  auto* command = app.add_subcommand(
      "health", "Ask a running server whether it is ready. Exit status 0 or 1: the health check of a container.");
  command->add_option("--server", options->server.address,
                      "Its address, http://HOST:PORT or https://HOST; without it that of --address and --port");
  client::declare_access_options(*command, options->server);
  command->add_option("--address", options->address, "Its address on this machine")
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
    check_health(*options);
    std::cout << (options->path == "/readyz" ? "ready\n" : "alive\n");
  });
}

}  // namespace semblante
