#include "core/parametrize/smooth_weights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <optional>

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

/// One site for each point of a part. A point on the edge of a lip or lid has the shares of its margin.
std::vector<KrigingSite> sites_of_points(const PointDistances& distances, std::span<const MarginSite> margins) {
  std::vector<KrigingSite> sites = point_sites(distances);
  for (const MarginSite& margin : margins) {
    if (!margin.replaces_points) continue;
    const auto at =
        std::find_if(sites.begin(), sites.end(), [&](const KrigingSite& site) { return site.vertex == margin.vertex; });
    if (at != sites.end()) at->shares = margin.shares;
  }
  return sites;
}

/// The rows of the vertices of one part, cavities apart.
class SmoothRows {
 public:
  SmoothRows(const Surface& surface, const PointDistances& distances, const std::vector<KrigingSite>& of_points,
             std::span<const MarginSite> margins, double unit, const WeightPrior& prior)
      : surface_(surface),
        distances_(distances),
        unit_(unit),
        prior_(prior),
        points_(surface, distances, of_points, unit, between_points),
        edges_(find_corrections(of_points, margins)),
        kept_at_(distances.members.size(), nowhere) {
    for (const SurfacePoint& point : distances.points)
      places_[point.id.value()] = {point.vertex.value(), point.position / unit};
  }

  [[nodiscard]] Row at(std::size_t member) {
    if (kept_at_[member] != nowhere) return kept_[kept_at_[member]];
    Row row = row_of_points(points_, member);
    for (const SiteKriging::Term& term : edges_.at(member)) {
      const auto site = static_cast<std::size_t>(term.site - edges_.sites().data());
      if (site >= corrections_.size()) continue;
      corrections_[site].for_each([&](std::size_t id, double w) { row.at(id) += term.weight * w; });
    }
    cut(row);
    keep_greatest(row);
    prior_.correct(row, surface_.positions[distances_.members[member].value()] / unit_, places_);
    keep_greatest(row);
    return row;
  }

  /// The same, kept for later calls: cavities ask for the rows of their rim and of the skin in front again and again.
  const Row& keep(std::size_t member) {
    if (kept_at_[member] == nowhere) {
      kept_.push_back(at(member));
      kept_at_[member] = static_cast<std::uint32_t>(kept_.size() - 1);
    }
    return kept_[kept_at_[member]];
  }

 private:
  static constexpr std::uint32_t nowhere = 0xFFFFFFFFU;

  /// The corrections at the edges: their rows minus those from the points alone; zero at the points themselves.
  SiteKriging find_corrections(const std::vector<KrigingSite>& of_points, std::span<const MarginSite> margins) {
    std::vector<KrigingSite> sites = edge_sites(surface_, distances_, margins);
    for (const KrigingSite& site : sites) {
      Row& correction = corrections_.emplace_back();
      add(correction, site, 1.0);
      const Row plain = row_of_points(points_, member_of(distances_, site.vertex));
      plain.for_each([&](std::size_t id, double w) { correction.at(id) -= w; });
    }
    sites.insert(sites.end(), of_points.begin(), of_points.end());
    return {surface_, distances_, std::move(sites), unit_, at_edges};
  }

  const Surface& surface_;
  const PointDistances& distances_;
  double unit_;
  const WeightPrior& prior_;
  WeightPrior::Places places_;
  SiteKriging points_;
  std::vector<Row> corrections_;  ///< of the first sites of edges_; the others are the points
  SiteKriging edges_;
  std::vector<std::uint32_t> kept_at_;  ///< by member: in kept_
  std::deque<Row> kept_;                ///< its rows stay where they are
};

/// Rows of the cavities of a part, which continue those of their rims.
class CavityRows {
 public:
  CavityRows(const Surface& surface, const PointDistances& distances, const std::vector<Cavity>& cavities, double unit,
             SmoothRows& rows)
      : places_(distances.members.size()) {
    const auto row_of = [&](SurfaceVertexId vertex) -> const Row& { return rows.keep(member_of(distances, vertex)); };
    for (const Cavity& cavity : cavities) {
      const std::size_t table = tables_.size();
      tables_.push_back(cavity_rows(surface, cavity, unit, row_of));
      for (std::size_t row = 0; row < cavity.members.size(); ++row)
        places_[member_of(distances, cavity.members[row])] = Place{table, row};
    }
  }

  /// Appends the row of a member; returns false if it is in no cavity.
  bool push(std::size_t member, WeightTable<double>& table) const {
    const std::optional<Place>& place = places_[member];
    if (!place) return false;
    const WeightTable<double>& rows = tables_[place->table];
    for (std::size_t k = 0; k < rows.points_of(place->row).size(); ++k)
      table.push(rows.points_of(place->row)[k], rows.weights_of(place->row)[k]);
    table.end_row();
    return true;
  }

 private:
  struct Place {
    std::size_t table, row;
  };
  std::vector<WeightTable<double>> tables_;   ///< one of each cavity
  std::vector<std::optional<Place>> places_;  ///< by member
};

}  // namespace

double weight_unit(const PointDistances& distances, double eye_separation) {
  return unit_length(point_sites(distances), eye_separation);
}

WeightTable<double> smooth_part_weights(const Surface& surface, const PointDistances& distances, double eye_separation,
                                        std::span<const MarginSite> margins, const WeightPrior& prior,
                                        const ModelledEyes& modelled) {
  const std::vector<KrigingSite> of_points = sites_of_points(distances, margins);
  const double unit = unit_length(of_points, eye_separation);
  SmoothRows rows(surface, distances, of_points, margins, unit, prior);
  const PartId part = surface.part_of[distances.members.front().value()];
  const std::vector<Cavity> cavities = cavities_with_target(surface, part, distances.points, modelled);
  const CavityRows in_cavities(surface, distances, cavities, unit, rows);

  WeightTable<double> table;
  for (std::size_t m = 0; m < distances.members.size(); ++m) {
    if (is_held(modelled, distances.members[m])) {
      table.end_row();
    } else if (!in_cavities.push(m, table)) {
      push_row(table, rows.at(m));
    }
  }
  return table;
}

}  // namespace semblante
