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

/// Beast's HTTP/1 grammar with plain values behind it: the header becomes an http::Request, the body goes piece by
/// piece into a sink, trailers and chunk extensions are checked and dropped. Beast's own containers are not used, since
/// they throw on a field of more than 64 KiB, and keep trailers without a limit.
class RequestParser : public boost::beast::http::basic_parser<true> {
 public:
  using ErrorCode = boost::system::error_code;

  /// `max_bytes`: of the header, and of all chunk extensions of a body together. The caller's buffer has this size,
  /// which bounds the line before a chunk and the trailers, since the grammar wants each of them whole. `max_fields`:
  /// of the header, and as many query parameters; each takes some hundred bytes of memory however short it is.
  RequestParser(std::uint32_t max_bytes, std::uint32_t max_fields);

  /// The request; all but its body is there when is_header_done().
  [[nodiscard]] http::Request& request() { return request_; }
  /// 10 or 11.
  [[nodiscard]] unsigned version() const { return version_; }
  /// Takes the body; before the first put() after the header.
  void set_sink(BodySink& sink) { sink_ = &sink; }
  /// Fewer bytes than these cannot be parsed yet.
  [[nodiscard]] std::size_t least_bytes() const;

  /// What the client is told about bytes on which put() failed with `error`; nullopt when it is the connection that
  /// failed. `unread`: what the buffer still holds.
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

  const std::uint32_t max_bytes_, max_fields_;
  http::Request request_;
  unsigned version_ = 11;
  std::uint32_t fields_ = 0;
  std::size_t extension_bytes_ = 0;
  BodySink* sink_ = nullptr;
  std::optional<http::Problem> problem_;  ///< why a callback ended the parsing
};

}  // namespace semblante::net
