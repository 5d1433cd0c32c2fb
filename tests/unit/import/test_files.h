#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/import/import.h"

/// Small valid files of every format, made in memory, and the ways tests read them.
namespace semblante::test {

using Bytes = std::vector<std::uint8_t>;

Bytes to_bytes(std::string_view text);

/// Values one after another in a stated byte order.
class Packer {
 public:
  explicit Packer(std::endian order = std::endian::little) : order_(order) {}
  template <class T>
  Packer& put(T value) {
    auto raw = std::bit_cast<std::array<std::uint8_t, sizeof(T)>>(value);
    if (order_ != std::endian::native) std::reverse(raw.begin(), raw.end());
    bytes.insert(bytes.end(), raw.begin(), raw.end());
    return *this;
  }
  Bytes bytes;

 private:
  std::endian order_;
};

/// A GLB of these two chunks, padded as the format asks.
Bytes make_glb(std::string_view json, const Bytes& binary);

/// A zip of these entries (name, bytes), deflated.
Bytes make_zip(const std::vector<std::pair<std::string, Bytes>>& entries);

/// The header of a PNG, 24 bytes, and nothing of its pixels.
Bytes png_of(std::uint32_t width, std::uint32_t height);
/// One quad of two triangles at z = 0, corners (0,0) (1,0) (1,1) (0,1), indices 0 1 2 0 2 3, with uvs.
Bytes quad_obj();
Bytes quad_ply_text();
Bytes quad_ply_strips();
Bytes quad_ply_binary(std::endian order);
Bytes quad_stl_text();
Bytes quad_stl_binary();
Bytes quad_glb();
/// The JSON of quad_glb(), for tests to change, and its binary chunk.
std::string quad_gltf_json();
Bytes quad_gltf_binary();
/// The quad as KHR_draco_mesh_compression (sequential or edgebreaker), and its parts.
Bytes quad_draco_glb(bool edgebreaker);
Bytes quad_draco_data(bool edgebreaker);
std::string quad_draco_json(std::size_t draco_bytes);
/// "quad.gltf" and "quad.bin" in a folder of a zip.
Bytes quad_zip();

/// All of the above, named.
struct NamedFile {
  std::string name;
  ModelFormat format;
  Bytes bytes;
};
std::vector<NamedFile> all_quads();

/// `text` with its one occurrence of `what` replaced; fails the test when there is not exactly one.
std::string replaced(std::string text, std::string_view what, std::string_view with);

}  // namespace semblante::test
