#include "core/anatomy/front_column.h"

#include <algorithm>

namespace semblante {

FrontColumn::FrontColumn(const Surface& surface, std::span<const Part> parts, std::span<const Triangle> triangles,
                         const Similarity& frame, double x) {
  for (const Triangle& t : triangles) {
    std::array<SurfaceVertexId, 3> corners;
    std::array<glm::dvec3, 3> places;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = surface.surface_of[t[k]];
    const PartRole role = parts[surface.part_of[corners[0].value()].value()].role;
    const bool is_skin = role == PartRole::skin;
    if (!is_skin && role != PartRole::left_eye && role != PartRole::right_eye) continue;
    for (std::size_t k = 0; k < 3; ++k) places[k] = frame(surface.positions[corners[k].value()]);
    Piece piece;
    piece.is_skin = is_skin;
    std::size_t cuts = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      const glm::dvec3& a = places[k];
      const glm::dvec3& b = places[next];
      if ((a.x < x) == (b.x < x)) continue;
      piece.ends[cuts] = a + (x - a.x) / (b.x - a.x) * (b - a);
      piece.edges[cuts] = {std::min(corners[k], corners[next]), std::max(corners[k], corners[next])};
      ++cuts;
    }
    if (cuts == 2) pieces_.push_back(piece);
  }
}

std::optional<FrontColumn::Seen> FrontColumn::at(double y) const {
  std::optional<Seen> nearest;
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    const auto& [a, b] = pieces_[p].ends;
    if ((a.y < y) == (b.y < y)) continue;
    const double z = a.z + (y - a.y) / (b.y - a.y) * (b.z - a.z);
    if (!nearest || z > nearest->z) nearest = Seen{pieces_[p].is_skin, z, p};
  }
  return nearest;
}

}  // namespace semblante
