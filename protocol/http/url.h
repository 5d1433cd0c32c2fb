#pragma once

#include <string>
#include <string_view>

#include "core/types/result.h"

namespace semblante::client {

/// A server's address: "http://127.0.0.1:8080", "https://faces.example", or with a path in front of /v1.
struct Url {
  std::string host;  ///< an IPv6 address without its brackets
  std::string port = "80";
  std::string path;     ///< without a slash at its end; empty or "/base"
  bool secure = false;  ///< https

  /// "host:port" as a Host field has it: an IPv6 address in brackets.
  [[nodiscard]] std::string authority() const;
};

/// Errors: invalid_argument (no host, an invalid port).
Result<Url> parse_url(std::string_view text);

/// A path segment with everything but letters, digits and -._~ percent-encoded.
std::string escape_segment(std::string_view segment);

}  // namespace semblante::client
