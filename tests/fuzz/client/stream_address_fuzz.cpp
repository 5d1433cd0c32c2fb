#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "clients/native/viewer/address.h"

// A server's address is never longer than what was given but for the scheme, and a stream's name is no longer than it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto address = semblante::viewer::parse_stream_address(text);
  if (!address) {
    if (address.error().message.empty()) std::abort();
    return 0;
  }
  if (address->server.size() > text.size() + 2 || address->stream.size() > text.size()) std::abort();
  return 0;
}
