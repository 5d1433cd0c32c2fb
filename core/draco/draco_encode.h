#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/types/model.h"
#include "core/types/result.h"

namespace semblante {

/// One attribute of a mesh to be Draco-encoded. `values` holds #values by `components` numbers of `type`, tightly
/// packed; `value_of_point` maps each point to its value (empty: point i has value i). Points of a UV seam
/// share their position value, so that Draco does not treat the seam as a border of the mesh.
struct DracoAttribute {
  enum class Kind : std::uint8_t { position, normal, uv, color, generic };
  enum class Type : std::uint8_t { float32, uint8, uint16, uint32 };

  Kind kind = Kind::generic;
  Type type = Type::float32;
  int components = 1;
  std::span<const std::byte> values;
  std::span<const std::uint32_t> value_of_point;
  int quantization_bits = 0;  ///< 0: exact
};

/// Edgebreaker-encodes a mesh. Attribute i gets Draco unique id i. `speed` 0 (small) .. 10 (fast).
Result<std::vector<std::uint8_t>> encode_draco(std::size_t point_count, std::span<const Triangle> triangles,
                                               std::span<const DracoAttribute> attributes, int speed = 5);

}  // namespace semblante
