#include "core/propose/face_front.h"

#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace semblante {
namespace {

/// By far the most triangles of a body lie outside these heights.
constexpr double top = 1.0;
constexpr double bottom = -2.2;
/// A column that cuts more triangles shows no face: one of two million triangles has a tenth of them in a column.
constexpr std::size_t most_cut = 20'000;

}  // namespace

FaceFront::FaceFront(const Surface& surface, std::span<const Part> parts, std::span<const Triangle> triangles,
                     const Similarity& frame)
    : surface_(surface), parts_(parts), frame_(frame) {
  for (const Triangle& t : triangles) {
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high(-low);
    for (const std::uint32_t v : t) {
      const glm::dvec3 p = frame(surface.positions[surface.surface_of[v].value()]);
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    const bool is_of_face = high.x > -half_width && low.x < half_width && high.y > bottom && low.y < top;
    if (is_of_face) triangles_.push_back({low.x, high.x, t});
  }
}

std::vector<Triangle> FaceFront::cut_at(double x) const {
  std::vector<Triangle> cut;
  for (const Extent& extent : triangles_) {
    if (extent.low > x || extent.high < x) continue;
    if (cut.size() == most_cut) return {};
    cut.push_back(extent.triangle);
  }
  return cut;
}

FrontColumn FaceFront::column(double x) const { return {surface_, parts_, cut_at(x), frame_, x}; }

std::optional<SeenEye> FaceFront::eye(double x, double low, double high) const {
  return seen_eye(surface_, parts_, cut_at(x), frame_, x, low, high);
}

std::optional<SeenSpot> FaceFront::spot(const FrontColumn& column, const glm::dvec3& place) const {
  const auto seen = column.at(place.y);
  if (!seen || !seen->is_skin) return std::nullopt;
  std::optional<SeenSpot> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& edge : column.pieces()[seen->piece].edges) {
    for (const SurfaceVertexId v : edge) {
      const double off = glm::distance(frame_(surface_.positions[v.value()]), place);
      if (off >= least) continue;
      least = off;
      nearest = SeenSpot{place, v};
    }
  }
  return nearest;
}

}  // namespace semblante
