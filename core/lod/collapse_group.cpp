#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModBaseT.hh>
#include <OpenMesh/Tools/Decimater/Observer.hh>
#include <glm/geometric.hpp>

#include "core/geometry/triangle_shape.h"
#include "core/lod/collapse_history.h"
#include "core/lod/group_mesh.h"

// Not self-contained: needs the includes of the mesh before it.
#include <OpenMesh/Core/Geometry/QuadricT.hh>

namespace semblante {
namespace {

using Quadric = OpenMesh::Geometry::Quadricd;
using OpenMesh::FaceHandle;
using Face = GroupMesh::Face;

/// Weight of a pose's error relative to the neutral face; six expressions together weigh as much as the neutral face.
constexpr double pose_weight = 1.0 / 6.0;
/// Weight of planes through borders and seams, perpendicular to the surface, relative to the planes of triangles:
/// errors of a border line are more visible than errors within a surface.
constexpr double border_weight = 4.0;
/// Weight of edge length, to prefer short edges where the surface is flat and all collapses are equivalent.
constexpr double distance_weight = 1e-3;
/// The same where the colours of vertices change, for a change by all of the light: they are painted by vertices alone,
/// so that an iris or a brow is lost with them, however flat it is.
constexpr double color_weight = 0.3;
/// Maximum rotation of a triangle by one collapse, at rest: cosine of 60 degrees.
constexpr double most_turn = 0.5;
/// Minimum cosine between a triangle's normal and the full surface's normals at its corners.
constexpr double least_facing = 0.2;
/// Twice the area of a triangle divided by its squared longest side, below which it is a needle; on meshes of needles,
/// as lashes are, a fraction of what is usual there.
constexpr double needle = 0.05;
constexpr double needle_of_usual = 0.1;

/// The index of the corner of a triangle at one of its vertices.
std::size_t place_in(const Face& face, int vertex) {
  return face.vertices[0] == vertex ? 0 : face.vertices[1] == vertex ? 1 : 2;
}

Quadric plane_quadric(const glm::dvec3& unit_normal, const glm::dvec3& point, double weight) {
  Quadric q;
  q.set_distance_to_plane(unit_normal.x, unit_normal.y, unit_normal.z, -glm::dot(unit_normal, point));
  return q *= weight;
}

Quadric point_quadric(const glm::dvec3& p, double weight) {
  Quadric q(1.0, 0.0, 0.0, -p.x, 1.0, 0.0, -p.y, 1.0, -p.z, glm::dot(p, p));
  return q *= weight;
}

/// Rules and cost of a collapse, as a module of OpenMesh's decimater.
template <class MeshT>
class FaceModule : public OpenMesh::Decimater::ModBaseT<MeshT> {
 public:
  DECIMATING_MODULE(FaceModule, MeshT, Face);

  explicit FaceModule(MeshT& mesh) : Base(mesh, false) {}

  /// `group` contains the mesh of this module. Both arguments must outlive it.
  void attach(GroupMesh& group, CollapseHistory& history) {
    group_ = &group;
    history_ = &history;
    needle_ = std::min(needle, needle_of_usual * usual_fullness());
    measure();
  }

  /// OpenMesh queries all edges of a vertex in sequence and uses the cheapest allowed collapse. The cost is faster to
  /// compute than the rules, so a collapse that is not the cheapest is refused first.
  float collapse_priority(const CollapseInfo& collapse) override {
    if (collapse.v0 != asked_) {
      asked_ = collapse.v0;
      cheapest_ = std::numeric_limits<double>::infinity();
    }
    const double price = std::max(price_below(collapse, cheapest_), 0.0);
    if (price >= cheapest_) return static_cast<float>(Base::ILLEGAL_COLLAPSE);
    const std::optional<CornerMap> map = corner_map(collapse);
    if (!map || !keeps_shape(collapse, *map)) return static_cast<float>(Base::ILLEGAL_COLLAPSE);
    cheapest_ = price;
    return static_cast<float>(price);
  }

  void preprocess_collapse(const CollapseInfo& collapse) override {
    const double price = std::max(price_below(collapse, std::numeric_limits<double>::infinity()), 0.0);
    const CornerMap map = corner_map(collapse).value_or(CornerMap{});
    for (const FaceHandle f : group_->mesh.vf_range(collapse.v0)) {
      const auto number = static_cast<std::uint32_t>(f.idx());
      if (f == collapse.fl || f == collapse.fr) {
        history_->remove(number);
        continue;
      }
      Face& face = group_->faces[number];
      const std::size_t c = place_in(face, collapse.v0.idx());
      face.vertices[c] = collapse.v1.idx();
      face.corners[c] = map.at(face.corners[c]);
      history_->change(number, face.corners);
    }
    history_->end_collapse(price);
  }

  void postprocess_collapse(const CollapseInfo& collapse) override {
    const auto from = static_cast<std::size_t>(collapse.v0.idx());
    const auto to = static_cast<std::size_t>(collapse.v1.idx());
    for (std::size_t pose = 0; pose < group_->pose_count; ++pose) quadric(to, pose) += quadric(from, pose);
    if (group_->moves[from]) group_->moves[to] = true;
    asked_.invalidate();  // its neighbourhood has changed
  }

 private:
  /// The corner of v1 that replaces each corner of v0: at most one on either side of the edge.
  struct CornerMap {
    std::uint32_t from[2] = {Model::no_index, Model::no_index};
    std::uint32_t to[2] = {Model::no_index, Model::no_index};
    [[nodiscard]] std::uint32_t at(std::uint32_t corner) const { return corner == from[0] ? to[0] : to[1]; }
    [[nodiscard]] bool has(std::uint32_t corner) const { return corner == from[0] || corner == from[1]; }
  };

  /// Empty if the collapse would open, close or move a seam.
  [[nodiscard]] std::optional<CornerMap> corner_map(const CollapseInfo& collapse) const {
    CornerMap map;
    const FaceHandle sides[2] = {collapse.fl, collapse.fr};
    for (int side = 0; side < 2; ++side) {
      if (!sides[side].is_valid()) continue;
      const Face& face = group_->face(sides[side]);
      map.from[side] = corner_at(face, collapse.v0.idx());
      map.to[side] = corner_at(face, collapse.v1.idx());
    }
    const bool inner = collapse.fl.is_valid() && collapse.fr.is_valid();
    if (inner && (map.from[0] == map.from[1]) != (map.to[0] == map.to[1])) return std::nullopt;
    for (const FaceHandle f : group_->mesh.vf_range(collapse.v0)) {
      if (!map.has(corner_at(group_->face(f), collapse.v0.idx()))) return std::nullopt;
    }
    return map;
  }

  /// Whether no triangle flips (at rest or in a pose), becomes a needle, or folds the texture.
  [[nodiscard]] bool keeps_shape(const CollapseInfo& collapse, const CornerMap& map) const {
    const int v0 = collapse.v0.idx();
    const int v1 = collapse.v1.idx();
    const bool moves = group_->moves[static_cast<std::size_t>(v0)] || group_->moves[static_cast<std::size_t>(v1)];
    for (const FaceHandle f : group_->mesh.vf_range(collapse.v0)) {
      if (f == collapse.fl || f == collapse.fr) continue;
      const Face& face = group_->face(f);
      const std::size_t c = place_in(face, v0);
      const int b = face.vertices[(c + 1) % 3];
      const int d = face.vertices[(c + 2) % 3];
      if (!keeps_facing(v0, v1, b, d)) return false;
      if (moves) {
        for (std::size_t pose = 1; pose < group_->pose_count; ++pose) {
          const glm::dvec3& pb = group_->position(pose, b);
          const glm::dvec3& pd = group_->position(pose, d);
          const glm::dvec3 before = area_vector(group_->position(pose, v0), pb, pd);
          const glm::dvec3 after = area_vector(group_->position(pose, v1), pb, pd);
          if (glm::dot(before, after) < 0.0) return false;
        }
      }
      if (!keeps_texture(face, c, map)) return false;
    }
    return true;
  }

  [[nodiscard]] bool keeps_facing(int v0, int v1, int b, int d) const {
    const glm::dvec3& pb = group_->position(0, b);
    const glm::dvec3& pd = group_->position(0, d);
    const glm::dvec3& p0 = group_->position(0, v0);
    const glm::dvec3& p1 = group_->position(0, v1);
    const glm::dvec3 before = area_vector(p0, pb, pd);
    const glm::dvec3 after = area_vector(p1, pb, pd);
    const double area_before = glm::length(before);
    const double area_after = glm::length(after);
    if (area_after <= 0.0) return false;
    if (area_before > 0.0 && glm::dot(before, after) < most_turn * area_before * area_after) return false;
    const double full_after = fullness(p1, pb, pd, area_after);
    if (full_after < needle_ && full_after < fullness(p0, pb, pd, area_before)) return false;
    const glm::dvec3 meant = group_->normals[static_cast<std::size_t>(v1)] +
                             group_->normals[static_cast<std::size_t>(b)] +
                             group_->normals[static_cast<std::size_t>(d)];
    return glm::dot(after, meant) >= least_facing * area_after * glm::length(meant) ||
           glm::dot(after, meant) * area_before >= glm::dot(before, meant) * area_after;
  }

  /// Whether the texture has the same orientation as on the model's triangle.
  [[nodiscard]] bool keeps_texture(const Face& face, std::size_t c, const CornerMap& map) const {
    const double meant = uv_area(group_->all.corners.triangles[face.source]);
    if (meant == 0.0) return true;
    std::array<std::uint32_t, 3> after = face.corners;
    after[c] = map.at(after[c]);
    return (meant > 0.0) == (uv_area(after) > 0.0);
  }

  /// 0 if a corner has no UV.
  [[nodiscard]] double uv_area(const std::array<std::uint32_t, 3>& corners) const {
    std::array<glm::vec2, 3> uvs;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t uv = group_->all.corners.corners[corners[c]].uv;
      if (uv == Model::no_index) return 0.0;
      uvs[c] = group_->all.uvs[uv];
    }
    return twice_uv_area(uvs[0], uvs[1], uvs[2]);
  }

  /// The median of the triangles' fullness.
  [[nodiscard]] double usual_fullness() const {
    std::vector<double> all;
    all.reserve(group_->faces.size());
    for (const Face& face : group_->faces) {
      const glm::dvec3& a = group_->position(0, face.vertices[0]);
      const glm::dvec3& b = group_->position(0, face.vertices[1]);
      const glm::dvec3& c = group_->position(0, face.vertices[2]);
      const double area = glm::length(area_vector(a, b, c));
      all.push_back(area > 0.0 ? fullness(a, b, c, area) : 0.0);
    }
    if (all.empty()) return 1.0;
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end());
    return *middle;
  }

  [[nodiscard]] Quadric& quadric(std::size_t vertex, std::size_t pose) {
    return quadrics_[vertex * group_->pose_count + pose];
  }

  /// The error of the surface after the collapse, summed over all poses; any value above `limit` once it exceeds it.
  [[nodiscard]] double price_below(const CollapseInfo& collapse, double limit) {
    const auto v0 = static_cast<std::size_t>(collapse.v0.idx());
    const auto v1 = static_cast<std::size_t>(collapse.v1.idx());
    const auto error = [&](std::size_t pose) {
      const glm::dvec3& p = group_->position(pose, collapse.v1.idx());
      const OpenMesh::Vec3d at(p.x, p.y, p.z);
      return quadric(v0, pose)(at) + quadric(v1, pose)(at);
    };
    double sum = error(0);
    // Vertices that move in no pose have the same error in all poses.
    if (!group_->moves[v0] && !group_->moves[v1]) {
      return sum * (1.0 + pose_weight * static_cast<double>(group_->pose_count - 1));
    }
    for (std::size_t pose = 1; pose < group_->pose_count && sum < limit; ++pose) sum += pose_weight * error(pose);
    return sum;
  }

  /// Computes the quadrics of all vertices in all poses: triangle planes by area, borders and seams, edge length.
  void measure() {
    const GroupMesh& group = *group_;
    quadrics_.resize(group.mesh.n_vertices() * group.pose_count);
    for (Quadric& q : quadrics_) q.clear();
    for (std::size_t pose = 0; pose < group.pose_count; ++pose) {
      for (const Face& face : group.faces) add_plane(face, pose);
      for (const auto edge : group.mesh.edges()) {
        if (group.is_seam(edge)) add_border(edge, pose);
      }
    }
  }

  [[nodiscard]] glm::dvec3 area_of(const Face& face, std::size_t pose) const {
    const auto [a, b, c] = face.vertices;
    return area_vector(group_->position(pose, a), group_->position(pose, b), group_->position(pose, c));
  }

  [[nodiscard]] double importance_of(const Face& face) const {
    double sum = 0.0;
    for (const int v : face.vertices) sum += group_->importance[static_cast<std::size_t>(v)];
    return sum / 3.0;
  }

  /// The greatest square of a difference between the colours of a triangle's corners, in sRGB: 1 for black and white.
  [[nodiscard]] double contrast_of(const Face& face) const {
    const std::span<const Color8> colors = group_->all.colors;
    if (colors.empty()) return 0.0;
    const auto color_at = [&](std::size_t c) {
      return colors[group_->all.corners.corners[face.corners[c]].file_vertex];
    };
    int most = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const Color8 a = color_at(c);
      const Color8 b = color_at((c + 1) % 3);
      int sum = 0;
      for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
      most = std::max(most, sum);
    }
    return most / (3.0 * 255.0 * 255.0);
  }

  void add_plane(const Face& face, std::size_t pose) {
    const glm::dvec3 area = area_of(face, pose);
    const double twice_area = glm::length(area);
    if (twice_area <= 0.0) return;
    const double weight = importance_of(face) * twice_area / 6.0;
    const double place_weight = distance_weight + color_weight * contrast_of(face);
    const Quadric plane = plane_quadric(area / twice_area, group_->position(pose, face.vertices[0]), weight);
    for (const int v : face.vertices) {
      Quadric& sum = quadric(static_cast<std::size_t>(v), pose);
      sum += plane;
      sum += point_quadric(group_->position(pose, v), place_weight * weight);
    }
  }

  void add_border(OpenMesh::EdgeHandle edge, std::size_t pose) {
    for (const unsigned side : {0U, 1U}) {
      const auto half = group_->mesh.halfedge_handle(edge, side);
      const FaceHandle f = group_->mesh.face_handle(half);
      if (!f.is_valid()) continue;
      const int from = group_->mesh.from_vertex_handle(half).idx();
      const int to = group_->mesh.to_vertex_handle(half).idx();
      const glm::dvec3 along = group_->position(pose, to) - group_->position(pose, from);
      const glm::dvec3 outward = glm::cross(along, area_of(group_->face(f), pose));
      const double length = glm::length(outward);
      if (length <= 0.0) continue;
      const double weight = importance_of(group_->face(f)) * border_weight * glm::dot(along, along) / 6.0;
      const Quadric plane = plane_quadric(outward / length, group_->position(pose, from), weight);
      quadric(static_cast<std::size_t>(from), pose) += plane;
      quadric(static_cast<std::size_t>(to), pose) += plane;
    }
  }

  GroupMesh* group_ = nullptr;
  CollapseHistory* history_ = nullptr;
  std::vector<Quadric> quadrics_;  ///< by vertex, then pose
  OpenMesh::VertexHandle asked_;   ///< the vertex asked about last, and the least price found for it
  double cheapest_ = 0.0;
  double needle_ = needle;
};

/// Stops the decimater at the target number of corners, or on cancellation.
class Stop : public OpenMesh::Decimater::Observer {
 public:
  Stop(const CollapseHistory& history, std::size_t least, const std::function<bool()>& go_on)
      : Observer(1), history_(history), least_(least), go_on_(go_on) {}
  void notify(std::size_t step) override {
    if (step % 4096 == 0 && !go_on_()) stopped_ = true;
  }
  [[nodiscard]] bool abort() const override { return stopped_ || history_.least() <= least_; }

 private:
  const CollapseHistory& history_;
  std::size_t least_;
  const std::function<bool()>& go_on_;
  bool stopped_ = false;
};

}  // namespace

CollapseHistory collapse_group(const DecimationMesh& mesh, std::span<const std::uint32_t> sources, double least_share,
                               const std::function<bool()>& go_on) {
  GroupMesh group(mesh, sources);
  std::vector<LevelTriangle> full;
  full.reserve(sources.size());
  for (const Face& face : group.faces) full.push_back({face.source, face.corners});
  full.insert(full.end(), group.untouched.begin(), group.untouched.end());
  CollapseHistory history(std::move(full));
  const auto least = static_cast<std::size_t>(least_share * static_cast<double>(history.full()));
  if (history.full() <= least) return history;

  OpenMesh::Decimater::DecimaterT<HalfEdgeMesh> decimater(group.mesh);
  FaceModule<HalfEdgeMesh>::Handle module;
  decimater.add(module);
  decimater.module(module).attach(group, history);
  decimater.initialize();
  Stop stop(history, least, go_on);
  decimater.set_observer(&stop);
  decimater.decimate();
  return history;
}

}  // namespace semblante
