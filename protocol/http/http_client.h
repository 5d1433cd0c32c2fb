#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/types/result.h"
#include "protocol/http/server_address.h"

namespace semblante::client {

struct HttpRequest {
  std::string method = "GET";
  std::string target;  ///< "/v1/models?limit=2"; appended to the path of the server's URL
  std::string body;
  std::string content_type;  ///< sent when not empty
  std::vector<std::pair<std::string, std::string>> headers;
};

struct HttpResponse {
  int status = 0;
  std::string reason;                                        ///< of the first line: "OK"
  std::vector<std::pair<std::string, std::string>> headers;  ///< names in lower case
  std::string body;

  /// First header of that name (lower case); empty when there is none.
  [[nodiscard]] std::string_view header(std::string_view name) const;
};

/// For display: the status, and the text of a problem document (RFC 9457). No other body is quoted.
std::string words_of(const HttpResponse& response);

struct HttpLimits {
  std::size_t max_body = std::size_t{256} << 20U;   ///< of a response
  std::size_t max_header = std::size_t{60} << 10U;  ///< at most that; also of trailers and chunk extensions
  std::chrono::milliseconds timeout{30'000};        ///< of one complete exchange
};

/// HTTP/1.1, with TLS or without, one connection per request, blocking. The token of the server's address is sent. Does
/// not trust the server: sizes and times are bounded. Copyable; a copy may be used on another thread.
class HttpClient {
 public:
  explicit HttpClient(ServerAddress server, HttpLimits limits = {}) : server_(std::move(server)), limits_(limits) {}

  [[nodiscard]] const ServerAddress& server() const { return server_; }

  /// Returns any complete response with any status. Errors: io (no connection, a certificate that is not trusted, cut
  /// off, late), too_large, malformed.
  [[nodiscard]] Result<HttpResponse> send(const HttpRequest& request) const;
  [[nodiscard]] Result<HttpResponse> get(std::string_view target) const;
  [[nodiscard]] Result<HttpResponse> post(std::string_view target, std::string body, std::string content_type) const;

  /// The body of a 200; any other response is an error with the text of its problem document: missing for 404, else io.
  /// `max_body`: of this response, if it is known.
  [[nodiscard]] Result<std::string> fetch(std::string_view target, std::optional<std::size_t> max_body = {}) const;

 private:
  ServerAddress server_;
  HttpLimits limits_;
};

}  // namespace semblante::client
