#include <cmath>
#include <cstdlib>

#include "core/performance/performance.h"
#include "protocol/cpp/performance_document.h"

using namespace semblante;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto script = read_performance({reinterpret_cast<const char*>(data), size});
  if (!script) return 0;
  const auto performance = Performance::compile(*script);
  if (!performance) return 0;
  for (const double share : {0.0, 0.1, 0.37, 0.5, 0.81, 1.0, 3.0}) {
    const auto frame = performance->frame_at(share * performance->duration(), share * 1e5);
    if (frame.viseme1 > 14 || frame.viseme2 > 14 || frame.viseme_blend > 63 || frame.expression1 > 6 ||
        frame.expression2 > 6 || frame.intensity1 > 63 || frame.intensity2 > 63)
      std::abort();
    for (const float value : frame.fap) {
      if (!std::isfinite(value)) std::abort();
    }
  }
  // What was accepted can be written, and means the same.
  const auto again = read_performance(write_performance(*script));
  if (!again || !Performance::compile(*again)) std::abort();
  return 0;
}
