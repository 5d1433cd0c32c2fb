#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "core/anatomy/point_lookup.h"
#include "core/doctor/openings.h"
#include "core/doctor/surface_way.h"
#include "core/doctor/words.h"
#include "core/geometry/edge_path_search.h"

namespace semblante {
namespace {

/// A rim bends smoothly if there are at least two vertices between neighbouring points, that is, three edges from point
/// to point. A rim of lips has eight points (2.2 to 2.9), one of lids four.
constexpr std::size_t edges_between_points = 3;
constexpr std::size_t points_of_mouth = 8;
constexpr std::size_t points_of_eye = 4;
/// A quarter of a millimetre on a human face, a pixel or two of a face on a large screen: finer vertices cost time on
/// every client without visible effect.
constexpr double finest = 0.004;

struct Ring {
  std::size_t edges = 0;
  double length = 0.0;
  VertexSample vertices;
  bool whole = true;
};

/// The closed path along the surface from point to point.
Ring walk(const Subject& head, const std::vector<SurfacePoint>& points, EdgePathSearch& search) {
  Ring ring;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SurfacePoint& from = points[i];
    const SurfacePoint& to = points[(i + 1) % points.size()];
    const auto distances = search.from(from.vertex);
    if (!std::isfinite(distances[to.vertex.value()])) ring.whole = false;
    if (!ring.whole) return ring;
    const auto way = way_back(head.surface, distances, to.vertex);
    ring.edges += way.size() - 1;
    ring.length += distances[to.vertex.value()];
    for (std::size_t k = 0; k + 1 < way.size(); ++k) ring.vertices.add(head.surface.file_vertex_of[way[k].value()]);
  }
  return ring;
}

/// The marked points of a rim in circular order: a corner, the upper rim, the other corner, the lower rim.
/// Empty unless both corners and both rims have a point.
std::vector<SurfacePoint> round_the_rim(const Opening& opening, std::span<const SurfacePoint> points) {
  std::vector<SurfacePoint> ring;
  const auto add = [&](std::string_view name) {
    const SurfacePoint* const point = point_named(points, name);
    if (point != nullptr) ring.push_back(*point);
    return point != nullptr;
  };
  const bool has_middles =
      point_named(points, opening.upper.front()) != nullptr && point_named(points, opening.lower.front()) != nullptr;
  if (!has_middles || !add(opening.corners[0])) return {};
  if (opening.is_mouth) add("2.6");
  add(opening.upper.front());
  if (opening.is_mouth) add("2.7");
  if (!add(opening.corners[1])) return {};
  if (opening.is_mouth) add("2.9");
  add(opening.lower.front());
  if (opening.is_mouth) add("2.8");
  return ring;
}

Finding about(const Opening& opening, FindingCode code, Ring ring, const std::vector<SurfacePoint>& points) {
  Finding finding;
  finding.code = code;
  finding.severity = Severity::warning;
  for (const SurfacePoint& point : points) finding.place.points.push_back(point.id);
  finding.place.vertices = std::move(ring.vertices);
  finding.place.position = point_named(points, opening.upper.front())->position;
  return finding;
}

}  // namespace

std::vector<Finding> find_wrong_density(const Subject& head) {
  std::vector<Finding> findings;
  const std::vector<SurfacePoint> points = surface_points(head.surface, head.rig.points);
  EdgePathSearch search(head.surface);
  for (const Opening& opening : openings) {
    const std::vector<SurfacePoint> rim = round_the_rim(opening, points);
    if (rim.empty()) continue;
    Ring ring = walk(head, rim, search);
    if (!ring.whole || ring.edges == 0) continue;
    const std::size_t fewest = edges_between_points * (opening.is_mouth ? points_of_mouth : points_of_eye);
    const double mean = ring.length / static_cast<double>(ring.edges) / head.frame.eye_separation.value_or(1.0);
    const std::size_t edges = ring.edges;
    if (edges < fewest) {
      Finding finding = about(opening, opening.is_mouth ? FindingCode::mouth_too_coarse : FindingCode::eye_too_coarse,
                              std::move(ring), rim);
      finding.words = "the rim of the " + std::string(opening.name) + " has " + count_of(edges, "edge", "edges") +
                      ", so there are too few vertices between its points; it bends in corners instead of smoothly";
      finding.remedy =
          "subdivide the " + std::string(opening.is_mouth ? "mouth" : "eye") + " once, or use a finer model";
      finding.measured = {"edges of the rim", static_cast<double>(edges), static_cast<double>(fewest)};
      findings.push_back(std::move(finding));
    } else if (head.frame.eye_separation && mean < finest) {
      Finding finding = about(opening, FindingCode::face_too_dense, std::move(ring), rim);
      finding.words = "the rim of the " + std::string(opening.name) + " has " + std::to_string(edges) +
                      " edges, finer than a screen resolves; every client processes vertices without visible effect";
      finding.remedy = "decimate the model before the upload, or have clients fetch a lower level of detail";
      finding.measured = {"mean edge length of the rim as a fraction of ES0", mean, finest};
      findings.push_back(std::move(finding));
    }
  }
  return findings;
}

}  // namespace semblante
