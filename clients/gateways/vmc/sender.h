#pragma once

#include <cstdint>
#include <vector>

#include "core/kernel/semblante_kernel.h"

namespace semblante::vmc {

/// Options of the sent values.
struct SenderOptions {
  bool perfect_sync = true;  ///< blend values with ARKit's names
  bool vrm0 = true;          ///< blend values with the names of VRM 0's presets
  bool vrm1 = false;         ///< blend values with the names of VRM 1's presets
  bool bones = true;         ///< Neck, Head, LeftEye and RightEye; their positions are 0
};

/// Limit of a bundle: an Ethernet packet of 1500 bytes without the headers of IPv4 and UDP.
inline constexpr std::size_t max_sent_bytes = 1472;

/// Encodes one face as UDP packets of OSC bundles, to be sent in this order: OK and T (`seconds` of the sender's clock)
/// first, Apply last. The frame's FAPs must be finite.
std::vector<std::vector<std::uint8_t>> packets_of(const semblante_frame& frame, double seconds,
                                                  const SenderOptions& options);

}  // namespace semblante::vmc
