#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "core/types/result.h"
#include "protocol/http/url.h"

namespace CLI {
class App;
}

namespace semblante::client {

/// A server, and how it is spoken to. A bare URL converts to it.
struct ServerAddress {
  Url url;
  std::string token = {};                ///< sent as Authorization: Bearer; empty: none
  std::filesystem::path authority = {};  ///< PEM file of the authority that has signed the certificate; empty: those
                                         ///< that the system trusts
  bool verify = true;                    ///< false: any certificate is accepted, which only fits this machine's server

  ServerAddress(Url address) : url(std::move(address)) {}  // NOLINT(google-explicit-constructor)
};

/// The options by which all command lines name a server.
struct ServerOptions {
  std::string address = "http://127.0.0.1:8080";
  std::string token = {}, authority = {};
  bool insecure = false;

  /// Errors: those of parse_url(); invalid_argument (a token that fits no header).
  [[nodiscard]] Result<ServerAddress> parse() const;
};

/// Declares --token, --ca and --insecure, with their variables SEMBLANTE_TOKEN and SEMBLANTE_CA. `options` must outlive
/// the command line.
void declare_access_options(CLI::App& app, ServerOptions& options);

}  // namespace semblante::client
