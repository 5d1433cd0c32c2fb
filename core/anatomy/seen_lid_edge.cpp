#include "core/anatomy/seen_lid_edge.h"

#include <cmath>
#include <cstddef>
#include <vector>

#include "core/anatomy/front_column.h"

namespace semblante {
namespace {

/// Of ES0, 1.3 mm: of eyes that are nearly shut the least skin is a great share.
constexpr double least_fold = 0.02;
/// Heights at which the front of the face is looked at.
constexpr int steps = 64;

}  // namespace

std::optional<SeenLidEdge> seen_lid_edge(const Surface& surface, std::span<const Part> parts,
                                         std::span<const Triangle> triangles, const Similarity& frame,
                                         const glm::dvec3& point, const glm::dvec3& other) {
  const FrontColumn column(surface, parts, triangles, frame, point.x);
  SeenLidEdge edge{point, 0.0, std::abs(other.y - point.y)};
  for (int k = 1; k < steps; ++k) {
    const double share = static_cast<double>(k) / steps;
    const double y = point.y + share * (other.y - point.y);
    const auto seen = column.at(y);
    if (!seen) return std::nullopt;
    if (!seen->is_skin) return edge;
    edge.place = {point.x, y, seen->z};
    edge.share = share;
  }
  return std::nullopt;
}

std::optional<SeenEye> seen_eye(const Surface& surface, std::span<const Part> parts,
                                std::span<const Triangle> triangles, const Similarity& frame, double x, double low,
                                double high) {
  const FrontColumn column(surface, parts, triangles, frame, x);
  constexpr int heights = 2 * steps;
  std::vector<std::optional<FrontColumn::Seen>> seen;
  const auto height_of = [&](int k) { return high + (low - high) * static_cast<double>(k) / heights; };
  for (int k = 0; k <= heights; ++k) seen.push_back(column.at(height_of(k)));
  const auto is_eye = [&](int k) {
    return seen[static_cast<std::size_t>(k)] && !seen[static_cast<std::size_t>(k)]->is_skin;
  };
  int upper = 0;  // the skin above the greatest span, and below it
  int lower = 0;
  for (int k = 1; k < heights; ++k) {
    if (!is_eye(k) || is_eye(k - 1)) continue;
    int end = k;
    while (end < heights && is_eye(end)) ++end;
    if (is_eye(end) || !seen[static_cast<std::size_t>(k - 1)] || !seen[static_cast<std::size_t>(end)]) continue;
    if (end - (k - 1) > lower - upper) {
      upper = k - 1;
      lower = end;
    }
  }
  if (lower == upper) return std::nullopt;
  const auto place_of = [&](int k) { return glm::dvec3(x, height_of(k), seen[static_cast<std::size_t>(k)]->z); };
  return SeenEye{place_of(upper), place_of(lower)};
}

bool is_on_edge(double off, double open, double eye_separation) {
  return std::abs(off) < least_share_of_fold * open || std::abs(off) < least_fold * eye_separation;
}

}  // namespace semblante
