#include "server/net/request_parser.h"

#include <algorithm>
#include <cassert>
#include <string>

#include <boost/beast/http/error.hpp>

#include "core/types/letter_case.h"
#include "server/http/url.h"
#include "server/net/server.h"

namespace semblante::net {

namespace {

using E = boost::beast::http::error;

std::string_view view(boost::beast::string_view text) { return {text.data(), text.size()}; }

/// Whether the field of this name goes on in a further line (obs-fold). The parser has seen the end of the first line
/// and the byte after it.
bool is_folded(boost::beast::string_view name) {
  const char* at = name.end();
  while (*at != '\r') ++at;
  return at[2] == ' ' || at[2] == '\t';
}

}  // namespace

RequestParser::RequestParser(std::uint32_t max_bytes, std::uint32_t max_fields)
    : max_bytes_(max_bytes), max_fields_(max_fields) {
  header_limit(max_bytes);
  body_limit(boost::none);  // the sink checks the size
}

std::size_t RequestParser::least_bytes() const {
  // "0\r\n\r\n" is the shortest end of a chunked body, so at least as many bytes always follow. Beast asserts that it
  // does not get fewer after the last chunk's size.
  constexpr std::size_t shortest_end = 5;
  return is_header_done() && chunked() ? shortest_end : 1;
}

std::size_t RequestParser::take(boost::asio::const_buffer bytes, ErrorCode& error) {
  const auto body_before = body_bytes_;
  const bool in_body = is_header_done();
  const std::size_t parsed = put(bytes, error);
  if (!in_body || error) return parsed;
  framing_bytes_ += parsed - (body_bytes_ - body_before);
  constexpr std::uint64_t most_per_byte = ServerLimits::framing_per_byte;
  if (framing_bytes_ <= max_bytes_ + most_per_byte * body_bytes_) return parsed;
  problem_ = http::make_problem("malformed-request", "the chunks of the body have more than " +
                                                         std::to_string(most_per_byte) + " bytes of framing for each " +
                                                         "byte of content, beside " + std::to_string(max_bytes_));
  error = E::bad_chunk;
  return parsed;
}

void RequestParser::on_request_impl(boost::beast::http::verb, View method, View target, int version, ErrorCode& error) {
  request_.method = view(method);
  version_ = static_cast<unsigned>(version);
  if (std::count(target.begin(), target.end(), '&') >= max_fields_) {
    problem_ = header_too_large();
    error = E::header_limit;
    return;
  }
  request_.target = view(target);
  if (auto absolute = http::absolute_target(view(target))) {
    authority_ = absolute->authority;
    request_.target = std::move(absolute->rest);
  }
  if (request_.target == "*" && request_.method == "OPTIONS") {  // of the whole server (RFC 9112, 3.2.4)
    request_.path = request_.target;
    return;
  }
  auto parsed = http::parse_target(request_.target);
  if (!parsed) {
    problem_ = http::make_problem("malformed-request",
                                  "the request target is not a path, or has an encoded slash, "
                                  "a zero byte, or a % without two hexadecimal digits after it");
    return;  // refused after the header, whose Origin decides which pages may read the answer
  }
  request_.path = std::move(parsed->path);
  request_.query = std::move(parsed->query);
  request_.repeated = std::move(parsed->repeated);
}

void RequestParser::on_field_impl(boost::beast::http::field field, View name, View value, ErrorCode& error) {
  if (is_folded(name)) {
    problem_ = http::make_problem("malformed-request", "a header field goes on in a further line");
    error = E::bad_field;
    return;
  }
  if (is_header_done()) return;  // a trailer: ignored
  if (++fields_ > max_fields_) {
    problem_ = header_too_large();
    error = E::header_limit;
    return;
  }
  if (field == boost::beast::http::field::host) ++hosts_;
  const auto text = view(value);
  const auto [at, is_new] = request_.headers.try_emplace(std::string(view(name)), text);
  if (!is_new) at->second.append(", ").append(text);
}

void RequestParser::on_header_impl(ErrorCode& error) {
  request_.received = std::chrono::steady_clock::now();
  if (!problem_) problem_ = ambiguity();
  // The host of a target in absolute form replaces the Host field (RFC 9112, 3.2.2).
  if (!authority_.empty()) request_.headers["Host"] = authority_;
  if (problem_) error = E::bad_field;
}

std::optional<http::Problem> RequestParser::ambiguity() const {
  const auto malformed = [](std::string detail) { return http::make_problem("malformed-request", std::move(detail)); };
  if (hosts_ > 1) return malformed("the request has more than one Host field");
  if (hosts_ == 0 && version_ >= 11) return malformed("the request has no Host field");
  // "2, 2" too, which is also the form of two such fields.
  if (const auto length = request_.header("Content-Length");
      length && length->find_first_not_of("0123456789") != std::string_view::npos)
    return malformed("Content-Length is not one number");
  const auto coding = request_.header("Transfer-Encoding");
  if (!coding) return std::nullopt;
  if (version_ < 11) return malformed("Transfer-Encoding needs HTTP/1.1");
  if (request_.header("Content-Length")) return malformed("the request has both Transfer-Encoding and Content-Length");
  if (!equal_ignoring_case(*coding, "chunked")) return malformed("the only supported Transfer-Encoding is chunked");
  return std::nullopt;
}

std::size_t RequestParser::on_body_impl(View piece, ErrorCode& error) {
  assert(sink_ != nullptr);
  body_bytes_ += piece.size();
  problem_ = sink_->append(view(piece));
  if (problem_) error = E::body_limit;
  return piece.size();
}

std::size_t RequestParser::on_chunk_body_impl(std::uint64_t, View piece, ErrorCode& error) {
  return on_body_impl(piece, error);
}

void RequestParser::on_chunk_header_impl(std::uint64_t size, View extensions, ErrorCode& error) {
  assert(sink_ != nullptr);
  problem_ = sink_->announce(size);
  if (problem_) {
    error = E::body_limit;
    return;
  }
  // Beast takes any byte within quotes. A proxy that ends the line at a line feed alone would see another body.
  if (std::any_of(extensions.begin(), extensions.end(),
                  [](unsigned char c) { return (c < ' ' && c != '\t') || c == 0x7f; })) {
    problem_ = http::make_problem("malformed-request", "a chunk extension has a control character");
    error = E::bad_chunk_extension;
    return;
  }
  extension_bytes_ += extensions.size();
  if (extension_bytes_ <= max_bytes_) return;
  problem_ = http::make_problem("malformed-request", "the chunk extensions of the body have together more than " +
                                                         std::to_string(max_bytes_) + " bytes");
  error = E::bad_chunk_extension;
}

http::Problem RequestParser::header_too_large() const {
  return http::make_problem("header-too-large", "the header has more than " + std::to_string(max_bytes_) +
                                                    " bytes, or more than " + std::to_string(max_fields_) +
                                                    " fields or query parameters");
}

std::optional<http::Problem> RequestParser::problem_of(const ErrorCode& error, std::string_view unread) const {
  if (problem_) return problem_;
  if (error.category() != boost::beast::http::make_error_code(E::bad_value).category() || error == E::end_of_stream)
    return std::nullopt;
  if (error == E::header_limit) return header_too_large();
  if (error == E::bad_version)
    return http::make_problem(
        "http-version",
        "the version is neither HTTP/1.1 nor HTTP/1.0, or the target has a space that is not %20, or the line does not "
        "end with CR LF");
  if (error == E::buffer_overflow) {
    // If the line before a chunk is complete, the trailers are too long; that line may follow the line break of the
    // chunk before.
    const std::size_t line = unread.starts_with("\r\n") ? 2 : 0;
    if (unread.find("\r\n", line) == std::string_view::npos)
      return http::make_problem("malformed-request",
                                "the line before a chunk has more than " + std::to_string(max_bytes_) + " bytes");
    return http::make_problem("header-too-large", "the last chunk's extensions and the trailers have more than " +
                                                      std::to_string(max_bytes_) + " bytes");
  }
  return http::make_problem(
      "malformed-request",
      (is_header_done() ? "the body cannot be read: " : "not an HTTP request: ") + error.message());
}

}  // namespace semblante::net
