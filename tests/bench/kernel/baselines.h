#pragma once

#include <cstddef>
#include <cstdint>

#include "core/kernel/semblante_kernel.h"

namespace semblante::bench {

/// What anyone would write first: row after row, matrices for the rotations, no thought of registers. Lids move by Eq.
/// 7 alone. Compiled as it is (-O2).
void scalar_deform(const semblante_face& face, const semblante_pose& pose, float* positions);

/// The measured limit of memory: copies `written` bytes from `read` and sums up what more of it there is
/// (`read_bytes` in all), by the widest registers. Returns the sum.
std::uint64_t stream(const std::byte* read, std::size_t read_bytes, std::byte* write, std::size_t written);

}  // namespace semblante::bench
