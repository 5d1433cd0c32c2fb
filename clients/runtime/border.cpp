#include "clients/runtime/border.h"

namespace semblante::runtime {

void copy_text(std::span<char> to, std::string_view text) {
  std::size_t length = std::min(text.size(), to.size() - 1);
  const auto continues = [&](std::size_t at) { return (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U; };
  while (length > 0 && length < text.size() && continues(length)) --length;
  std::memcpy(to.data(), text.data(), length);
  to[length] = '\0';
}

semblante_result result_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::unsupported:
      return SEMBLANTE_UNSUPPORTED;
    case ErrorCode::mismatch:
      return SEMBLANTE_MISMATCH;
    case ErrorCode::too_large:
      return SEMBLANTE_TOO_LARGE;
    case ErrorCode::io:
      return SEMBLANTE_UNAVAILABLE;
    case ErrorCode::internal:
    case ErrorCode::cancelled:
      return SEMBLANTE_INTERNAL;
    default:
      return SEMBLANTE_MALFORMED;
  }
}

}  // namespace semblante::runtime

extern "C" {

uint32_t semblante_sdk_version(void) { return SEMBLANTE_SDK_VERSION; }

const char* semblante_result_name(semblante_result result) {
  switch (result) {
    case SEMBLANTE_OK:
      return "ok";
    case SEMBLANTE_INVALID_ARGUMENT:
      return "invalid argument";
    case SEMBLANTE_MALFORMED:
      return "malformed";
    case SEMBLANTE_UNSUPPORTED:
      return "unsupported";
    case SEMBLANTE_MISMATCH:
      return "mismatch";
    case SEMBLANTE_TOO_LARGE:
      return "too large";
    case SEMBLANTE_BUFFER_TOO_SMALL:
      return "buffer too small";
    case SEMBLANTE_OUT_OF_MEMORY:
      return "out of memory";
    case SEMBLANTE_INTERNAL:
      return "internal";
    case SEMBLANTE_UNAVAILABLE:
      return "unavailable";
  }
  return "unknown";
}

}  // extern "C"
