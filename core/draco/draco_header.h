#pragma once

#include <cstdint>
#include <span>

#include "core/types/result.h"

namespace semblante {

struct DracoCounts {
  std::uint64_t faces = 0;
  std::uint64_t points = 0;  ///< edgebreaker: before seams split them
};

/// The counts that a stream begins with, without decoding it: Draco allocates by them, so they are checked first. Reads
/// triangle meshes of bitstream 2.2: what Draco writes, and the one version that KHR_draco_mesh_compression allows.
Result<DracoCounts> announced_counts(std::span<const std::uint8_t> bytes);

}  // namespace semblante
