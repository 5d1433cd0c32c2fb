#include "core/anatomy/opening_margins.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <glm/geometric.hpp>

#include "core/anatomy/lid_edge.h"
#include "core/anatomy/lip_edge.h"
#include "core/anatomy/slanted_opening.h"
#include "core/anatomy/smooth_step.h"

namespace semblante {
namespace {

/// Maximum number of places between the middle of a lid and a corner, or between two points of a lip.
constexpr std::size_t places_of_lid = 9;
constexpr std::size_t places_of_fold = 5;
/// Share of a fold's point from which on its places are held. Nearer to a corner the fold runs into the edge, which
/// must meet the other one.
constexpr double middle_of_fold = 0.7;
/// Maximum distance of a vertex from its place on a fold, as a share of the fold's distance from the edge there. On a
/// coarse mesh a vertex farther away would follow the fold although it lies above or below it.
constexpr double greatest_step_to_fold = 0.28;
constexpr std::size_t places_of_lip = 2;
/// The height of an eye's opening as a share of its width from which on the heights along the edges say how its lids
/// close. Those of closed lids (`closed_height`) say nothing.
constexpr double open_height = 0.12;
/// A brow this near to the fold of its lid, in widths of the eye, leaves a notch in the fold when it rises. Farther
/// skin between them fades better without places on the fold.
constexpr double near_brow = 0.6;
/// From the front, radians: so far from the side closed lids show no gap.
constexpr double side_view = 1.05;

/// Vertices evenly spaced between the ends of a path, without the ends.
std::vector<SurfaceVertexId> places_on(const Surface& surface, const std::vector<SurfaceVertexId>& path,
                                       std::size_t count) {
  std::vector<double> along = {0.0};
  for (std::size_t i = 1; i < path.size(); ++i) {
    along.push_back(along.back() + glm::distance(surface.positions[path[i - 1].value()],  //
                                                 surface.positions[path[i].value()]));
  }
  std::vector<SurfaceVertexId> places;
  for (std::size_t k = 1; k <= count && path.size() > 2; ++k) {
    const double wanted = along.back() * static_cast<double>(k) / static_cast<double>(count + 1);
    std::size_t best = 1;
    for (std::size_t i = 2; i + 1 < path.size(); ++i) {
      if (std::abs(along[i] - wanted) < std::abs(along[best] - wanted)) best = i;
    }
    if (places.empty() || places.back() != path[best]) places.push_back(path[best]);
  }
  return places;
}

/// y of a path of an edge where it passes the vertical plane through `p` along the line of sight: the view from the
/// front (`sight` = +z), or from a side. The mean if it passes several times, nullopt if it does not.
std::optional<double> height_behind(const Surface& surface, std::span<const SurfaceVertexId> path, const glm::dvec3& p,
                                    const glm::dvec3& sight) {
  const glm::dvec3 across(sight.z, 0.0, -sight.x);
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const glm::dvec3& a = surface.positions[path[i - 1].value()];
    const glm::dvec3& b = surface.positions[path[i].value()];
    const double from = glm::dot(a - p, across);
    const double to = glm::dot(b - p, across);
    if ((from < 0.0) == (to < 0.0)) continue;
    sum += a.y + (b.y - a.y) * from / (from - to);
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

/// The height at which a vertex of an edge, on its way to corner `c`, meets the other edge: as seen from the front the
/// other edge's height there. An upper lid in front of the lower one overlaps it at the outer corner, as on real eyes:
/// it goes down to where they meet as seen from the side, or the eyeball would be seen between them.
std::optional<double> meeting_height(const Surface& surface, const LidEdge& edge, const LidEdge& other, std::size_t c,
                                     const glm::dvec3& p, bool is_upper) {
  std::optional<double> from_front;
  for (const auto& path : other.to_corner) {
    if (!from_front) from_front = height_behind(surface, path, p, {0.0, 0.0, 1.0});
  }
  if (!is_upper || c != LidEdge::outer) return from_front;
  const double side = edge.corners[c].position.x < edge.middle.position.x ? -1.0 : 1.0;
  const auto from_side =
      height_behind(surface, other.to_corner[c], p, {side * std::sin(side_view), 0.0, std::cos(side_view)});
  if (!from_front || !from_side) return from_front ? from_front : from_side;
  return std::min(*from_front, *from_side);
}

/// Where a place lies between the corners of an edge: from 0 at the inner to 1 at the outer one.
double place_between_corners(const LidEdge& edge, const glm::dvec3& p) {
  const glm::dvec3 axis = edge.corners[1].position - edge.corners[0].position;
  return std::clamp(glm::dot(p - edge.corners[0].position, axis) / glm::dot(axis, axis), 0.0, 1.0);
}

/// The share of the middle of a lid that is closed on the neutral face: an arc, 1 in the middle and 0 at the corners.
double arc_share(const LidEdge& edge, const glm::dvec3& p) {
  const double at = place_between_corners(edge, p);
  const double middle = place_between_corners(edge, edge.middle.position);
  const double to_corner = at < middle ? (middle - at) / middle : middle < 1.0 ? (at - middle) / (1.0 - middle) : 0.0;
  return 1.0 - to_corner * to_corner;
}

/// A place on a lid that follows its middle point by `middle`, and the corners by the rest.
MarginSite site_between_corners(const LidEdge& edge, SurfaceVertexId vertex, const glm::dvec3& p, double middle) {
  const double to_outer = place_between_corners(edge, p);
  MarginSite site{vertex, {}};
  for (const auto& [id, share] :
       {std::pair(edge.middle.id, middle), std::pair(edge.corners[0].id, (1.0 - middle) * (1.0 - to_outer)),
        std::pair(edge.corners[1].id, (1.0 - middle) * to_outer)}) {
    if (share > 0.0) site.shares.emplace_back(id, share);
  }
  return site;
}

/// How far the places on the edge of a lid follow its middle.
class LidShares {
 public:
  LidShares(const Surface& surface, const LidEdge& edge, const LidEdge& other, bool is_upper)
      : surface_(surface), edge_(edge), other_(other), is_upper_(is_upper) {
    height_ = is_upper ? opening_height(edge, other) : opening_height(other, edge);
    const double width = glm::distance(edge.corners[0].position, edge.corners[1].position);
    is_open_ = smooth_step(closed_height, open_height, height_ / width);
    is_slanted_ = height_ > std::abs(edge.middle.position.y - other.middle.position.y);
  }

  /// Of a slanted eye: its height is estimated, so that the middle too follows its point by what it has to go.
  [[nodiscard]] bool is_slanted() const { return is_slanted_; }

  /// At a place `p` on the way to corner `c`.
  [[nodiscard]] double at(std::size_t c, const glm::dvec3& p) const {
    // Beyond the end of the other edge there is no opening.
    const double across = meeting_height(surface_, edge_, other_, c, p, is_upper_).value_or(p.y);
    const double by_height = height_ > 0.0 ? std::clamp(std::abs(p.y - across) / height_, 0.0, 1.0) : 0.0;
    const double arc = is_open_ < 1.0 ? arc_share(edge_, p) : 0.0;
    return is_open_ * by_height + (1.0 - is_open_) * arc;
  }

 private:
  const Surface& surface_;
  const LidEdge& edge_;
  const LidEdge& other_;
  bool is_upper_;
  double height_;
  double is_open_;
  bool is_slanted_;
};

void add_lid_sites(const Surface& surface, const LidEdge& edge, const LidEdge& other, bool is_upper,
                   std::vector<MarginSite>& sites) {
  const LidShares shares(surface, edge, other, is_upper);
  if (shares.is_slanted()) {
    const glm::dvec3& p = edge.middle.position;
    sites.push_back(site_between_corners(edge, edge.middle.vertex, p, shares.at(LidEdge::inner, p)));
    sites.back().replaces_points = true;
  }
  for (std::size_t c = 0; c < 2; ++c) {
    const auto& path = edge.to_corner[c];
    std::vector<SurfaceVertexId> places = places_on(surface, path, places_of_lid);
    if (!edge.ends_at_corner[c] && !path.empty()) places.push_back(path.back());
    const SurfaceVertexId corner = edge.corners[c].vertex;
    const bool leads_through_corner = !path.empty() && std::find(path.begin(), path.end(), corner) < path.end() - 1;
    if (leads_through_corner && std::find(places.begin(), places.end(), corner) == places.end())
      places.push_back(corner);
    for (const SurfaceVertexId vertex : places) {
      const glm::dvec3& p = surface.positions[vertex.value()];
      sites.push_back(site_between_corners(edge, vertex, p, shares.at(c, p)));
      sites.back().replaces_points = leads_through_corner && vertex == corner;
    }
  }
}

bool is_on(const LidEdge& edge, SurfaceVertexId vertex) {
  return std::any_of(edge.to_corner.begin(), edge.to_corner.end(),
                     [vertex](const auto& path) { return std::find(path.begin(), path.end(), vertex) != path.end(); });
}

/// The skin of a lid and around it.
std::vector<SurfaceVertexId> skin_about(const Surface& surface, const LidEdge& lid, double reach) {
  std::vector<SurfaceVertexId> skin;
  for (const SurfaceVertexId v : surface.members_of(surface.part_of[lid.middle.vertex.value()])) {
    if (glm::distance(surface.positions[v.value()], lid.middle.position) < reach) skin.push_back(v);
  }
  return skin;
}

/// Moves a site from the edge of a lid up to its fold: to `height`, the share of the way between them.
void follow_fold(MarginSite& site, FeaturePointId edge, FeaturePointId fold, double height) {
  site.is_edge = false;
  const auto middle =
      std::find_if(site.shares.begin(), site.shares.end(), [edge](const auto& s) { return s.first == edge; });
  if (middle == site.shares.end()) return;
  const double of_edge = (1.0 - height) * middle->second;
  *middle = {fold, height * middle->second};
  if (of_edge > 0.0) site.shares.emplace_back(edge, of_edge);
}

/// The fold of an upper lid: as far from the edge as its point in the middle, and ever nearer towards the corners,
/// where it ends in the edge. It follows its point as the edge below it follows the middle of the edge; a vertex below
/// the line follows both, each by its share of the way to the other.
void add_fold_sites(const Surface& surface, const EyeEdges& eye, const LidEdge& lid, const SurfacePoint& fold,
                    std::vector<MarginSite>& sites) {
  if (surface.part_of[fold.vertex.value()] != surface.part_of[lid.middle.vertex.value()]) return;
  const glm::dvec3 from_edge = fold.position - lid.middle.position;
  const double reach = glm::length(from_edge) + glm::distance(lid.corners[0].position, lid.corners[1].position);
  const std::vector<SurfaceVertexId> skin = skin_about(surface, lid, reach);
  const LidShares shares(surface, lid, eye.lower, true);
  for (std::size_t c = 0; c < 2; ++c) {
    for (const SurfaceVertexId beside : places_on(surface, lid.to_corner[c], places_of_fold)) {
      const glm::dvec3& edge = surface.positions[beside.value()];
      const double share = arc_share(lid, edge);
      if (share < middle_of_fold) continue;
      const auto off = [&, place = edge + share * from_edge](SurfaceVertexId v) {
        return glm::distance(surface.positions[v.value()], place);
      };
      const SurfaceVertexId vertex = *std::min_element(
          skin.begin(), skin.end(), [&off](SurfaceVertexId a, SurfaceVertexId b) { return off(a) < off(b); });
      if (is_on(eye.upper, vertex) || is_on(eye.lower, vertex)) continue;
      if (off(vertex) > greatest_step_to_fold * share * glm::length(from_edge)) continue;
      const glm::dvec3 above_edge = surface.positions[vertex.value()] - edge;
      const double height = glm::dot(above_edge, from_edge) / (share * glm::dot(from_edge, from_edge));
      sites.push_back(site_between_corners(lid, vertex, edge, shares.at(c, edge)));
      follow_fold(sites.back(), lid.middle.id, fold.id, std::clamp(height, 0.0, 1.0));
    }
  }
}

void add_rim_sites(const Surface& surface, const EyeEdges& eye, const ModelledEye& modelled,
                   std::vector<MarginSite>& sites) {
  for (const ModelledEye::RimPlace& place : modelled.rim) {
    const LidEdge& edge = place.is_upper ? eye.upper : eye.lower;
    sites.push_back(site_between_corners(edge, place.vertex, surface.positions[place.vertex.value()], place.share));
  }
}

void add_lids(const Surface& surface, std::span<const SurfacePoint> points, const ModelledEyes& modelled,
              std::span<const Part> parts, std::vector<MarginSite>& sites) {
  const std::array<std::optional<EyeEdges>, 2> eyes = {find_eye_edges(surface, points, 0, parts),
                                                       find_eye_edges(surface, points, 1, parts)};
  for (std::size_t k = 0; k < eyes.size(); ++k) {
    const auto& eye = eyes[k];
    if (!eye) continue;
    if (modelled[k]) {
      add_rim_sites(surface, *eye, *modelled[k], sites);
      continue;
    }
    add_lid_sites(surface, eye->upper, eye->lower, true, sites);
    add_lid_sites(surface, eye->lower, eye->upper, false, sites);
  }
  for (std::size_t k = 0; k < eyes.size(); ++k) {
    if (!eyes[k]) continue;
    const SurfacePoint* const fold = point_named(points, k == 0 ? "3.13" : "3.14");
    const SurfacePoint* const brow = point_named(points, k == 0 ? "4.3" : "4.4");
    if (fold == nullptr || brow == nullptr) continue;
    const LidEdge& upper = eyes[k]->upper;
    const double width = glm::distance(upper.corners[0].position, upper.corners[1].position);
    if (glm::distance(fold->position, brow->position) < near_brow * width)
      add_fold_sites(surface, *eyes[k], upper, *fold, sites);
  }
}

using Shares = std::vector<std::pair<FeaturePointId, double>>;

/// The shares of the points of a lip at a vertex on its edge; none elsewhere.
Shares shares_on(const Surface& surface, const LipEdge& lip, SurfaceVertexId vertex) {
  for (std::size_t i = 0; i < lip.between.size(); ++i) {
    const auto& line = lip.between[i];
    if (std::find(line.begin(), line.end(), vertex) == line.end()) continue;
    const SurfacePoint& a = *lip.points[i];
    const SurfacePoint& b = *lip.points[i + 1];
    if (a.position.x == b.position.x) continue;
    const double x = surface.positions[vertex.value()].x;
    const double t = std::clamp((x - a.position.x) / (b.position.x - a.position.x), 0.0, 1.0);
    // The mean of linear interpolation, which has corners at the points, and a curve with slope zero at them.
    const double to_b = (t + t * t * (3.0 - 2.0 * t)) / 2.0;
    Shares shares;
    if (to_b < 1.0) shares.emplace_back(a.id, 1.0 - to_b);
    if (to_b > 0.0) shares.emplace_back(b.id, to_b);
    return shares;
  }
  return {};
}

Shares mean_of(const Shares& a, const Shares& b) {
  Shares mean;
  for (const Shares* const shares : {&a, &b}) {
    for (const auto& [id, share] : *shares) {
      const auto at = std::find_if(mean.begin(), mean.end(), [id = id](const auto& m) { return m.first == id; });
      if (at != mean.end()) {
        at->second += share / 2.0;
      } else {
        mean.emplace_back(id, share / 2.0);
      }
    }
  }
  return mean;
}

void add_lips(const Surface& surface, std::span<const SurfacePoint> points, std::vector<MarginSite>& sites) {
  const LipEdges lips = find_lip_edges(surface, points);
  for (const auto& [lip, other] : {std::pair(&lips.upper, &lips.lower), std::pair(&lips.lower, &lips.upper)}) {
    for (const auto& line : lip->between) {
      for (const SurfaceVertexId vertex : places_on(surface, line, places_of_lip)) {
        Shares shares = shares_on(surface, *lip, vertex);
        const Shares of_other = shares_on(surface, *other, vertex);
        if (!of_other.empty()) shares = mean_of(shares, of_other);
        if (!shares.empty()) sites.push_back({vertex, std::move(shares)});
      }
    }
    for (std::size_t i = 1; i + 1 < lip->points.size(); ++i) {
      if (lip->points[i] == nullptr) continue;
      const SurfaceVertexId vertex = lip->points[i]->vertex;
      const Shares shares = shares_on(surface, *lip, vertex);
      const Shares of_other = shares_on(surface, *other, vertex);
      if (!shares.empty() && !of_other.empty()) sites.push_back({vertex, mean_of(shares, of_other), true});
    }
  }
}

}  // namespace

std::vector<MarginSite> margin_sites(const Surface& surface, std::span<const SurfacePoint> points,
                                     const ModelledEyes& modelled, std::span<const Part> parts) {
  std::vector<MarginSite> sites;
  add_lids(surface, points, modelled, parts, sites);
  add_lips(surface, points, sites);
  // A vertex with a point follows that point, unless it is on the line of both lips.
  std::vector<MarginSite> result;
  for (MarginSite& site : sites) {
    const bool is_point =
        std::any_of(points.begin(), points.end(), [&](const SurfacePoint& p) { return p.vertex == site.vertex; });
    const bool is_known =
        std::any_of(result.begin(), result.end(), [&](const MarginSite& s) { return s.vertex == site.vertex; });
    if ((!is_point || site.replaces_points) && !is_known) result.push_back(std::move(site));
  }
  return result;
}

}  // namespace semblante
