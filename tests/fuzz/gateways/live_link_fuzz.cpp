#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "clients/gateways/livelink/packet.h"
#include "clients/gateways/livelink/receiver.h"
#include "core/tables/mpeg4.h"

using namespace semblante;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto packet = livelink::read_packet({data, size});
  livelink::Receiver receiver("");
  const auto taken = receiver.take({data, size}, 0.0);
  if (packet.ok() != taken.ok()) std::abort();
  if (!packet) return 0;
  if (size > livelink::max_packet_bytes) std::abort();
  if (packet->face.has_value() != (*taken).has_value()) std::abort();
  if (packet->seconds && !std::isfinite(*packet->seconds)) std::abort();
  if (!*taken) return 0;
  for (const mpeg4::Fap& fap : mpeg4::faps) {
    if (fap.number < 3) continue;
    const float value = (*taken)->frame.fap[fap.number];
    if (!(value >= static_cast<float>(fap.min()) && value <= static_cast<float>(fap.max()))) std::abort();
  }
  return 0;
}
