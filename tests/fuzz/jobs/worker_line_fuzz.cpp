#include <cstdint>
#include <cstdlib>

#include "server/jobs/worker_protocol.h"

// What is read is written as one line that reads the same.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace semblante::jobs;
  const auto line = worker_line_from_json({reinterpret_cast<const char*>(data), size});
  if (!line) {
    if (line.error().message.empty()) std::abort();
    return 0;
  }
  const auto text = to_json_line(*line);
  if (text.find('\n') + 1 != text.size()) std::abort();
  const auto again = worker_line_from_json(text);
  if (!again || to_json_line(*again) != text) std::abort();
  return 0;
}
