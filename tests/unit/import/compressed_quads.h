#pragma once

#include "tests/unit/import/gltf_writer.h"

namespace semblante::test {

/// A buffer view of EXT_meshopt_compression in buffer 0, whose fallback buffer 1 is not there; gives its number.
std::size_t compressed_view(GltfWriter& writer, const Bytes& encoded, std::size_t count, std::size_t stride,
                            const char* mode, const char* filter = nullptr);

/// Streams by the library's own encoder. `bytes` holds whole elements of `stride` bytes.
Bytes encoded_vertices(const Bytes& bytes, std::size_t stride);
template <class T>
Bytes encoded_vertices(const std::vector<T>& values, std::size_t stride) {
  return encoded_vertices(bytes_of(values), stride);
}
Bytes encoded_triangles(const std::vector<std::uint32_t>& indices, std::size_t vertex_count);
Bytes encoded_sequence(const std::vector<std::uint32_t>& indices, std::size_t vertex_count);

/// The quad, all of it compressed: positions, normals by the octahedral filter, indices as triangles or a sequence.
GltfWriter compressed_quad(bool as_triangles);
/// The quad by KHR_mesh_quantization: shorts made whole by the node, byte normals, a sparse morph target of bytes.
GltfWriter quantized_quad();
/// The quad with this texture, an object of glTF, as its base colour, over these images.
GltfWriter quad_with_texture(const nlohmann::json& texture, const std::vector<Bytes>& images);
/// The quad with a WebP by EXT_texture_webp, which the file requires.
GltfWriter webp_quad();

}  // namespace semblante::test
