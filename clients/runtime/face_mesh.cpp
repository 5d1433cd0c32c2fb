#include "clients/runtime/face_mesh.h"

#ifdef SEMBLANTE_WITH_DRACO
#include "core/draco/draco_mesh.h"
#endif
#include "protocol/cpp/weights_format.h"

namespace semblante::runtime {
namespace {

Error refused(ErrorCode code, std::string message) { return {code, "mesh.drc", std::move(message)}; }

#ifdef SEMBLANTE_WITH_DRACO
template <class T>
std::vector<T> value_or_empty(Result<std::vector<T>> values) {
  return values ? *std::move(values) : std::vector<T>{};
}
#endif

}  // namespace

Result<FaceMesh> decode_mesh(std::span<const std::uint8_t> bytes, const RigDocument::Mesh& mesh) {
  if (mesh.vertices == 0 || mesh.triangles == 0) {
    return refused(ErrorCode::empty, "rig.json declares no vertices or no triangles");
  }
  if (mesh.vertices > max_weights_vertices || mesh.triangles > 2U * max_weights_vertices) {
    return refused(ErrorCode::too_large, "rig.json declares more than 4 million vertices or 8 million triangles");
  }
#ifdef SEMBLANTE_WITH_DRACO
  const auto draco = DracoMesh::decode(bytes, {mesh.vertices, mesh.triangles});
  if (!draco) {
    return refused(draco.error().code, draco.error().message);
  }
  if (draco->point_count() != mesh.vertices || draco->triangle_count() != mesh.triangles) {
    return refused(ErrorCode::mismatch, "the number of vertices or triangles differs from rig.json");
  }
  if (!mesh.attributes.position) {
    return refused(ErrorCode::missing, "rig.json has no attribute for positions");
  }
  auto positions = draco->vectors3(*mesh.attributes.position);
  if (!positions) {
    return refused(positions.error().code, positions.error().message);
  }
  FaceMesh decoded;
  decoded.positions = *std::move(positions);
  if (mesh.attributes.normal) {
    decoded.normals = value_or_empty(draco->vectors3(*mesh.attributes.normal));
  }
  if (mesh.attributes.uv) {
    decoded.uvs = value_or_empty(draco->vectors2(*mesh.attributes.uv));
  }
  if (mesh.attributes.material) {
    decoded.materials = value_or_empty(draco->bytes(*mesh.attributes.material));
  }
  if (mesh.attributes.color) {
    decoded.colors = value_or_empty(draco->bytes(*mesh.attributes.color, 3));
  }
  decoded.triangles = draco->triangles();
  return decoded;
#else
  static_cast<void>(bytes);
  return refused(ErrorCode::unsupported, "this build has no Draco decoder");
#endif
}

}  // namespace semblante::runtime
