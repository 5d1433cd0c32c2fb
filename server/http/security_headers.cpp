#include "server/http/security_headers.h"

#include <array>
#include <string_view>

namespace semblante::http {

std::span<const Header> security_headers() {
  static const std::array<Header, 5> headers = {{
      {"Content-Security-Policy", "frame-ancestors 'none'"},
      {"X-Frame-Options", "DENY"},  // for browsers that do not know frame-ancestors
      {"X-Content-Type-Options", "nosniff"},
      {"Referrer-Policy", "no-referrer"},
      {"Cross-Origin-Resource-Policy", "same-origin"},
  }};
  return headers;
}

std::span<const Header> page_headers() {
  static const std::array<Header, 3> headers = {{
      {"Content-Security-Policy",
       "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self' blob:; "
       "connect-src 'self' blob: data:; img-src 'self' blob: data:; media-src 'self' blob:; object-src 'none'; "
       "base-uri 'none'; form-action 'self'; frame-ancestors 'none'"},
      {"Cross-Origin-Opener-Policy", "same-origin"},
      {"X-Content-Type-Options", "nosniff"},
  }};
  return headers;
}

void allow_frames(Response& response, std::span<const std::string> origins) {
  constexpr std::string_view none = "frame-ancestors 'none'";
  auto& policy = response.headers["Content-Security-Policy"];
  const auto at = policy.find(none);
  if (origins.empty() || at == std::string::npos) return;
  std::string allowed = "frame-ancestors 'self'";
  for (const auto& origin : origins) allowed.append(" ").append(origin);
  policy.replace(at, none.size(), allowed);
  response.headers.erase("X-Frame-Options");  // it cannot name an origin
}

}  // namespace semblante::http
