#include "protocol/package/packed_face.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "protocol/hash/sha256.h"
#include "protocol/package/draco_mesh.h"

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

Material take_material(const RigDocument::MaterialInfo& info, const std::vector<RigDocument::ImageInfo>& images) {
  const auto index_of = [&](const std::optional<Sha256>& hash) {
    if (!hash) return -1;
    const auto at =
        std::find_if(images.begin(), images.end(), [&](const auto& image) { return image.sha256 == *hash; });
    return at == images.end() ? -1 : static_cast<int>(at - images.begin());
  };
  Material out;
  out.name = info.name;
  out.base_color = info.base_color;
  out.metallic = info.metallic;
  out.roughness = info.roughness;
  out.alpha_mode = static_cast<Material::AlphaMode>(info.alpha_mode);
  out.alpha_cutoff = info.alpha_cutoff;
  out.double_sided = info.double_sided;
  out.base_color_image = index_of(info.base_color_image);
  out.normal_image = index_of(info.normal_image);
  return out;
}

std::vector<glm::vec3> as_vectors(const std::vector<float>& values) {
  std::vector<glm::vec3> out(values.size() / 3);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = {values[i * 3], values[i * 3 + 1], values[i * 3 + 2]};
  return out;
}

Result<RenderMesh> take_mesh(const FaceParts& parts, const RigDocument& rig) {
  DecodedAttributes wanted;
  wanted.normal = rig.mesh.attributes.normal;
  wanted.uv = rig.mesh.attributes.uv;
  wanted.material = rig.mesh.attributes.material;
  auto decoded = decode_draco(parts.mesh_drc, wanted);
  if (!decoded) return decoded.error();
  if (decoded->point_count != rig.mesh.vertices || decoded->triangles.size() != rig.mesh.triangles) {
    return Error{ErrorCode::mismatch, "mesh.drc", "has other counts than rig.json says"};
  }
  const auto finite = [](const std::vector<float>& values) {
    return std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
  };
  if (!finite(decoded->positions) || !finite(decoded->normals) || !finite(decoded->uvs)) {
    return Error{ErrorCode::not_finite, "mesh.drc", "holds a number that is not finite"};
  }
  RenderMesh mesh;
  mesh.positions = as_vectors(decoded->positions);
  mesh.normals = as_vectors(decoded->normals);
  for (glm::vec3& normal : mesh.normals) {  // the octahedral coordinates are whole numbers, glTF wants unit length
    const float length = std::sqrt(normal.x * normal.x + normal.y * normal.y + normal.z * normal.z);
    normal = length > 0.0F ? normal / length : glm::vec3(0.0F, 0.0F, 1.0F);
  }
  for (std::size_t i = 0; i + 1 < decoded->uvs.size(); i += 2)
    mesh.uvs.emplace_back(decoded->uvs[i], decoded->uvs[i + 1]);
  mesh.materials = std::move(decoded->materials);
  mesh.materials.resize(mesh.positions.size());
  mesh.triangles = std::move(decoded->triangles);
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
  for (const RigDocument::MaterialInfo& info : rig->materials)
    face.materials.push_back(take_material(info, rig->images));
  for (const RigDocument::ImageInfo& info : rig->images) {
    auto image = take_image(info, parts);
    if (!image) return image.error();
    face.images.push_back(std::move(*image));
  }
  face.rig = std::move(*rig);
  return face;
}

}  // namespace semblante
