#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/types/model.h"
#include "core/types/result.h"

namespace semblante {

/// One attribute of a mesh to be Draco-encoded. `values` holds #values by `components` numbers of `type`, tightly
/// packed; `value_of_point` maps each point to its value (empty: point i has value i). Sharing values across points is
/// what tells Draco that a UV seam is not a hole.
struct DracoAttribute {
  enum class Kind : std::uint8_t { position, normal, uv, generic };
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

/// The attributes to read beside POSITION, by Draco unique id.
struct DecodedAttributes {
  std::optional<std::uint32_t> normal = std::nullopt;
  std::optional<std::uint32_t> uv = std::nullopt;
  std::optional<std::uint32_t> material = std::nullopt;
  std::optional<std::uint32_t> file_vertex = std::nullopt;
};

/// A decoded mesh: what a client will see. What was not asked for is empty.
struct DecodedMesh {
  std::size_t point_count = 0;
  std::vector<Triangle> triangles;         ///< corners are below point_count
  std::vector<float> positions;            ///< #points by 3
  std::vector<float> normals;              ///< #points by 3
  std::vector<float> uvs;                  ///< #points by 2
  std::vector<std::uint8_t> materials;     ///< #points
  std::vector<std::uint32_t> file_vertex;  ///< #points
};

/// Decodes `bytes` and reads POSITION and what is asked for.
Result<DecodedMesh> decode_draco(std::span<const std::uint8_t> bytes, const DecodedAttributes& wanted = {});

}  // namespace semblante
