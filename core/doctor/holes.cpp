#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <unordered_map>
#include <vector>

#include <glm/geometric.hpp>

#include "core/anatomy/part_roles.h"
#include "core/anatomy/point_lookup.h"
#include "core/doctor/part_checks.h"
#include "core/doctor/words.h"
#include "core/geometry/nearest_point.h"

namespace semblante {
namespace {

/// A border longer than this, in ES0, is the neck's or the rim of a mask, not a hole.
constexpr double longest = 1.5;
/// Distance to a point, in ES0, up to which a hole matters: it deflects the paths along which influence spreads. Nearly
/// all places of a face are within it.
constexpr double near_a_point = 0.4;
/// Mouth, eyes and nostrils are holes on many heads. A border this close to their points, in ES0, belongs to them.
constexpr double of_an_opening = 0.10;
constexpr auto at_openings =
    std::to_array<std::string_view>({"2.2", "2.3", "2.4", "2.5",  "2.6",  "2.7", "2.8", "2.9", "3.1", "3.2", "3.3",
                                     "3.4", "3.7", "3.8", "3.11", "3.12", "9.1", "9.2", "9.3", "9.4", "9.5", "9.15"});

struct Hole {
  double length = 0.0;
  bool is_closed = true;
  VertexSample vertices;
  std::vector<glm::dvec3> places;
};

class Chains {
 public:
  void join(std::uint32_t a, std::uint32_t b) { parent_[find(a)] = find(b); }
  std::uint32_t find(std::uint32_t v) {
    parent_.try_emplace(v, v);
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  }

 private:
  std::unordered_map<std::uint32_t, std::uint32_t> parent_;
};

}  // namespace

std::vector<Finding> find_holes(const Subject& head) {
  std::vector<Finding> findings;
  if (!head.frame.eye_separation) return findings;
  const double unit = *head.frame.eye_separation;
  std::vector<glm::dvec3> skin_places;
  std::vector<FeaturePointId> ids;
  std::vector<glm::dvec3> opening_places;
  for (const SurfacePoint& point : surface_points(head.surface, head.rig.points)) {
    if (std::find(at_openings.begin(), at_openings.end(), to_string(point.id)) != at_openings.end())
      opening_places.push_back(point.position);
    if (!is_skin_point(point.id) || group_of(point.id) == 10) continue;
    skin_places.push_back(point.position);
    ids.push_back(point.id);
  }
  if (skin_places.empty()) return findings;

  const auto on_skin = [&](std::uint32_t vertex) {
    return head.rig.parts[head.surface.part_of[vertex].value()].role == PartRole::skin;
  };
  Chains chains;
  std::unordered_map<std::uint32_t, int> borders_at;  // by vertex
  for (std::size_t e = 0; e < head.mesh.edge_count(); ++e) {
    const auto sides = head.mesh.sides_of(e);
    if (sides.size() != 1 || !on_skin(sides[0].low)) continue;
    chains.join(sides[0].low, sides[0].high);
    ++borders_at[sides[0].low];
    ++borders_at[sides[0].high];
  }
  std::unordered_map<std::uint32_t, Hole> holes;
  for (std::size_t e = 0; e < head.mesh.edge_count(); ++e) {
    const auto sides = head.mesh.sides_of(e);
    if (sides.size() != 1 || !on_skin(sides[0].low)) continue;
    Hole& hole = holes[chains.find(sides[0].low)];
    const glm::dvec3& a = head.surface.positions[sides[0].low];
    hole.length += glm::distance(a, head.surface.positions[sides[0].high]);
    hole.vertices.add(head.surface.file_vertex_of[sides[0].low]);
    if (hole.places.size() < 256) hole.places.push_back(a);
  }

  // The free edges of a flap that stands on the skin have ends; the edges of a hole have none.
  for (const auto& [vertex, borders] : borders_at) {
    if (borders % 2 == 1) holes[chains.find(vertex)].is_closed = false;
  }

  NearestPoint nearest(skin_places);
  for (auto& [root, hole] : holes) {
    if (!hole.is_closed || hole.length > longest * unit) continue;
    double least = std::numeric_limits<double>::infinity();
    std::size_t point = 0;
    glm::dvec3 at(0.0);
    bool is_an_opening = false;
    for (const glm::dvec3& place : hole.places) {
      for (const glm::dvec3& opening : opening_places)
        is_an_opening |= glm::distance(place, opening) < of_an_opening * unit;
      const auto hit = nearest.nearest(place);
      if (hit.distance >= least) continue;
      least = hit.distance;
      point = hit.index;
      at = place;
    }
    if (is_an_opening || least > near_a_point * unit) continue;
    Finding finding;
    finding.code = FindingCode::hole_near_points;
    finding.severity = Severity::warning;
    finding.place.part = head.surface.part_of[root];
    finding.place.points.push_back(ids[point]);
    finding.place.vertices = std::move(hole.vertices);
    finding.place.position = at;
    finding.words = "the skin has a hole beside " + to_string(ids[point]) + ", " + percent(hole.length / unit) +
                    " of the eye distance in circumference; influence goes around it, and the background is visible";
    finding.remedy = "fill the hole in the program that made the model";
    finding.measured = {"distance to the point as a fraction of ES0", least / unit, near_a_point};
    findings.push_back(std::move(finding));
  }
  std::sort(findings.begin(), findings.end(), [](const Finding& a, const Finding& b) {
    return a.place.vertices.vertices.front() < b.place.vertices.vertices.front();
  });
  return findings;
}

}  // namespace semblante
