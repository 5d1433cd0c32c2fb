#include <cstring>

#include "clients/runtime/semblante.h"
#include "tests/fuzz/runtime/pieces.h"

/// The input is a performance document. What was accepted gives valid frames at any time.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  semblante_performance* performance = nullptr;
  semblante_error error{};
  const auto made = semblante_performance_create(reinterpret_cast<const char*>(data), size, &performance, &error);
  must((made == SEMBLANTE_OK) == (performance != nullptr));
  must(made == SEMBLANTE_OK || error.message[0] != '\0');
  must(made != SEMBLANTE_INTERNAL);
  if (performance == nullptr) return 0;
  must(semblante_performance_name(performance) != nullptr);
  const double duration = semblante_performance_duration(performance);
  must(duration >= 0 && std::isfinite(duration));
  semblante_frame frame{};
  for (const double share : {0.0, 0.2, 0.49, 0.8, 1.0, 1.5}) {
    for (const double at : {share * duration, share * 1e4, share * 1e12, share * 6e15}) {
      must(semblante_performance_frame_at(performance, at, at, &frame) == SEMBLANTE_OK);
      must(frame.viseme1 <= 14 && frame.viseme2 <= 14 && frame.viseme_blend <= 63);
      must(frame.expression1 <= 6 && frame.expression2 <= 6 && frame.intensity1 <= 63 && frame.intensity2 <= 63);
      must_be_finite(frame.fap);
    }
  }
  for (const double wrong : {-1.0, std::nan(""), HUGE_VAL, 1e16}) {
    must(semblante_performance_frame_at(performance, wrong, 0, &frame) == SEMBLANTE_INVALID_ARGUMENT);
    must(semblante_performance_frame_at(performance, 0, wrong, &frame) == SEMBLANTE_INVALID_ARGUMENT);
  }
  semblante_performance_destroy(performance);
  return 0;
}
