#include "protocol/http/server_address.h"

#include <algorithm>

#include <CLI/CLI.hpp>

namespace semblante::client {

Result<ServerAddress> ServerOptions::parse() const {
  auto url = parse_url(address);
  if (!url) return std::move(url).error();
  if (!std::all_of(token.begin(), token.end(), [](unsigned char c) { return c > ' ' && c <= '~'; }))
    return Error{ErrorCode::invalid_argument, "--token", "a token has letters, digits, _ and - only"};
  ServerAddress server(*std::move(url));
  server.token = token;
  server.authority = authority;
  server.verify = !insecure;
  return server;
}

void declare_access_options(CLI::App& app, ServerOptions& options) {
  app.add_option("--token", options.token,
                 "For a server that asks for tokens. Other users of this machine see a command line: the variable "
                 "SEMBLANTE_TOKEN is for itself")
      ->envname("SEMBLANTE_TOKEN");
  app.add_option("--ca", options.authority,
                 "PEM file of the authority that has signed the certificate of the server, for https; without it those "
                 "that the system trusts")
      ->envname("SEMBLANTE_CA");
  app.add_flag("--insecure", options.insecure, "Accept any certificate: for the server of this machine only");
}

}  // namespace semblante::client
