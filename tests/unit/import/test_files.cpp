#include "tests/unit/import/test_files.h"

#include <zip.h>

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>

#include "tests/unit/import/compressed_quads.h"

namespace semblante::test {
namespace {

constexpr std::array<std::array<float, 3>, 4> corners = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
constexpr std::array<std::array<std::uint32_t, 3>, 2> triangles = {{{0, 1, 2}, {0, 2, 3}}};

Bytes joined(std::string_view head, const Bytes& body) {
  Bytes bytes = to_bytes(head);
  bytes.insert(bytes.end(), body.begin(), body.end());
  return bytes;
}

}  // namespace

Bytes to_bytes(std::string_view text) { return {text.begin(), text.end()}; }

Bytes png_of(std::uint32_t width, std::uint32_t height) {
  Bytes png = to_bytes(std::string_view("\x89PNG\r\n\x1A\n\0\0\0\x0DIHDR", 16));
  for (const std::uint32_t side : {width, height})
    for (int shift = 24; shift >= 0; shift -= 8) png.push_back(static_cast<std::uint8_t>(side >> shift));
  return png;
}

Bytes make_glb(std::string_view json, const Bytes& binary) {
  std::string text(json);
  while (text.size() % 4 != 0) text += ' ';
  Bytes padded = binary;
  while (padded.size() % 4 != 0) padded.push_back(0);
  Packer glb;
  glb.put(0x46546C67U).put(2U);
  glb.put(static_cast<std::uint32_t>(12 + 8 + text.size() + (padded.empty() ? 0 : 8 + padded.size())));
  glb.put(static_cast<std::uint32_t>(text.size())).put(0x4E4F534AU);
  glb.bytes.insert(glb.bytes.end(), text.begin(), text.end());
  if (!padded.empty()) {
    glb.put(static_cast<std::uint32_t>(padded.size())).put(0x004E4942U);
    glb.bytes.insert(glb.bytes.end(), padded.begin(), padded.end());
  }
  return glb.bytes;
}

Bytes make_zip(const std::vector<std::pair<std::string, Bytes>>& entries) {
  zip_error_t fault;
  zip_error_init(&fault);
  zip_source_t* const sink = zip_source_buffer_create(nullptr, 0, 0, &fault);
  zip_source_keep(sink);
  zip_t* const archive = zip_open_from_source(sink, ZIP_TRUNCATE, &fault);
  for (const auto& [name, bytes] : entries) {
    zip_source_t* const source = zip_source_buffer(archive, bytes.data(), bytes.size(), 0);
    const zip_int64_t index = zip_file_add(archive, name.c_str(), source, ZIP_FL_ENC_UTF_8);
    EXPECT_GE(index, 0) << name;
    // A fixed time keeps the bytes the same from run to run.
    zip_file_set_mtime(archive, static_cast<zip_uint64_t>(index), 1'000'000'000, 0);
  }
  EXPECT_EQ(zip_close(archive), 0);
  zip_source_open(sink);
  zip_source_seek(sink, 0, SEEK_END);
  Bytes bytes(static_cast<std::size_t>(zip_source_tell(sink)));
  zip_source_seek(sink, 0, SEEK_SET);
  EXPECT_EQ(zip_source_read(sink, bytes.data(), bytes.size()), static_cast<zip_int64_t>(bytes.size()));
  zip_source_close(sink);
  zip_source_free(sink);
  zip_error_fini(&fault);
  return bytes;
}

Bytes quad_obj() {
  return to_bytes(
      "# a quad\nmtllib quad.mtl\no quad\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
      "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\nusemtl skin\nf 1/1/1 2/2/1 3/3/1 4/4/1\n");
}

Bytes quad_ply_text() {
  return to_bytes(
      "ply\nformat ascii 1.0\ncomment a quad\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "property float s\nproperty float t\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n4 0 1 2 3\n");
}

Bytes quad_ply_strips() {
  return to_bytes(
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "property float s\nproperty float t\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n7 0 1 2 -1 0 2 3\n");
}

Bytes quad_ply_binary(std::endian order) {
  const std::string head =
      std::string("ply\nformat ") + (order == std::endian::big ? "binary_big_endian" : "binary_little_endian") +
      " 1.0\nelement vertex 4\nproperty double x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty uchar flags\nproperty list uchar ushort vertex_index\nend_header\n";
  Packer body(order);
  for (const auto& [x, y, z] : corners) body.put(static_cast<double>(x)).put(y).put(z);
  body.put(std::uint8_t{7}).put(std::uint8_t{4});
  for (std::uint16_t i = 0; i < 4; ++i) body.put(i);
  return joined(head, body.bytes);
}

Bytes quad_stl_text() {
  std::string text = "solid quad\n";
  for (const auto& triangle : triangles) {
    text += " facet normal 0 0 1\n  outer loop\n";
    for (const std::uint32_t index : triangle) {
      text += "   vertex " + std::to_string(corners[index][0]) + " " + std::to_string(corners[index][1]) + " 0.0\n";
    }
    text += "  endloop\n endfacet\n";
  }
  return to_bytes(text + "endsolid quad\n");
}

Bytes quad_stl_binary() {
  Packer stl;
  stl.bytes.assign(80, ' ');
  stl.put(static_cast<std::uint32_t>(triangles.size()));
  for (const auto& triangle : triangles) {
    stl.put(0.0F).put(0.0F).put(1.0F);
    for (const std::uint32_t index : triangle) {
      for (const float value : corners[index]) stl.put(value);
    }
    stl.put(std::uint16_t{0});
  }
  return stl.bytes;
}

std::string quad_gltf_json() {
  // positions: 48 bytes at 0; uvs: 32 at 48; indices: 6 u16 at 80.
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"name":"quad","primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2,"material":0}]}],
"materials":[{"name":"skin","pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,0.125,1]}}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
{"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"},
{"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":32},
{"buffer":0,"byteOffset":80,"byteLength":12}],
"buffers":[{"byteLength":92}]})";
}

Bytes quad_gltf_binary() {
  Packer binary;
  for (const auto& corner : corners) {
    for (const float value : corner) binary.put(value);
  }
  for (const auto& [x, y, z] : corners) binary.put(x).put(1.0F - y);
  for (const auto& triangle : triangles) {
    for (const std::uint32_t index : triangle) binary.put(static_cast<std::uint16_t>(index));
  }
  return binary.bytes;
}

Bytes quad_glb() { return make_glb(quad_gltf_json(), quad_gltf_binary()); }

Bytes quad_draco_data(bool edgebreaker) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(static_cast<int>(triangles.size()));
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  for (std::uint32_t f = 0; f < triangles.size(); ++f) {
    builder.SetAttributeValuesForFace(position, draco::FaceIndex(f), corners[triangles[f][0]].data(),
                                      corners[triangles[f][1]].data(), corners[triangles[f][2]].data());
  }
  const auto mesh = builder.Finalize();
  draco::Encoder encoder;
  encoder.SetEncodingMethod(edgebreaker ? draco::MESH_EDGEBREAKER_ENCODING : draco::MESH_SEQUENTIAL_ENCODING);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
  return {buffer.data(), buffer.data() + buffer.size()};
}

std::string quad_draco_json(std::size_t draco_bytes) {
  const std::string size = std::to_string(draco_bytes);
  return R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_draco_mesh_compression"],
"extensionsRequired":["KHR_draco_mesh_compression"],"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,
"extensions":{"KHR_draco_mesh_compression":{"bufferView":0,"attributes":{"POSITION":0}}}}]}],
"accessors":[{"componentType":5126,"count":4,"type":"VEC3"},{"componentType":5123,"count":6,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":)" +
         size + R"(}],"buffers":[{"byteLength":)" + size + "}]}";
}

Bytes quad_draco_glb(bool edgebreaker) {
  const Bytes data = quad_draco_data(edgebreaker);
  return make_glb(quad_draco_json(data.size()), data);
}

Bytes quad_zip() {
  const std::string json = replaced(quad_gltf_json(), R"({"byteLength":92})", R"({"byteLength":92,"uri":"quad.bin"})");
  return make_zip({{"head/quad.gltf", to_bytes(json)}, {"head/quad.bin", quad_gltf_binary()}});
}

std::vector<NamedFile> all_quads() {
  return {{"obj", ModelFormat::obj, quad_obj()},
          {"ply_text", ModelFormat::ply, quad_ply_text()},
          {"ply_little", ModelFormat::ply, quad_ply_binary(std::endian::little)},
          {"ply_big", ModelFormat::ply, quad_ply_binary(std::endian::big)},
          {"ply_strips", ModelFormat::ply, quad_ply_strips()},
          {"stl_text", ModelFormat::stl, quad_stl_text()},
          {"stl_binary", ModelFormat::stl, quad_stl_binary()},
          {"glb", ModelFormat::glb, quad_glb()},
          {"draco_sequential", ModelFormat::glb, quad_draco_glb(false)},
          {"draco_edgebreaker", ModelFormat::glb, quad_draco_glb(true)},
          {"meshopt_triangles", ModelFormat::glb, compressed_quad(true).glb()},
          {"meshopt_indices", ModelFormat::glb, compressed_quad(false).glb()},
          {"quantized", ModelFormat::glb, quantized_quad().glb()},
          {"webp", ModelFormat::glb, webp_quad().glb()},
          {"zip", ModelFormat::gltf_zip, quad_zip()}};
}

std::string replaced(std::string text, std::string_view what, std::string_view with) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << "no " << what;
  if (at == std::string::npos) return text;
  EXPECT_EQ(text.find(what, at + 1), std::string::npos) << "more than one " << what;
  return text.replace(at, what.size(), with);
}

}  // namespace semblante::test
