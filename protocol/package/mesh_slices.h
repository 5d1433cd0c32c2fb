#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "core/draco/draco_encode.h"
#include "core/types/model.h"
#include "protocol/package/render_mesh.h"

namespace semblante {

/// One glTF primitive: the vertices and triangles of one material.
struct Slice {
  std::uint8_t material = 0;
  std::vector<std::uint32_t> vertices;  ///< render vertices, rising
  std::vector<Triangle> triangles;      ///< into `vertices`
};

std::vector<Slice> slice_by_material(const RenderMesh& mesh, std::size_t material_count);

/// Gathers per-vertex data of a slice into one tightly packed block.
template <class T, class Get>
std::vector<std::byte> gather(const Slice& slice, std::size_t components, Get get) {
  std::vector<std::byte> bytes(slice.vertices.size() * components * sizeof(T));
  std::byte* out = bytes.data();
  for (const std::uint32_t vertex : slice.vertices) {
    for (std::size_t c = 0; c < components; ++c, out += sizeof(T)) {
      const T value = get(vertex, c);
      std::memcpy(out, &value, sizeof(T));
    }
  }
  return bytes;
}

/// A named attribute of a slice, for both kinds of primitives.
struct SliceAttribute {
  std::string name;
  DracoAttribute::Kind kind;
  DracoAttribute::Type type;
  int components;
  int quantization_bits;
  std::vector<std::byte> bytes;
  bool normalized = false;  ///< integers that represent 0..1
};

/// POSITION, NORMAL, TEXCOORD_0 and COLOR_0, if the mesh has them.
std::vector<SliceAttribute> geometry_attributes(const RenderMesh& mesh, const Slice& slice);

}  // namespace semblante
