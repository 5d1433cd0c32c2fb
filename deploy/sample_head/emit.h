#pragma once

#include <functional>

#include "deploy/sample_head/half_mesh.h"
#include "deploy/sample_head/sample_head.h"

namespace semblante::sample_head_detail {

/// The whole mesh of a half mesh, and the map of its vertices.
struct EmittedMesh {
  SampleHeadMesh mesh;
  std::vector<std::uint32_t> left;   ///< #V of the half mesh: a vertex of `mesh` for each
  std::vector<std::uint32_t> right;  ///< likewise, in the mirror image
};

/// The UV of the outer chart for a point of the left half, u in [0.5, 1]: a cylinder about the head, with more of the
/// width given to the face than to the back.
Vec2 outer_uv(const Vec3& p);
/// The UV in the corner of the texture that the lining uses.
Vec2 inner_uv(const Paint& paint);

/// Chooses a vertex's UV by place, paint and chart; for the left half.
using UvOf = std::function<Vec2(const Vec3&, const Paint&, Chart)>;
Vec2 skin_uv(const Vec3& p, const Paint& paint, Chart chart);

/// Mirrors, triangulates, splits vertices where charts meet, computes smooth normals and converts to metres.
EmittedMesh emit_symmetric(const std::string& name, std::size_t material, const HalfMesh& half,
                           const UvOf& uv_of = skin_uv);

}  // namespace semblante::sample_head_detail
