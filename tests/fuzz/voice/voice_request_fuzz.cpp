#include <cstdint>
#include <cstdlib>

#include "server/voice/voice_protocol.h"

// What is accepted is accepted again, and says the same.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace semblante::voice;
  const auto request = request_from_json({reinterpret_cast<const char*>(data), size});
  if (!request) {
    if (request.error().message.empty()) std::abort();
    return 0;
  }
  if (!check(*request) || request->text.size() > max_text_bytes) std::abort();
  const auto again = request_from_json(to_json(*request));
  if (!again || again->text != request->text || again->ssml != request->ssml || again->voice != request->voice ||
      again->language != request->language || again->rate != request->rate || again->pitch != request->pitch)
    std::abort();
  return 0;
}
