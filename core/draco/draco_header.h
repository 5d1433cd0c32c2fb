#pragma once

#include <cstdint>
#include <span>

#include "core/types/result.h"

namespace semblante {

struct DracoCounts {
  std::uint64_t faces = 0;
  std::uint64_t points = 0;  ///< edgebreaker: the number before seams split points
};

/// The numbers of faces and points that a stream declares, without decoding it. Draco allocates memory by these
/// numbers, so they are checked first. Supports triangle meshes of bitstream 2.2, the version that Draco writes and the
/// only one that KHR_draco_mesh_compression allows.
Result<DracoCounts> announced_counts(std::span<const std::uint8_t> bytes);

}  // namespace semblante
