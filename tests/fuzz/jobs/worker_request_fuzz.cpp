#include <cstdint>
#include <cstdlib>

#include "server/jobs/worker_protocol.h"

// What is read is written so that it reads the same.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace semblante::jobs;
  const auto request = worker_request_from_json({reinterpret_cast<const char*>(data), size});
  if (!request) {
    if (request.error().message.empty()) std::abort();
    return 0;
  }
  const auto text = to_json(*request);
  const auto again = worker_request_from_json(text);
  if (!again || to_json(*again) != text) std::abort();
  return 0;
}
