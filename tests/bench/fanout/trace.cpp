#include "tests/bench/fanout/trace.h"

#include <cmath>

#include "protocol/cpp/fap_ranges.h"

namespace semblante::bench {
namespace {

std::int16_t sine(std::uint64_t number, double frames, double amplitude, double phase) {
  const double angle = 2.0 * 3.14159265358979 * static_cast<double>(number) / frames + phase;
  return static_cast<std::int16_t>(std::lround(amplitude * std::sin(angle)));
}

std::uint32_t mixed(std::uint64_t value) {  // splitmix64
  value += 0x9e3779b97f4a7c15U;
  value = (value ^ (value >> 30U)) * 0xbf58476d1ce4e5b9U;
  value = (value ^ (value >> 27U)) * 0x94d049bb133111ebU;
  return static_cast<std::uint32_t>(value >> 32U);
}

}  // namespace

FaceFrame trace_frame(std::uint64_t number, bool heavy) {
  FaceFrame frame;
  frame.viseme.select1 = static_cast<std::uint8_t>(mixed(number / 3) % 15);
  frame.viseme.select2 = static_cast<std::uint8_t>(mixed(number / 3 + 1) % 15);
  frame.viseme.blend = static_cast<std::uint8_t>(63 - number % 3 * 21);
  frame.expression = {1, static_cast<std::uint8_t>(20 + number / 25 % 40), 0, 0};
  for (std::size_t fap = 31; fap <= 36; ++fap)
    frame.level[fap] = sine(number, 90.0, 40.0, static_cast<double>(fap % 2) * 0.2);
  if (const auto lid = number % 100; lid < 6) frame.level[19] = frame.level[20] = sine(lid, 12.0, 900.0, 0.0);
  frame.level[23] = frame.level[24] = static_cast<std::int16_t>(mixed(number / 20) % 80);
  frame.level[48] = sine(number, 140.0, 30.0, 0.0);
  frame.level[49] = sine(number, 190.0, 50.0, 1.0);
  frame.level[50] = sine(number, 240.0, 20.0, 2.0);
  if (heavy)
    for (std::size_t fap = first_low_level_fap; fap <= last_low_level_fap; ++fap)
      frame.level[fap] = static_cast<std::int16_t>(mixed(number * 69 + fap) % 400) - 200;
  clamp_to_ranges(frame);
  return frame;
}

}  // namespace semblante::bench
