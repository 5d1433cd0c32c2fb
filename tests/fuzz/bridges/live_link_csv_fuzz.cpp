#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "core/bridges/live_link_csv.h"

using namespace semblante;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto take = read_live_link_csv(text);
  if (!take) return 0;
  double last = 0.0;
  for (const LiveLinkRow& row : take->rows) {
    if (!(row.seconds >= last)) std::abort();
    last = row.seconds;
    // What was accepted makes a face, and is read back from it within bounds.
    const auto made = frame_from_arkit(row.coefficients);
    if (!made) std::abort();
    for (const float value : arkit_from_frame(made->frame)) {
      if (!(value >= 0.0F && value <= 1.0F)) std::abort();
    }
  }
  if (take->rows.size() <= 4) {
    const auto again = read_live_link_csv(write_live_link_csv(take->rows));
    // A day and more is written as the time of day, so that time can fall.
    if (!again && last < 80000.0) std::abort();
  }
  return 0;
}
