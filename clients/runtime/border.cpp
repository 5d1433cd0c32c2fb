#include "clients/runtime/border.h"

namespace semblante::runtime {

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
