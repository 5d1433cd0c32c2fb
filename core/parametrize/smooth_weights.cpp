#include "core/parametrize/smooth_weights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <glm/geometric.hpp>

#include "core/parametrize/non_negative_kriging.h"

namespace semblante {
namespace {

// Chosen by tests/bench/bench_weights on 14 expressions of a real head; all lengths in ES0.
/// Covariance of two places r apart: exp(-(r / kernel_length)^kernel_power). Powers up to 2 are positive definite. 1
/// follows the expressions as well but has a sharper peak at each point; 2 rings.
constexpr double kernel_length = 0.40;
constexpr double kernel_power = 1.2;
/// Taken off every covariance to a target, so that what a far point adds is zero and not merely little: weights end
/// kernel_length * ln(1 / least)^(1 / kernel_power) = 1.0 ES0 away, and fewer points share a vertex.
constexpr double least_covariance = 0.05;
/// Detour = way along the surface / straight distance. Lips and lids nearly touch, so the straight distance alone says
/// that one moves the other; the way round by the corner says it does not. Full trust below, none above. Ways along
/// edges are up to half again too long on a flat quad mesh, hence the lower bound.
constexpr double trusted_detour = 1.6;
constexpr double greatest_detour = 3.5;
/// The share of the root, 1 - sum, is raised to this power: among the points the sum is nearly one, and it still ends
/// smoothly.
constexpr double root_power = 1.5;
/// A weight below this moves nothing one can see; it would only cost a place in the table.
constexpr double least_weight = 1e-4;
/// Where ES0 is not known: it is about this many times the root mean square distance of a face's points to their
/// centre.
constexpr double eye_separation_per_spread = 0.85;
/// Parts with points close together (a tongue) are worked on in their own measure.
constexpr double greatest_unit_per_spread = 2.0;

double kernel(double distance_in_units) { return std::exp(-std::pow(distance_in_units / kernel_length, kernel_power)); }

double trust(double detour) {
  const double t = std::clamp((greatest_detour - detour) / (greatest_detour - trusted_detour), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// A vertex with one or more points on it.
struct Site {
  SurfaceVertexId vertex;
  glm::dvec3 position;
  std::size_t slot;  ///< of its first point
  std::vector<FeaturePointId> ids;
};

std::vector<Site> find_sites(const PointDistances& distances) {
  std::vector<Site> sites;
  for (std::size_t slot = 0; slot < distances.points.size(); ++slot) {
    const SurfacePoint& point = distances.points[slot];
    const auto at = std::find_if(sites.begin(), sites.end(), [&](const Site& s) { return s.vertex == point.vertex; });
    if (at != sites.end()) {
      at->ids.push_back(point.id);
    } else {
      sites.push_back({point.vertex, point.position, slot, {point.id}});
    }
  }
  return sites;
}

/// The length that distances are measured in.
double unit_length(std::span<const Site> sites, double eye_separation) {
  glm::dvec3 center(0.0);
  for (const Site& site : sites) center += site.position / static_cast<double>(sites.size());
  double sum = 0.0;
  for (const Site& site : sites) sum += glm::dot(site.position - center, site.position - center);
  const double spread = std::sqrt(sum / static_cast<double>(sites.size()));
  if (!(eye_separation > 0.0)) return eye_separation_per_spread * spread;
  return spread > 0.0 ? std::min(eye_separation, greatest_unit_per_spread * spread) : eye_separation;
}

std::vector<double> covariances(std::span<const Site> sites, double unit) {
  std::vector<double> matrix;
  for (const Site& a : sites) {
    for (const Site& b : sites) {
      // Points of touching lips may be at one place; the diagonal keeps the matrix definite.
      matrix.push_back(&a == &b ? 1.0 + 1e-9 : kernel(glm::distance(a.position, b.position) / unit));
    }
  }
  return matrix;
}

/// Leaves the greatest weights and their sum. What the greatest weight without a place is worth is taken off all of
/// them, so that a weight is zero when it loses its place. Where that would leave almost nothing (many points equally
/// far) no choice is continuous: there the greatest are kept as they are, at equal weight those of lower ids.
void keep_greatest(std::vector<double>& weights, std::vector<std::size_t>& order) {
  if (weights.size() <= max_smooth_influences) return;
  order.resize(weights.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::partial_sort(
      order.begin(), order.begin() + max_smooth_influences + 1, order.end(),
      [&](std::size_t a, std::size_t b) { return weights[a] != weights[b] ? weights[a] > weights[b] : a < b; });
  const double first_out = weights[order[max_smooth_influences]];
  if (!(first_out > 0.0)) return;
  double all = 0.0;
  double kept = 0.0;
  double lowered = 0.0;
  for (const double w : weights) all += w;
  for (std::size_t k = 0; k < max_smooth_influences; ++k) {
    kept += weights[order[k]];
    lowered += weights[order[k]] - first_out;
  }
  const double share = std::min(1.0, lowered / (all / 4.0));  // of the continuous choice
  for (std::size_t k = 0; k < order.size(); ++k) {
    double& w = weights[order[k]];
    if (k >= max_smooth_influences) {
      w = 0.0;
    } else {
      w = all * ((share > 0.0 ? share * (w - first_out) / lowered : 0.0) + (1.0 - share) * w / kept);
    }
  }
}

/// Brings the sum to 1 - (1 - sum)^root_power.
void raise_sum(std::vector<double>& weights) {
  double sum = 0.0;
  for (const double w : weights) sum += w;
  if (!(sum > 0.0)) return;
  const double raised = 1.0 - std::pow(std::max(0.0, 1.0 - sum), root_power);
  for (double& w : weights) w *= raised / sum;
}

}  // namespace

WeightTable<double> smooth_part_weights(const Surface& surface, const PointDistances& distances,
                                        double eye_separation) {
  const std::vector<Site> sites = find_sites(distances);
  const double unit = unit_length(sites, eye_separation);
  const double reach = unit * kernel_length * std::pow(-std::log(least_covariance), 1.0 / kernel_power);
  NonNegativeKriging kriging(covariances(sites, unit), sites.size());

  WeightTable<double> table;
  std::vector<std::size_t> candidates;
  std::vector<double> to_target;
  std::vector<double> weights;
  std::vector<std::size_t> order;
  std::vector<std::pair<FeaturePointId, double>> row;
  for (std::size_t m = 0; m < distances.members.size(); ++m) {
    const SurfaceVertexId vertex = distances.members[m];
    const glm::dvec3& p = surface.positions[vertex.value()];
    const std::span<const double> along_surface = distances.of_member(m);
    candidates.clear();
    to_target.clear();
    row.clear();
    bool at_site = false;
    for (std::size_t s = 0; s < sites.size() && !at_site; ++s) {
      const double straight = glm::distance(p, sites[s].position);
      const double along = along_surface[sites[s].slot];
      at_site = along == 0.0;
      if (at_site) candidates.clear();
      if (!at_site && (straight >= reach || along >= greatest_detour * straight)) continue;
      const double covariance = at_site ? 1.0 : kernel(straight / unit) * trust(along / straight);
      if (!(covariance > least_covariance)) continue;
      candidates.push_back(s);
      to_target.push_back((covariance - least_covariance) / (1.0 - least_covariance));
    }
    if (at_site) {
      weights.assign(1, 1.0);
    } else {
      const std::span<const double> solution = kriging.solve(candidates, to_target);
      weights.assign(solution.begin(), solution.end());
      keep_greatest(weights, order);
      raise_sum(weights);
    }
    for (std::size_t c = 0; c < candidates.size(); ++c) {
      const Site& site = sites[candidates[c]];
      const double share = weights[c] / static_cast<double>(site.ids.size());
      if (share < least_weight) continue;
      for (const FeaturePointId id : site.ids) row.emplace_back(id, share);
    }
    std::sort(row.begin(), row.end());
    for (const auto& [id, weight] : row) table.push(id, weight);
    table.end_row();
  }
  return table;
}

}  // namespace semblante
