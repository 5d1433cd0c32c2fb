#include "protocol/package/mesh_slices.h"

#include <algorithm>
#include <cmath>

#include "protocol/package/quantization.h"

namespace semblante {

std::vector<Slice> slice_by_material(const RenderMesh& mesh, std::size_t material_count) {
  std::vector<Slice> slices(material_count);
  std::vector<std::uint32_t> local(mesh.positions.size());
  for (std::size_t m = 0; m < material_count; ++m) slices[m].material = static_cast<std::uint8_t>(m);
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    Slice& slice = slices[mesh.materials[v]];
    local[v] = static_cast<std::uint32_t>(slice.vertices.size());
    slice.vertices.push_back(v);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& triangle = mesh.triangles[t];
    slices[mesh.triangle_materials[t]].triangles.push_back(
        {local[triangle[0]], local[triangle[1]], local[triangle[2]]});
  }
  std::erase_if(slices, [](const Slice& s) { return s.triangles.empty(); });
  return slices;
}

namespace {

bool has_colors(const RenderMesh& mesh, const Slice& slice) {
  return !mesh.colors.empty() && std::any_of(slice.vertices.begin(), slice.vertices.end(),
                                             [&](std::uint32_t v) { return mesh.colors[v] != white; });
}

}  // namespace

std::vector<SliceAttribute> geometry_attributes(const RenderMesh& mesh, const Slice& slice) {
  using Kind = DracoAttribute::Kind;
  using Type = DracoAttribute::Type;
  std::vector<SliceAttribute> attributes;
  attributes.push_back(
      {"POSITION", Kind::position, Type::float32, 3, mesh.position_bits,
       gather<float>(slice, 3, [&](auto v, auto c) { return mesh.positions[v][static_cast<int>(c)]; })});
  if (!mesh.normals.empty()) {
    attributes.push_back(
        {"NORMAL", Kind::normal, Type::float32, 3, normal_bits,
         gather<float>(slice, 3, [&](auto v, auto c) { return mesh.normals[v][static_cast<int>(c)]; })});
  }
  if (!mesh.uvs.empty()) {
    attributes.push_back({"TEXCOORD_0", Kind::uv, Type::float32, 2, uv_bits,
                          gather<float>(slice, 2, [&](auto v, auto c) { return mesh.uvs[v][static_cast<int>(c)]; })});
  }
  if (has_colors(mesh, slice)) {
    // glTF's are linear: 16 bits keep the 256 steps of sRGB apart. The opacity only fills the row to 8 bytes, as glTF
    // wants its rows in multiples of 4.
    attributes.push_back({"COLOR_0", Kind::color, Type::uint16, 4, 0,
                          gather<std::uint16_t>(slice, 4,
                                                [&](auto v, auto c) {
                                                  if (c == 3) return std::uint16_t{0xFFFF};
                                                  const glm::vec3 linear = linear_of_srgb(mesh.colors[v]);
                                                  return static_cast<std::uint16_t>(
                                                      std::lround(65535.0F * linear[static_cast<int>(c)]));
                                                }),
                          true});
  }
  return attributes;
}

}  // namespace semblante
