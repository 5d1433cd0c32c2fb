#include "protocol/package/packed_face.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/draco/draco_mesh.h"
#include "protocol/cpp/rig_material.h"
#include "protocol/hash/sha256.h"

namespace semblante {
namespace {

Result<Image> take_image(const RigDocument::ImageInfo& info, const FaceParts& parts) {
  const std::string name = "image " + to_hex(info.sha256);
  if (!parts.image) return Error{ErrorCode::missing, name, "the package names an image that is not given"};
  auto bytes = parts.image(info.sha256);
  if (!bytes) return bytes.error();
  if (sha256(*bytes) != info.sha256) return Error{ErrorCode::mismatch, name, "has other content than its hash"};
  return Image{info.mime_type, std::move(*bytes)};
}

/// An attribute of mesh.drc named by rig.json; empty when it names none.
template <class T>
Status take(const std::optional<std::uint32_t>& id, const DracoMesh& mesh,
            Result<std::vector<T>> (DracoMesh::*read)(std::uint32_t) const, std::vector<T>& out) {
  if (!id) return Unit{};
  auto values = (mesh.*read)(*id);
  if (!values) return Error{values.error().code, "mesh.drc", values.error().message};
  out = std::move(*values);
  return Unit{};
}

Result<RenderMesh> take_mesh(const FaceParts& parts, const RigDocument& rig) {
  const auto decoded = DracoMesh::decode(parts.mesh_drc, {rig.mesh.vertices, rig.mesh.triangles});
  if (!decoded) return Error{decoded.error().code, "mesh.drc", decoded.error().message};
  if (decoded->point_count() != rig.mesh.vertices || decoded->triangle_count() != rig.mesh.triangles) {
    return Error{ErrorCode::mismatch, "mesh.drc", "has other counts than rig.json says"};
  }
  const RigDocument::Attributes& ids = rig.mesh.attributes;
  if (!ids.position) return Error{ErrorCode::missing, "rig.json", "names no positions in mesh.drc"};
  RenderMesh mesh;
  for (const Status& taken : {take(ids.position, *decoded, &DracoMesh::vectors3, mesh.positions),
                              take(ids.normal, *decoded, &DracoMesh::vectors3, mesh.normals),
                              take(ids.uv, *decoded, &DracoMesh::vectors2, mesh.uvs),
                              take(ids.material, *decoded, &DracoMesh::bytes, mesh.materials),
                              take(ids.color, *decoded, &DracoMesh::colors, mesh.colors)}) {
    if (!taken) return taken.error();
  }
  for (glm::vec3& normal : mesh.normals) {  // octahedral coordinates are quantized, glTF requires unit length
    const float length = std::sqrt(normal.x * normal.x + normal.y * normal.y + normal.z * normal.z);
    normal = length > 0.0F ? normal / length : glm::vec3(0.0F, 0.0F, 1.0F);
  }
  mesh.materials.resize(mesh.positions.size());
  mesh.triangles = decoded->triangles();
  for (const Triangle& triangle : mesh.triangles) {
    const std::uint8_t material = mesh.materials[triangle[0]];
    if (material >= rig.materials.size() || mesh.materials[triangle[1]] != material ||
        mesh.materials[triangle[2]] != material) {
      return Error{ErrorCode::mismatch, "mesh.drc", "a triangle has no one material of rig.json"};
    }
    mesh.triangle_materials.push_back(material);
  }
  for (std::uint8_t& material : mesh.materials)  // of a vertex without a triangle
    material = std::min(material, static_cast<std::uint8_t>(rig.materials.size() - 1));
  return mesh;
}

}  // namespace

Result<PackedFace> open_package(const FaceParts& parts) {
  auto rig = read_rig(parts.rig_json);
  if (!rig) return Error{rig.error().code, "rig.json" + rig.error().where, rig.error().message};
  auto table = decode_weights(parts.weights);
  if (!table) return Error{table.error().code, "weights" + table.error().where, table.error().message};
  const Sha256 mesh_hash = sha256(parts.mesh_drc);
  if (rig->mesh.sha256 != mesh_hash)
    return Error{ErrorCode::mismatch, "mesh.drc", "is not the mesh that rig.json names"};
  if (table->mesh_sha256 != mesh_hash)
    return Error{ErrorCode::mismatch, "weights", "belong to another mesh than mesh.drc"};
  auto mesh = take_mesh(parts, *rig);
  if (!mesh) return mesh.error();
  if (table->vertex_count != mesh->positions.size())
    return Error{ErrorCode::mismatch, "weights", "have another number of vertices than mesh.drc"};

  PackedFace face;
  face.mesh = std::move(*mesh);
  face.table = std::move(*table);
  for (const RigDocument::MaterialInfo& info : rig->materials) face.materials.push_back(material_of(info, rig->images));
  for (const RigDocument::ImageInfo& info : rig->images) {
    auto image = take_image(info, parts);
    if (!image) return image.error();
    face.images.push_back(std::move(*image));
  }
  face.rig = std::move(*rig);
  return face;
}

}  // namespace semblante
