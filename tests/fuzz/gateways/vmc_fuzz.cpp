// The input is packets, each after its length in two bytes, big-endian.

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "clients/gateways/vmc/receiver.h"
#include "core/tables/mpeg4.h"

using namespace semblante;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  vmc::Receiver receiver;
  double arrival = 0.0;
  while (size >= 2) {
    const std::size_t length = std::min<std::size_t>(data[0] << 8U | data[1], size - 2);
    const auto taken = receiver.take({data + 2, length}, arrival += 0.3);
    data += 2 + length;
    size -= 2 + length;
    if (!taken || !*taken) continue;
    const semblante_frame& frame = (*taken)->frame;
    for (const mpeg4::Fap& fap : mpeg4::faps) {
      if (fap.number < 3) continue;
      const float value = frame.fap[fap.number];
      if (!(value >= static_cast<float>(fap.min()) && value <= static_cast<float>(fap.max()))) std::abort();
    }
    if (frame.viseme1 > 14 || frame.viseme2 > 14 || frame.viseme_blend > 63) std::abort();
    if (frame.expression1 > 6 || frame.expression2 > 6 || frame.intensity1 > 63 || frame.intensity2 > 63) std::abort();
  }
  return 0;
}
