#include "protocol/package/render_mesh.h"

#include <unordered_map>

#include "core/types/seeded_hash.h"

namespace semblante {
namespace {

struct Corner {
  std::uint32_t vertex, uv, normal, material;
  bool operator==(const Corner&) const = default;
};

struct CornerHash {
  std::size_t operator()(const Corner& c) const {
    return SeededHash::of(std::uint64_t{c.vertex} << 32U | c.uv, std::uint64_t{c.normal} << 32U | c.material);
  }
};

}  // namespace

RenderMesh make_render_mesh(const Model& model, const Surface& surface,
                            std::span<const std::uint8_t> triangle_materials, std::span<const glm::vec3> smooth) {
  RenderMesh mesh;
  const bool has_uvs = !model.uvs.empty() && !model.uv_triangles.empty();
  const bool has_normals = !model.normals.empty() && !model.normal_triangles.empty();

  std::unordered_map<Corner, std::uint32_t, CornerHash> index_of;
  index_of.reserve(model.positions.size() * 5 / 4);
  const auto vertex_for = [&](const Corner& corner) {
    const auto [at, added] = index_of.try_emplace(corner, static_cast<std::uint32_t>(mesh.positions.size()));
    if (added) {
      mesh.file_vertex.push_back(corner.vertex);
      mesh.positions.push_back(model.positions[corner.vertex]);
      mesh.normals.push_back(corner.normal == Model::no_index ? smooth[surface.surface_of[corner.vertex].value()]
                                                              : model.normals[corner.normal]);
      if (has_uvs) mesh.uvs.push_back(corner.uv == Model::no_index ? glm::vec2(0.0F) : model.uvs[corner.uv]);
      if (!model.colors.empty()) mesh.colors.push_back(model.colors[corner.vertex]);
      mesh.materials.push_back(static_cast<std::uint8_t>(corner.material));
    }
    return at->second;
  };

  mesh.triangles.reserve(model.triangles.size());
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    Triangle triangle{};
    for (std::size_t c = 0; c < 3; ++c) {
      triangle[c] = vertex_for({model.triangles[t][c], has_uvs ? model.uv_triangles[t][c] : Model::no_index,
                                has_normals ? model.normal_triangles[t][c] : Model::no_index, triangle_materials[t]});
    }
    mesh.triangles.push_back(triangle);
  }
  mesh.triangle_materials.assign(triangle_materials.begin(), triangle_materials.end());
  return mesh;
}

std::pair<glm::vec3, glm::vec3> bounds_of(const RenderMesh& mesh) {
  glm::vec3 low = mesh.positions[0], high = low;
  for (const glm::vec3& p : mesh.positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  return {low, high};
}

}  // namespace semblante
