#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/types/result.h"
#include "protocol/http/http_client.h"

namespace semblante::client {

/// Reads one answer of HTTP/1.1 (RFC 9112) from pieces of any size, within limits.
class HttpAnswer {
 public:
  /// `is_head`: the answer to a HEAD, which has no body.
  HttpAnswer(const HttpLimits& limits, bool is_head) : limits_(limits), is_head_(is_head) {}

  /// Takes the next bytes. True once the answer is whole; what follows it is held. Errors: malformed, too_large.
  Result<bool> take(std::string_view bytes);
  /// The server has closed the connection. True if that ends the answer.
  bool close();

  /// Once whole; at a "101 Switching Protocols" the answer is whole after its head.
  [[nodiscard]] HttpResponse& response() { return response_; }
  /// Bytes behind the answer: of the protocol that was switched to.
  [[nodiscard]] std::string_view rest() const { return std::string_view(held_).substr(at_); }

 private:
  enum class Part { head, body, body_to_close, chunk_head, chunk, chunk_end, trailers, whole };
  /// Reads one part. False if it needs more bytes.
  Result<bool> step();
  Status read_head(std::string_view head);
  Result<bool> take_line(std::string_view& line);
  Status expect_body(std::uint64_t bytes);
  /// Moves bytes to the body, as many as are there and belong to it.
  void move_body(std::uint64_t most);

  HttpLimits limits_;
  bool is_head_;
  Part part_ = Part::head;
  std::string held_;
  std::size_t at_ = 0;           ///< the first byte of `held_` that was not read
  std::size_t around_ = 0;       ///< bytes of the trailers so far
  std::uint64_t remaining_ = 0;  ///< of the body or chunk
  HttpResponse response_;
};

}  // namespace semblante::client
