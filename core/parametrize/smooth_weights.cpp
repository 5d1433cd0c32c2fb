#include "core/parametrize/smooth_weights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>

#include <glm/geometric.hpp>

#include "core/parametrize/cavity_weights.h"
#include "core/parametrize/greatest_weights.h"
#include "core/parametrize/site_kriging.h"

namespace semblante {
namespace {

// Chosen by tests/bench/bench_weights on 14 expressions of a real head; all lengths in ES0.
/// Powers: 1 matches the expressions equally well but has a sharper peak at each point; 2 oscillates. The subtracted
/// value makes weights end at 1.0 ES0, so that fewer points share a vertex.
constexpr KrigingKernel between_points = {0.40, 1.2, 0.05};
/// Near the edges of lips and lids, whose motion is known better.
constexpr KrigingKernel at_edges = {0.07, 1.2, 0.05};
/// Weights with at least this sum are scaled to a sum of one: nearly all of the face between its points. Below, the
/// root gets a share of (1 - sum / full_sum)^root_power, which begins and ends smoothly.
constexpr double full_sum = 0.8;
constexpr double root_power = 1.5;
/// For heads without ES0: it is about this many times the root mean square distance of a face's points to their centre.
constexpr double eye_separation_per_spread = 0.85;
/// Parts with points close together (a tongue) get their own unit.
constexpr double greatest_unit_per_spread = 2.0;

using Row = WeightRow;

/// The length that distances are measured in.
double unit_length(std::span<const KrigingSite> sites, double eye_separation) {
  glm::dvec3 center(0.0);
  for (const KrigingSite& site : sites) center += site.position / static_cast<double>(sites.size());
  double sum = 0.0;
  for (const KrigingSite& site : sites) sum += glm::dot(site.position - center, site.position - center);
  const double spread = std::sqrt(sum / static_cast<double>(sites.size()));
  if (!(eye_separation > 0.0)) return eye_separation_per_spread * spread;
  return spread > 0.0 ? std::min(eye_separation, greatest_unit_per_spread * spread) : eye_separation;
}

/// Brings the sum to 1 - (1 - sum / full_sum)^root_power.
void raise_sum(Row& weights) {
  const double sum = sum_of(weights);
  if (!(sum > 0.0)) return;
  const double raised = 1.0 - std::pow(std::max(0.0, 1.0 - sum / full_sum), root_power);
  weights.scale(raised / sum);
}

void add(Row& row, const KrigingSite& site, double weight) {
  for (const auto& [id, share] : site.shares) row.at(id.value()) += weight * share;
}

/// Sets negative weights to zero and keeps the sum, at most one.
void cut(Row& row) {
  const double sum = std::clamp(sum_of(row), 0.0, 1.0);
  row.for_each([](std::size_t, double& w) { w = std::max(0.0, w); });
  const double more = sum_of(row);
  if (more > sum) row.scale(sum / more);
}

/// The row of a member from the points alone.
Row row_of_points(SiteKriging& points, std::size_t member) {
  Row row;
  for (const SiteKriging::Term& term : points.at(member)) add(row, *term.site, term.weight);
  raise_sum(row);
  return row;
}

std::size_t member_of(const PointDistances& distances, SurfaceVertexId vertex) {
  const auto at = std::lower_bound(distances.members.begin(), distances.members.end(), vertex);
  return static_cast<std::size_t>(at - distances.members.begin());
}

/// The sockets of the eyes that are not modelled in the skin, and the mouth if the jaw's point is marked.
std::vector<Cavity> cavities_with_target(const Surface& surface, PartId part, std::span<const SurfacePoint> points,
                                         const ModelledEyes& modelled) {
  std::vector<Cavity> cavities = find_cavities(surface, part, points);
  const bool has_jaw = std::any_of(points.begin(), points.end(),
                                   [](const SurfacePoint& p) { return p.id == parse_feature_point("2.1"); });
  if (!has_jaw) std::erase_if(cavities, [](const Cavity& c) { return c.is_mouth; });
  std::erase_if(cavities, [&](const Cavity& c) {
    return !c.is_mouth &&
           std::any_of(c.members.begin(), c.members.end(), [&](SurfaceVertexId v) { return is_held(modelled, v); });
  });
  return cavities;
}

}  // namespace

double weight_unit(const PointDistances& distances, double eye_separation) {
  return unit_length(point_sites(distances), eye_separation);
}

WeightTable<double> smooth_part_weights(const Surface& surface, const PointDistances& distances, double eye_separation,
                                        std::span<const MarginSite> margins, const WeightPrior& prior,
                                        const ModelledEyes& modelled) {
  std::vector<KrigingSite> of_points = point_sites(distances);
  for (const MarginSite& margin : margins) {
    if (!margin.replaces_points) continue;
    const auto at = std::find_if(of_points.begin(), of_points.end(),
                                 [&](const KrigingSite& site) { return site.vertex == margin.vertex; });
    if (at != of_points.end()) at->shares = margin.shares;
  }
  const double unit = unit_length(of_points, eye_separation);
  std::vector<KrigingSite> of_edges = edge_sites(surface, distances, margins);
  SiteKriging points(surface, distances, of_points, unit, between_points);

  // The corrections at the edges: their rows minus those from the points alone; zero at the points themselves.
  std::vector<Row> corrections;
  for (const KrigingSite& site : of_edges) {
    Row& correction = corrections.emplace_back();
    add(correction, site, 1.0);
    const Row plain = row_of_points(points, member_of(distances, site.vertex));
    plain.for_each([&](std::size_t id, double w) { correction.at(id) -= w; });
  }
  const std::size_t edge_count = of_edges.size();
  of_edges.insert(of_edges.end(), of_points.begin(), of_points.end());
  SiteKriging edges(surface, distances, std::move(of_edges), unit, at_edges);

  // Rows of the cavities continue those of their rims.
  const PartId part = surface.part_of[distances.members.front().value()];
  const std::vector<Cavity> cavities = cavities_with_target(surface, part, distances.points, modelled);
  constexpr std::uint32_t none = 0xFFFFFFFFU;
  struct CavityRow {
    std::uint32_t cavity = none;
    std::uint32_t row = none;
  };
  std::vector<CavityRow> in_cavity(distances.members.size());
  std::vector<WeightTable<double>> cavity_rows_of;
  WeightPrior::Places places;
  for (const SurfacePoint& point : distances.points)
    places[point.id.value()] = {point.vertex.value(), point.position / unit};
  const auto smooth_row = [&](std::size_t m) {
    Row row = row_of_points(points, m);
    for (const SiteKriging::Term& term : edges.at(m)) {
      const auto site = static_cast<std::size_t>(term.site - edges.sites().data());
      if (site >= edge_count) continue;
      corrections[site].for_each([&](std::size_t id, double w) { row.at(id) += term.weight * w; });
    }
    cut(row);
    keep_greatest(row);
    prior.correct(row, surface.positions[distances.members[m].value()] / unit, places);
    keep_greatest(row);
    return row;
  };
  // Cavities ask for the same rows again and again: those of the rim and of the skin in front.
  std::vector<std::uint32_t> kept_at(distances.members.size(), none);
  std::deque<Row> kept;  // its rows stay where they are
  const auto kept_row = [&](SurfaceVertexId vertex) -> const Row& {
    const std::size_t m = member_of(distances, vertex);
    if (kept_at[m] == none) {
      kept_at[m] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(smooth_row(m));
    }
    return kept[kept_at[m]];
  };
  for (const Cavity& cavity : cavities) {
    const auto c = static_cast<std::uint32_t>(cavity_rows_of.size());
    cavity_rows_of.push_back(cavity_rows(surface, cavity, unit, kept_row));
    for (std::size_t k = 0; k < cavity.members.size(); ++k) {
      in_cavity[member_of(distances, cavity.members[k])] = {c, static_cast<std::uint32_t>(k)};
    }
  }

  WeightTable<double> table;
  for (std::size_t m = 0; m < distances.members.size(); ++m) {
    if (is_held(modelled, distances.members[m])) {
      table.end_row();
    } else if (const auto [cavity, row] = in_cavity[m]; cavity != none) {
      const WeightTable<double>& rows = cavity_rows_of[cavity];
      for (std::size_t k = 0; k < rows.points_of(row).size(); ++k) {
        table.push(rows.points_of(row)[k], rows.weights_of(row)[k]);
      }
      table.end_row();
    } else {
      push_row(table, kept_at[m] != none ? kept[kept_at[m]] : smooth_row(m));
    }
  }
  return table;
}

}  // namespace semblante
