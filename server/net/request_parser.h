#pragma once

// Private to net/.

#include <cstdint>
#include <optional>
#include <string_view>

#include <boost/beast/http/basic_parser.hpp>

#include "server/http/message.h"
#include "server/http/problem.h"
#include "server/net/body_sink.h"

namespace semblante::net {

/// Beast's HTTP/1 grammar with plain values as its output: the header becomes an http::Request, the body is passed
/// piece by piece to a sink, trailers and chunk extensions are checked and dropped. Beast's own containers are not
/// used, because they throw on a field of more than 64 KiB and keep trailers without a limit.
class RequestParser : public boost::beast::http::basic_parser<true> {
 public:
  using ErrorCode = boost::system::error_code;

  /// `max_bytes`: limit of the header, and of all chunk extensions of a body together. The caller's buffer has this
  /// size, which also limits the line before a chunk and the trailers, because the grammar needs each of them complete.
  /// `max_fields`: limit of the fields of the header, and of the query parameters; each takes some hundred bytes of
  /// memory even if it is short.
  RequestParser(std::uint32_t max_bytes, std::uint32_t max_fields);

  /// The request; complete except for its body when is_header_done().
  [[nodiscard]] http::Request& request() { return request_; }
  /// 10 or 11.
  [[nodiscard]] unsigned version() const { return version_; }
  /// Sets the receiver of the body; to be called before the first put() after the header.
  void set_sink(BodySink& sink) { sink_ = &sink; }
  /// Minimum number of bytes that can be parsed.
  [[nodiscard]] std::size_t least_bytes() const;
  /// put(), with a limit of the bytes that frame a chunked body: sizes may begin with any number of zeros. Returns the
  /// number of parsed bytes.
  std::size_t take(boost::asio::const_buffer bytes, ErrorCode& error);

  /// The problem for bytes on which put() failed with `error`; nullopt when the connection failed. `unread`: the rest
  /// of the buffer.
  [[nodiscard]] std::optional<http::Problem> problem_of(const ErrorCode& error, std::string_view unread) const;

 private:
  using View = boost::beast::string_view;

  void on_request_impl(boost::beast::http::verb, View method, View target, int version, ErrorCode& error) override;
  void on_response_impl(int, View, int, ErrorCode&) override {}
  void on_field_impl(boost::beast::http::field, View name, View value, ErrorCode& error) override;
  void on_header_impl(ErrorCode&) override;
  void on_body_init_impl(const boost::optional<std::uint64_t>&, ErrorCode&) override {}
  std::size_t on_body_impl(View piece, ErrorCode& error) override;
  void on_chunk_header_impl(std::uint64_t, View extensions, ErrorCode& error) override;
  std::size_t on_chunk_body_impl(std::uint64_t, View piece, ErrorCode& error) override;
  void on_finish_impl(ErrorCode&) override {}

  [[nodiscard]] http::Problem header_too_large() const;
  /// What makes the header ambiguous (RFC 9112 sections 3.2 and 6.1): a proxy in front of the server could see another
  /// end of the message, or another host, than the server.
  [[nodiscard]] std::optional<http::Problem> ambiguity() const;

  const std::uint32_t max_bytes_, max_fields_;
  http::Request request_;
  unsigned version_ = 11;
  std::uint32_t fields_ = 0;
  std::uint32_t hosts_ = 0;  ///< number of Host fields
  std::string authority_;    ///< of a target in absolute form
  std::size_t extension_bytes_ = 0;
  std::uint64_t body_bytes_ = 0, framing_bytes_ = 0;  ///< the second: sizes, extensions and line breaks of chunks
  BodySink* sink_ = nullptr;
  std::optional<http::Problem> problem_;  ///< why a callback ended the parsing
};

}  // namespace semblante::net
