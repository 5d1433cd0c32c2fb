#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/net/server.h"
#include "server/net/tls_context.h"

namespace semblante {

/// Addresses of this machine in its networks, IPv4 first; loopback and link-local ones are left out.
std::vector<std::string> network_addresses();

/// The URLs by which other machines reach the listeners: for each with TLS that is not for this machine alone, the
/// names of the certificate, which are the hosts that the API accepts. An address that this machine no longer has is
/// left out. `ports` are those of the bound sockets.
std::vector<std::string> network_urls(std::span<const net::Listener> listeners, std::span<const std::uint16_t> ports,
                                      std::span<const std::string> certificate_names);

/// A self-signed certificate for these names and addresses, with its key, in a data folder
/// (store::home_certificate_files); an earlier one is used again if it names all of them and does not expire soon.
/// Throws CommandFailure.
net::TlsFiles self_signed_certificate(const std::filesystem::path& data, const std::vector<std::string>& names);

/// A QR code in block characters, dark on light, with its margin; empty when the text is too long for one.
std::string qr_code(std::string_view text);

}  // namespace semblante
