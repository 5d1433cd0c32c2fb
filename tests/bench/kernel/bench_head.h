#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/expressions/kernel_rig.h"
#include "core/kernel/semblante_kernel.h"
#include "core/parametrize/surface_weights.h"
#include "core/types/model.h"

namespace semblante::bench {

/// A head as a client has it: out of a face package, vertices in decoded order, weights quantized and read back.
struct BenchHead {
  std::string name;
  KernelRig rig;
  std::vector<float> rest;             ///< #V by 3
  std::vector<std::uint32_t> offsets;  ///< #V + 1
  std::vector<std::uint8_t> points;    ///< #entries
  std::vector<float> weights;          ///< #entries
  std::vector<std::uint8_t> rigid;     ///< #V
  std::vector<std::uint8_t> turn;      ///< #V: 255ths of the head's rotation
  std::vector<Triangle> triangles;     ///< #T by 3

  [[nodiscard]] std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(rigid.size()); }
  [[nodiscard]] semblante_face face() const;
};

/// Our own head, every triangle cut into four `cuts` times and its weights computed on the result.
BenchHead sample_bench_head(WeightMethod method, unsigned cuts);

/// The real heads, where their folder is.
std::vector<BenchHead> real_bench_heads(WeightMethod method);

/// A vowel in a smile with raised brows; with the head and the eyes turned too, or not.
semblante_pose talking_pose(const BenchHead& head, bool head_and_eyes);

/// The head in words and numbers for a program in another language: magic "SBH2", then as little-endian uint32 #V,
/// #entries, #T; rest, offsets, weights, triangles and a semblante_pose (4 bytes each), points, rigid and turn (1 byte
/// each).
void write_bench_head(const BenchHead& head, const std::string& file);

}  // namespace semblante::bench
