#include "protocol/package/glb_writer.h"

#include <algorithm>
#include <string>

#include "protocol/package/gltf_builder.h"
#include "protocol/package/mesh_slices.h"

namespace semblante {
namespace {

constexpr int weights_bits = 12;

std::vector<SliceAttribute> influence_attributes(const Slice& slice, const GlbFace& face) {
  using Kind = DracoAttribute::Kind;
  using Type = DracoAttribute::Type;
  std::size_t most = 0;
  for (const std::uint32_t v : slice.vertices) most = std::max(most, face.rows->points_of(v).size());
  std::vector<SliceAttribute> attributes;
  for (std::size_t set = 0; set * 4 < most; ++set) {
    const auto at = [&](std::size_t c) { return set * 4 + c; };
    attributes.push_back({"_FP_INDEX_" + std::to_string(set), Kind::generic, Type::uint8, 4, 0,
                          gather<std::uint8_t>(slice, 4, [&](auto v, auto c) {
                            const auto row = face.rows->points_of(v);
                            return at(c) < row.size() ? row[at(c)].value() : std::uint8_t{0};
                          })});
    attributes.push_back({"_FP_WEIGHT_" + std::to_string(set), Kind::generic, Type::float32, 4, weights_bits,
                          gather<float>(slice, 4, [&](auto v, auto c) {
                            const auto row = face.rows->weights_of(v);
                            return at(c) < row.size() ? row[at(c)] : 0.0F;
                          })});
  }
  attributes.push_back({"_RIGID", Kind::generic, Type::uint8, 1, 0,
                        gather<std::uint8_t>(slice, 1, [&](auto v, auto) { return face.rigid[v]; })});
  if (!face.turn.empty()) {
    attributes.push_back({"_TURN", Kind::generic, Type::uint8, 1, 0,
                          gather<std::uint8_t>(slice, 1, [&](auto v, auto) { return face.turn[v]; })});
  }
  return attributes;
}

}  // namespace

Result<std::vector<std::uint8_t>> write_face_glb(const RenderMesh& mesh, const std::vector<Material>& materials,
                                                 const std::vector<Image>& images, const GlbFace& face) {
  GltfBuilder document(materials, images);
  for (const Slice& slice : slice_by_material(mesh, materials.size())) {
    std::vector<SliceAttribute> attributes = geometry_attributes(mesh, slice);
    for (SliceAttribute& attribute : influence_attributes(slice, face)) attributes.push_back(std::move(attribute));
    const Status added = document.add_draco_primitive(slice, attributes);
    if (!added) return added.error();
  }
  document.set_rig(face.rig_json);
  return document.finish();
}

Result<std::vector<std::uint8_t>> write_preview_glb(const RenderMesh& mesh, const std::vector<Material>& materials,
                                                    const std::vector<Image>& images,
                                                    std::span<const std::uint32_t> part_of) {
  GltfBuilder document(materials, images);
  for (const Slice& slice : slice_by_material(mesh, materials.size())) {
    std::vector<SliceAttribute> attributes = geometry_attributes(mesh, slice);
    attributes.push_back(
        {"_FILE_VERTEX", DracoAttribute::Kind::generic, DracoAttribute::Type::float32, 1, 0,
         gather<float>(slice, 1, [&](auto v, auto) { return static_cast<float>(mesh.file_vertex[v]); })});
    attributes.push_back({"_PART", DracoAttribute::Kind::generic, DracoAttribute::Type::float32, 1, 0,
                          gather<float>(slice, 1, [&](auto v, auto) { return static_cast<float>(part_of[v]); })});
    document.add_plain_primitive(slice, attributes);
  }
  return document.finish();
}

}  // namespace semblante
