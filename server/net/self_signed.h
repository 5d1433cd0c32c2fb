#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "core/types/result.h"
#include "server/net/tls_context.h"

namespace semblante::net {

/// Makes a key (P-256) and a certificate for these host names and IP addresses, signed with that key, and writes both
/// files. It is valid from an hour ago, because clocks of clients differ. Errors: `io`.
Status write_self_signed(const TlsFiles& files, const std::string& common_name, const std::vector<std::string>& names,
                         std::chrono::seconds validity);

}  // namespace semblante::net
