#include "tests/unit/import/compressed_quads.h"

#include <meshoptimizer.h>

#include "tests/unit/import/webp_images.h"

namespace semblante::test {

std::size_t compressed_view(GltfWriter& writer, const Bytes& encoded, std::size_t count, std::size_t stride,
                            const char* mode, const char* filter) {
  const std::size_t at = writer.view(encoded);
  auto& view = writer.json["bufferViews"][at];
  const nlohmann::json place = view;
  nlohmann::json extension = {{"buffer", 0},
                              {"byteOffset", place["byteOffset"]},
                              {"byteLength", encoded.size()},
                              {"byteStride", stride},
                              {"count", count},
                              {"mode", mode}};
  if (filter != nullptr) extension["filter"] = filter;
  view = {{"buffer", 1},
          {"byteOffset", 0},
          {"byteLength", count * stride},
          {"extensions", {{"EXT_meshopt_compression", extension}}}};
  if (std::string_view(mode) == "ATTRIBUTES") view["byteStride"] = stride;
  return at;
}

Bytes encoded_vertices(const Bytes& bytes, std::size_t stride) {
  const std::size_t count = bytes.size() / stride;
  Bytes encoded(meshopt_encodeVertexBufferBound(count, stride));
  encoded.resize(meshopt_encodeVertexBuffer(encoded.data(), encoded.size(), bytes.data(), count, stride));
  return encoded;
}

Bytes encoded_triangles(const std::vector<std::uint32_t>& indices, std::size_t vertex_count) {
  Bytes bytes(meshopt_encodeIndexBufferBound(indices.size(), vertex_count));
  bytes.resize(meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), indices.data(), indices.size()));
  return bytes;
}

Bytes encoded_sequence(const std::vector<std::uint32_t>& indices, std::size_t vertex_count) {
  Bytes bytes(meshopt_encodeIndexSequenceBound(indices.size(), vertex_count));
  bytes.resize(meshopt_encodeIndexSequence(bytes.data(), bytes.size(), indices.data(), indices.size()));
  return bytes;
}

GltfWriter compressed_quad(bool as_triangles) {
  GltfWriter writer;
  writer.json["extensionsUsed"] = {"EXT_meshopt_compression", "KHR_mesh_quantization"};
  writer.json["extensionsRequired"] = {"EXT_meshopt_compression", "KHR_mesh_quantization"};
  const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  writer.primitive()["attributes"]["POSITION"] =
      writer.accessor(compressed_view(writer, encoded_vertices(positions, 12), 4, 12, "ATTRIBUTES"), f32, 4, "VEC3");
  const std::vector<float> normals = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0.6F, 0.8F, 0, -0.48F, 0.6F, -0.64F, 0};
  std::vector<std::int8_t> octahedral(16);
  meshopt_encodeFilterOct(octahedral.data(), 4, 4, 8, normals.data());
  writer.primitive()["attributes"]["NORMAL"] = writer.accessor(
      compressed_view(writer, encoded_vertices(octahedral, 4), 4, 4, "ATTRIBUTES", "OCTAHEDRAL"), i8, 4, "VEC3", true);
  const std::vector<std::uint32_t> indices = {0, 1, 2, 0, 2, 3};
  const Bytes encoded = as_triangles ? encoded_triangles(indices, 4) : encoded_sequence(indices, 4);
  writer.primitive()["indices"] =
      writer.accessor(compressed_view(writer, encoded, 6, 2, as_triangles ? "TRIANGLES" : "INDICES"), u16, 6, "SCALAR");
  writer.json["buffers"] = {nlohmann::json::object(),
                            {{"byteLength", 256}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
  return writer;
}

GltfWriter quantized_quad() {
  GltfWriter writer;
  writer.json["extensionsUsed"] = {"KHR_mesh_quantization"};
  writer.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  const std::vector<std::uint16_t> positions = {0, 0, 0, 0, 1000, 0, 0, 0, 1000, 1000, 0, 0, 0, 1000, 0, 0};
  writer.primitive()["attributes"]["POSITION"] = writer.accessor(writer.view(bytes_of(positions), 8), u16, 4, "VEC3");
  const std::vector<std::int8_t> normals = {0, 0, 127, 0, 0, 0, 127, 0, 0, 90, 90, 0, -127, 0, 0, 0};
  writer.primitive()["attributes"]["NORMAL"] = writer.accessor(writer.view(bytes_of(normals), 4), i8, 4, "VEC3", true);
  const auto index_view = writer.view(Bytes{1, 3});
  const auto value_view = writer.view(Bytes{0, 100, 0, 50, 0, 0});
  writer.json["accessors"].push_back({{"componentType", u8},
                                      {"count", 4},
                                      {"type", "VEC3"},
                                      {"sparse",
                                       {{"count", 2},
                                        {"indices", {{"bufferView", index_view}, {"componentType", u8}}},
                                        {"values", {{"bufferView", value_view}}}}}});
  writer.primitive()["targets"] = {{{"POSITION", writer.json["accessors"].size() - 1}}};
  writer.json["meshes"][0]["extras"] = {{"targetNames", {"smile"}}};
  writer.primitive()["indices"] = writer.indices({0, 1, 2, 0, 2, 3});
  writer.json["nodes"][0]["scale"] = {0.001, 0.001, 0.001};
  return writer;
}

GltfWriter quad_with_texture(const nlohmann::json& texture, const std::vector<Bytes>& images) {
  GltfWriter writer;
  writer.add_quad();
  writer.primitive()["material"] = 0;
  writer.json["materials"].push_back({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  writer.json["textures"] = nlohmann::json::array({texture});
  for (const Bytes& image : images) writer.json["images"].push_back({{"bufferView", writer.view(image)}});
  return writer;
}

GltfWriter webp_quad() {
  GltfWriter writer = quad_with_texture({{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}}, {lossless_webp});
  writer.json["extensionsRequired"].push_back("EXT_texture_webp");
  return writer;
}

}  // namespace semblante::test
