#include <cstdlib>

#include "protocol/cpp/fap_file_frames.h"

using namespace semblante;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto reading = read_fap_file({reinterpret_cast<const char*>(data), size});
  if (!reading) return 0;
  // What was read is written so that it reads the same.
  const std::string written = write_fap_file(reading->file);
  const auto again = read_fap_file(written);
  if (!again || !(again->file == reading->file) || write_fap_file(again->file) != written) std::abort();
  if (const auto frames = frames_of(reading->file, {AbsentFap::keep, FrameGap::hold})) {
    FapFileLimits limits;
    limits.frames = 1000;
    static_cast<void>(fap_file_of(*frames, {reading->file.rate, false, "x"}, limits));
  }
  return 0;
}
