#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/types/result.h"
#include "core/types/weight_table.h"
#include "protocol/cpp/sha256.h"

namespace semblante {

/// The decoded `weights` artefact of a face package: the weights of Eq. 7 per vertex of its mesh.
struct InfluenceTable {
  std::uint32_t vertex_count = 0;
  Sha256 mesh_sha256{};             ///< of the bytes of mesh.drc whose decoded vertex order this is
  WeightTable<float> rows;          ///< #V rows, weights in [0, 1]; ids rise within a row
  std::vector<std::uint8_t> rigid;  ///< #V: RigidMotion values
  std::vector<std::uint8_t> turn;   ///< #V: 255ths of the head's rotation; empty: all vertices turn fully
};

struct WeightsEncoding {
  int bits = 12;  ///< of each weight, 8..16
};

inline constexpr std::uint32_t max_weights_vertices = 4'000'000;
inline constexpr std::uint32_t max_weights_entries = 48'000'000;

/// Rows that sum to one (within 1e-5) sum to exactly one after quantization too. Asserts that the table is consistent.
std::vector<std::uint8_t> encode_weights(const InfluenceTable& table, const WeightsEncoding& encoding = {});

/// Decodes untrusted bytes: checks all declared sizes against limits before allocation.
Result<InfluenceTable> decode_weights(std::span<const std::uint8_t> bytes);

/// The largest difference of a weight between a table and its decoded encoding. Both must have the same shape.
double max_quantization_error(const InfluenceTable& table, const InfluenceTable& decoded);

}  // namespace semblante
