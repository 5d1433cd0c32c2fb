#include "tests/oracle/literal_weights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace semblante::oracle {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

Edge edge_of(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

Point3 minus(const Point3& a, const Point3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Point3& a, const Point3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double norm(const Point3& a) { return std::sqrt(dot(a, a)); }

// ---- section 1 --------------------------------------------------------------------------------------------

/// "A boundary edge has one triangle (by file index). Where boundary edges coincide, both ends at equal positions (as
/// float32, -0 equal to +0), their ends are one surface vertex."
std::vector<std::uint32_t> stitch(const Mesh& mesh) {
  std::set<std::array<std::uint32_t, 3>> different;  // a triangle given twice is one triangle
  for (std::array<std::uint32_t, 3> t : mesh.triangles) {
    std::sort(t.begin(), t.end());
    if (t[0] != t[1] && t[1] != t[2]) different.insert(t);
  }
  std::map<Edge, int> triangles_at;
  for (const auto& t : different) {
    ++triangles_at[edge_of(t[0], t[1])];
    ++triangles_at[edge_of(t[1], t[2])];
    ++triangles_at[edge_of(t[0], t[2])];
  }

  // std::array compares element by element with <, for which -0 and +0 are equal.
  using Place = std::array<float, 3>;
  std::map<std::pair<Place, Place>, std::vector<Edge>> at_places;
  for (const auto& [edge, count] : triangles_at) {
    if (count != 1) continue;
    const Place a = mesh.positions[edge.first];
    const Place b = mesh.positions[edge.second];
    at_places[{std::min(a, b), std::max(a, b)}].push_back(edge);
  }

  std::map<std::uint32_t, std::set<std::uint32_t>> same;  // "are one surface vertex", both directions
  for (const auto& [places, edges] : at_places) {
    for (const Edge& e : edges) {
      for (const Edge& f : edges) {
        if (e == f) continue;
        for (const std::uint32_t v : {e.first, e.second}) {
          for (const std::uint32_t w : {f.first, f.second}) {
            if (mesh.positions[v] == mesh.positions[w]) same[v].insert(w), same[w].insert(v);
          }
        }
      }
    }
  }

  constexpr std::uint32_t unset = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> lowest(mesh.positions.size(), unset);
  for (std::uint32_t v = 0; v < lowest.size(); ++v) {
    if (lowest[v] != unset) continue;
    std::vector<std::uint32_t> pending = {v};
    while (!pending.empty()) {
      const std::uint32_t w = pending.back();
      pending.pop_back();
      if (lowest[w] != unset) continue;
      lowest[w] = v;
      for (const std::uint32_t next : same[w]) pending.push_back(next);
    }
  }
  return lowest;
}

struct Graph {
  std::map<std::uint32_t, Point3> at;                               // surface vertex -> position
  std::map<std::uint32_t, std::map<std::uint32_t, double>> length;  // edge -> Euclidean length
};

Graph build_graph(const Mesh& mesh, const std::vector<std::uint32_t>& surface_of) {
  Graph graph;
  for (std::uint32_t v = 0; v < surface_of.size(); ++v) {
    const auto& p = mesh.positions[surface_of[v]];
    graph.at[surface_of[v]] = {p[0], p[1], p[2]};
  }
  for (const auto& t : mesh.triangles) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t a = surface_of[t[c]];
      const std::uint32_t b = surface_of[t[(c + 1) % 3]];
      if (a == b) continue;
      graph.length[a][b] = graph.length[b][a] = norm(minus(graph.at[a], graph.at[b]));
    }
  }
  return graph;
}

/// "The length of the shortest path along mesh edges": vertices that have none are absent.
std::map<std::uint32_t, double> distances_from(const Graph& graph, std::uint32_t source) {
  std::map<std::uint32_t, double> best = {{source, 0.0}};
  std::set<std::pair<double, std::uint32_t>> pending = {{0.0, source}};
  while (!pending.empty()) {
    const auto [d, v] = *pending.begin();
    pending.erase(pending.begin());
    const auto edges = graph.length.find(v);
    if (edges == graph.length.end()) continue;
    for (const auto& [w, length] : edges->second) {
      const auto known = best.find(w);
      if (known != best.end() && known->second <= d + length) continue;
      if (known != best.end()) pending.erase({known->second, w});
      best[w] = d + length;
      pending.insert({d + length, w});
    }
  }
  return best;
}

// ---- section 4 --------------------------------------------------------------------------------------------

std::set<PointName> region_of(const Point3& p, const std::map<PointName, Point3>& position,
                              const std::map<PointName, double>& distance) {
  std::set<PointName> a;  // 1.
  std::set<PointName> b;
  for (const auto& [name, d] : distance) a.insert(name);
  while (!a.empty()) {
    double least = std::numeric_limits<double>::infinity();  // 2.
    for (const PointName& f : a) least = std::min(least, distance.at(f));
    std::optional<PointName> nearest;
    for (const PointName& f : a) {
      const bool tie = (distance.at(f) - least) <= 1e-6 * least;
      if (tie && !nearest) nearest = f;  // std::set rises: the lower id first
    }
    const PointName f = *nearest;
    a.erase(f);
    b.insert(f);
    const Point3 f_p = minus(position.at(f), p);  // 3.
    std::set<PointName> kept;
    for (const PointName& g : a) {
      const Point3 g_f = minus(position.at(g), position.at(f));
      if (!(dot(g_f, f_p) > 1e-6 * norm(g_f) * norm(f_p))) kept.insert(g);
    }
    a = kept;
  }  // 4.
  return b;
}

// ---- section 5 --------------------------------------------------------------------------------------------

double weight_of(const Point3& p, double d_ip, const Point3& i,
                 const std::vector<std::pair<Point3, double>>& neighbors) {
  std::vector<std::pair<double, double>> valid;  // cos theta_j, d_ij
  for (const auto& [j, d_ij] : neighbors) {
    const Point3 to_p = minus(p, i);
    const Point3 to_j = minus(j, i);
    const double cosine = dot(to_p, to_j) / (norm(to_p) * norm(to_j));
    if (cosine > 1e-6) valid.emplace_back(cosine, d_ij);
  }
  if (valid.empty()) return 0.0;
  double d = 0.0;
  if (valid.size() == 1) {
    d = valid[0].second / valid[0].first;  // Eq. 2
  } else {
    double above = 0.0;  // Eq. 1, Eq. 3
    double below = 0.0;
    for (const auto& [cosine, d_ij] : valid) {
      above += d_ij * cosine;
      below += cosine;
    }
    d = above / below;
  }
  return d_ip < d ? std::sin(std::acos(0.0) * (1.0 - d_ip / d)) : 0.0;  // Eq. 4; acos(0) is pi/2
}

}  // namespace

LiteralResult literal_weights(const Mesh& mesh, const std::map<PointName, std::uint32_t>& points) {
  LiteralResult result;
  result.surface_of = stitch(mesh);
  const Graph graph = build_graph(mesh, result.surface_of);

  std::map<PointName, Point3> position;
  std::map<PointName, std::map<std::uint32_t, double>> distance;
  std::set<std::uint32_t> point_vertices;
  for (const auto& [name, vertex] : points) {
    const std::uint32_t s = result.surface_of[vertex];
    position[name] = graph.at.at(s);
    distance[name] = distances_from(graph, s);
    point_vertices.insert(s);
  }

  std::map<std::uint32_t, std::set<PointName>> regions;
  for (const auto& [s, p] : graph.at) {
    if (point_vertices.count(s) != 0) continue;  // no ordinary vertex
    std::map<PointName, double> reachable;
    for (const auto& [name, from] : distance) {
      const auto found = from.find(s);
      if (found != from.end()) reachable[name] = found->second;
    }
    regions[s] = region_of(p, position, reachable);
  }
  std::map<PointName, std::set<PointName>> neighbors;
  for (const auto& [s, region] : regions) {
    for (const PointName& i : region) {
      for (const PointName& j : region) {
        if (i != j) neighbors[i].insert(j);
      }
    }
  }

  std::map<std::uint32_t, std::map<PointName, double>> weights;
  for (const auto& [s, region] : regions) {
    for (const PointName& i : region) {
      std::vector<std::pair<Point3, double>> around;
      for (const PointName& j : neighbors[i]) {
        around.emplace_back(position[j], distance[i].at(result.surface_of[points.at(j)]));
      }
      const double d_ip = distance[i].at(s);
      const double w = d_ip == 0.0 ? 1.0 : weight_of(graph.at.at(s), d_ip, position[i], around);
      if (w > 0.0) weights[s][i] = w;
    }
  }
  for (const auto& [name, vertex] : points) weights[result.surface_of[vertex]][name] = 1.0;

  for (const std::uint32_t s : result.surface_of) {
    result.weights.push_back(weights[s]);
    result.regions.push_back(regions[s]);
  }
  return result;
}

}  // namespace semblante::oracle
