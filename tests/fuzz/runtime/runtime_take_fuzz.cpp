#include <string>

#include "clients/runtime/semblante.h"
#include "tests/fuzz/runtime/pieces.h"

/// The input: a byte of the format and the options, then the file. What was read is in order and finite, and can be
/// written and read again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Pieces input(data, size);
  const std::uint32_t kind = input.byte();
  const std::uint32_t format = kind % 3U;
  const semblante_take_options options{sizeof(options), kind / 3U % 3U, kind / 9U % 3U};
  const auto text = input.rest();
  semblante_take* take = nullptr;
  semblante_error error{};
  const auto made =
      semblante_take_read(format, reinterpret_cast<const char*>(text.data()), text.size(), &options, &take, &error);
  must((made == SEMBLANTE_OK) == (take != nullptr));
  must(made == SEMBLANTE_OK || error.message[0] != '\0');
  must(made != SEMBLANTE_INTERNAL);
  if (take == nullptr) return 0;

  std::uint32_t count = 0;
  const semblante_timed_frame* frames = semblante_take_frames(take, &count);
  double last = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    must(frames[i].time >= last);
    last = frames[i].time;
    must_be_finite(frames[i].frame.fap);
  }
  must(std::isfinite(semblante_take_frame_rate(take)) && semblante_take_frame_rate(take) >= 0);
  for (std::uint32_t i = 0; i < semblante_take_warning_count(take); ++i) {
    semblante_take_warning warning{};
    warning.size = sizeof(warning);
    must(semblante_take_get_warning(take, i, &warning) == SEMBLANTE_OK && warning.message[0] != '\0');
  }
  // Short ones: a .fap file fills gaps with frames, up to 100,000, which an instrumented build takes half a minute for.
  const bool is_short = count > 0 && count <= 64 && last - frames[0].time <= 2000;
  for (std::uint32_t to = 0; to < 2 && is_short; ++to) {
    std::size_t needed = 0;
    semblante_error why{};
    const auto asked = semblante_take_write(to, frames, count, 0, nullptr, &needed, &why);
    if (asked != SEMBLANTE_OK && asked != SEMBLANTE_BUFFER_TOO_SMALL) {
      must(why.message[0] != '\0');
      continue;
    }
    std::string written(needed, ' ');
    must(semblante_take_write(to, frames, count, 0, written.data(), &needed, &why) == SEMBLANTE_OK &&
         needed == written.size());
    semblante_take* again = nullptr;
    // Live Link writes the time of day, and a file of one frame has no rate: those alone may be refused.
    if (semblante_take_read(to, written.data(), written.size(), nullptr, &again, &why) == SEMBLANTE_OK)
      semblante_take_destroy(again);
    else
      must(last >= 80000.0 * 1000 || count == 1);
  }
  semblante_take_destroy(take);
  return 0;
}
