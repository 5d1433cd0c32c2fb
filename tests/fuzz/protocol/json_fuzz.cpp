#include <cstdlib>

#include "protocol/cpp/json_codec.h"

using namespace semblante;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  static_cast<void>(decode_json_frames(text));
  static_cast<void>(decode_json_values(text));
  const auto message = decode_json(text);
  if (!message) return 0;
  // What was accepted can be said again, and means the same.
  const auto echo = decode_json(encode_json(*message));
  if (!echo || !(*echo == *message)) std::abort();
  return 0;
}
