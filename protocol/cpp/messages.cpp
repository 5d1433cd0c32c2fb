#include "protocol/cpp/messages.h"

namespace semblante {
namespace {

StreamErrorCode stream_code(ErrorCode code) {
  switch (code) {
    case ErrorCode::malformed:
      return StreamErrorCode::malformed;
    case ErrorCode::truncated:
      return StreamErrorCode::truncated;
    case ErrorCode::out_of_range:
      return StreamErrorCode::out_of_range;
    case ErrorCode::not_finite:
      return StreamErrorCode::not_finite;
    case ErrorCode::too_large:
      return StreamErrorCode::too_large;
    case ErrorCode::unsupported:
      return StreamErrorCode::unsupported;
    case ErrorCode::mismatch:
      return StreamErrorCode::mismatch;
    case ErrorCode::missing:
    case ErrorCode::empty:
      return StreamErrorCode::missing;
    case ErrorCode::invalid_argument:
      return StreamErrorCode::invalid_argument;
    case ErrorCode::cancelled:
      return StreamErrorCode::other;
    case ErrorCode::io:
    case ErrorCode::internal:
      return StreamErrorCode::internal;
  }
  return StreamErrorCode::other;
}

/// Truncates a text to at most `most` bytes, at a UTF-8 character boundary.
std::string cut(const std::string& text, std::size_t most) {
  if (text.size() <= most) return text;
  while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xC0U) == 0x80U) --most;
  return text.substr(0, most);
}

}  // namespace

StreamError to_stream_error(const Error& error) {
  return {stream_code(error.code), cut(error.where, 1024), cut(error.message, 4096)};
}

}  // namespace semblante
