#include "server/http/security_headers.h"

#include <array>

namespace semblante::http {

std::span<const Header> security_headers() {
  static const std::array<Header, 4> headers = {{
      {"Content-Security-Policy", "frame-ancestors 'none'"},
      {"X-Frame-Options", "DENY"},  // for browsers that do not know frame-ancestors
      {"X-Content-Type-Options", "nosniff"},
      {"Referrer-Policy", "no-referrer"},
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

}  // namespace semblante::http
