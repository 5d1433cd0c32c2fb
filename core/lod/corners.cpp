#include "core/lod/corners.h"

#include <cstdlib>

#include <glm/geometric.hpp>

namespace semblante {
namespace {

constexpr float crease_cosine = 0.985F;  // 10 degrees
/// Further corners of a vertex are not compared, so that the time stays linear; vertices of faces have fewer.
constexpr int max_compared = 64;
/// Of 255, in one channel: less is not seen as an edge between two colours.
constexpr int color_step = 16;
/// If normals and colours multiply the number of corners by more than this, every triangle has its own.
constexpr double flat_shaded = 1.5;

bool has_normals_of_file(const Model& model) { return !model.normals.empty() && !model.normal_triangles.empty(); }

bool differ(const Color8& a, const Color8& b) {
  for (std::size_t c = 0; c < a.size(); ++c) {
    if (std::abs(a[c] - b[c]) > color_step) return true;
  }
  return false;
}

/// Finds an equal corner of a vertex, or adds it.
class CornerTable {
 public:
  CornerTable(const Model& model, std::size_t surface_vertices, bool with_normals)
      : model_(model), with_normals_(with_normals), first_of_(surface_vertices, Model::no_index) {}

  std::uint32_t find_or_add(const Corner& wanted, std::uint8_t label) {
    std::uint32_t* link = &first_of_[wanted.surface_vertex];
    for (int compared = 0; *link != Model::no_index && compared < max_compared; ++compared) {
      if (labels_[*link] == label && looks_like(corners[*link], wanted)) return *link;
      link = &next_[*link];
    }
    const auto added = static_cast<std::uint32_t>(corners.size());
    const std::uint32_t rest = *link;
    *link = added;  // before the vectors grow and the pointer dangles
    corners.push_back(wanted);
    labels_.push_back(label);
    next_.push_back(rest);
    return added;
  }

  std::vector<Corner> corners;

 private:
  [[nodiscard]] bool looks_like(const Corner& a, const Corner& b) const {
    if (a.uv != b.uv) {
      if (a.uv == Model::no_index || b.uv == Model::no_index || model_.uvs[a.uv] != model_.uvs[b.uv]) return false;
    }
    if (!with_normals_) return true;
    if (!model_.colors.empty() && differ(model_.colors[a.file_vertex], model_.colors[b.file_vertex])) return false;
    if (a.normal == b.normal) return true;
    if (a.normal == Model::no_index || b.normal == Model::no_index) return false;
    return glm::dot(model_.normals[a.normal], model_.normals[b.normal]) > crease_cosine;
  }

  const Model& model_;
  bool with_normals_;
  std::vector<std::uint32_t> first_of_;  ///< #S, into corners: a chain through next_
  std::vector<std::uint32_t> next_;      ///< #C
  std::vector<std::uint8_t> labels_;     ///< #C
};

Corners join(const Model& model, const Surface& surface, std::span<const std::uint8_t> labels, bool with_normals) {
  const bool has_uvs = !model.uvs.empty() && !model.uv_triangles.empty();
  const bool has_normals = with_normals && has_normals_of_file(model);
  CornerTable table(model, surface.vertex_count(), with_normals);
  Corners out;
  out.triangles.reserve(model.triangles.size());
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t vertex = model.triangles[t][c];
      triangle[c] = table.find_or_add(
          {surface.surface_of[vertex].value(), vertex, has_uvs ? model.uv_triangles[t][c] : Model::no_index,
           has_normals ? model.normal_triangles[t][c] : Model::no_index},
          labels.empty() ? std::uint8_t{0} : labels[t]);
    }
    out.triangles.push_back(triangle);
  }
  out.corners = std::move(table.corners);
  return out;
}

}  // namespace

Corners join_corners(const Model& model, const Surface& surface, std::span<const std::uint8_t> labels,
                     bool with_normals) {
  Corners plain = join(model, surface, labels, false);
  if (!with_normals || (!has_normals_of_file(model) && model.colors.empty())) return plain;
  Corners creased = join(model, surface, labels, true);
  const bool flat =
      static_cast<double>(creased.corners.size()) > flat_shaded * static_cast<double>(plain.corners.size());
  return flat ? plain : creased;
}

}  // namespace semblante
