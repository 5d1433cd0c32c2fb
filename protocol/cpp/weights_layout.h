#pragma once

#include <cstddef>
#include <cstdint>

#include "core/types/moving_parts.h"

/// Layout constants shared by the encoder and the decoder of the `weights` artefact: SPEC.md, 1.3.
namespace semblante::weights_layout {

inline constexpr std::uint8_t magic[4] = {'S', 'B', 'W', 'T'};
/// Versions. 1: only the rigid motions of the eyes. 2: also irises and tongue. 3: also lids, and each vertex's share of
/// the head's rotation. The encoder uses the lowest sufficient.
inline constexpr std::uint16_t version_of_eyes = 1;
inline constexpr std::uint16_t version_of_parts = 2;
inline constexpr std::uint16_t version_of_turns = 3;
inline constexpr std::uint8_t greatest_eye_motion = 2;

/// Whether a version has this rigid motion, a valid one.
constexpr bool has_motion(std::uint16_t version, std::uint8_t motion) {
  const bool lids = motion == static_cast<std::uint8_t>(RigidMotion::left_lids) ||
                    motion == static_cast<std::uint8_t>(RigidMotion::right_lids);
  return version == version_of_turns || (!lids && (version == version_of_parts || motion <= greatest_eye_motion));
}

/// The share of a vertex that turns fully with the head, and of all vertices before the first.
inline constexpr std::uint8_t full_turn = 255;
inline constexpr int min_bits = 8;
inline constexpr int max_bits = 16;

// Offsets into the header, all little-endian.
inline constexpr std::size_t at_version = 4;
inline constexpr std::size_t at_bits = 6;
inline constexpr std::size_t at_reserved = 7;
inline constexpr std::size_t at_crc = 8;
inline constexpr std::size_t at_vertex_count = 12;
inline constexpr std::size_t at_set_count = 16;
inline constexpr std::size_t at_entry_count = 20;
inline constexpr std::size_t at_raw_bytes = 24;
inline constexpr std::size_t at_packed_bytes = 28;
inline constexpr std::size_t at_mesh_sha256 = 32;
inline constexpr std::size_t header_bytes = 64;

/// Top bit of a set's first byte: the weights of its vertices sum to exactly one, so the last is not stored.
inline constexpr std::uint8_t unit_sum_flag = 0x80;

/// Bytes per set id, stored as planes: the low bytes of all vertices, then the next, ...
constexpr int id_planes(std::uint32_t set_count) { return set_count <= 0x100U ? 1 : set_count <= 0x10000U ? 2 : 3; }
inline constexpr std::uint32_t max_set_count = 1U << 24U;

/// Bytes per weight residual, also stored as planes.
constexpr int weight_planes(int bits) { return bits <= 8 ? 1 : 2; }

/// Zigzag code of the difference modulo 2^bits, which has `bits` bits; small differences of either sign are small.
constexpr std::uint32_t fold(std::uint32_t value, std::uint32_t prediction, int bits) {
  const std::uint32_t mask = (1U << static_cast<unsigned>(bits)) - 1U;
  const std::uint32_t difference = (value - prediction) & mask;
  const bool negative = (difference >> static_cast<unsigned>(bits - 1)) != 0U;
  return negative ? 2U * (mask - difference) + 1U : 2U * difference;
}
constexpr std::uint32_t unfold(std::uint32_t folded, std::uint32_t prediction, int bits) {
  const std::uint32_t mask = (1U << static_cast<unsigned>(bits)) - 1U;
  const std::uint32_t half = folded >> 1U;
  const std::uint32_t difference = (folded & 1U) != 0U ? mask - half : half;
  return (prediction + difference) & mask;
}

}  // namespace semblante::weights_layout
