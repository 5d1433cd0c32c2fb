#include "core/parametrize/site_kriging.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace semblante {
namespace {

/// Steps of a KernelTable.
constexpr std::size_t table_steps = 512;
/// Nearer than this many steps the kernel is too sharp for interpolation.
constexpr std::size_t sharp_steps = 12;

/// Detour = distance along the surface / straight distance. Lips and lids nearly touch, so that by the straight
/// distance alone one would move the other; the path around the corner is long. Full weight below the first value, none
/// above the second. Paths along edges are up to 50 % too long on a flat quad mesh, hence the lower bound.
constexpr double trusted_detour = 1.6;
constexpr double greatest_detour = 3.5;
/// Number of points used to estimate the distance to a place on an edge.
constexpr std::size_t landmark_count = 12;
/// Number of members, in their order, that share a list of the sites within reach: as a rule they are near each other.
constexpr std::size_t block_size = 16;
/// Number of blocks, likewise, whose lists are chosen from one list.
constexpr std::size_t run_length = 16;

double trust(double detour) {
  const double t = std::clamp((greatest_detour - detour) / (greatest_detour - trusted_detour), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// The distance along the surface to a site; without a search from the site a lower bound by the triangle inequality:
/// the difference of the distances from both to a third place.
double way_to(const KrigingSite& site, const PointDistances& distances, std::size_t member) {
  if (site.slot) return distances.at(*site.slot, member);
  double least = 0.0;
  for (const std::size_t at : site.landmarks) {
    least = std::max(least, std::abs(distances.at(at, member) - site.distances[at]));
  }
  return least;
}

std::vector<double> covariances(std::span<const KrigingSite> sites, double unit, const KrigingKernel& kernel) {
  const std::size_t count = sites.size();
  std::vector<double> matrix(count * count);
  for (std::size_t a = 0; a < count; ++a) {
    // Points of touching lips may be at one place; the diagonal keeps the matrix definite.
    matrix[a * count + a] = 1.0 + 1e-9;
    for (std::size_t b = 0; b < a; ++b) {
      const double covariance = kernel.at(glm::distance(sites[a].position, sites[b].position) / unit);
      matrix[a * count + b] = matrix[b * count + a] = covariance;
    }
  }
  return matrix;
}

}  // namespace

std::vector<KrigingSite> point_sites(const PointDistances& distances) {
  std::vector<KrigingSite> sites;
  for (std::size_t slot = 0; slot < distances.points.size(); ++slot) {
    const SurfacePoint& point = distances.points[slot];
    const auto at =
        std::find_if(sites.begin(), sites.end(), [&](const KrigingSite& s) { return s.vertex == point.vertex; });
    if (at != sites.end()) {
      at->shares.emplace_back(point.id, 1.0);
    } else {
      sites.push_back({point.vertex, point.position, {{point.id, 1.0}}, slot, {}, {}});
    }
  }
  for (KrigingSite& site : sites) {
    for (auto& [id, share] : site.shares) share = 1.0 / static_cast<double>(site.shares.size());
  }
  return sites;
}

std::vector<KrigingSite> edge_sites(const Surface& surface, const PointDistances& distances,
                                    std::span<const MarginSite> margins) {
  std::vector<KrigingSite> sites;
  for (const MarginSite& margin : margins) {
    const auto member = std::lower_bound(distances.members.begin(), distances.members.end(), margin.vertex);
    if (member == distances.members.end() || *member != margin.vertex) continue;
    if (std::any_of(distances.points.begin(), distances.points.end(),
                    [&](const SurfacePoint& p) { return p.vertex == margin.vertex; })) {
      continue;
    }
    KrigingSite site{margin.vertex, surface.positions[margin.vertex.value()], margin.shares, std::nullopt, {}, {}};
    distances.of_member(static_cast<std::size_t>(member - distances.members.begin()), site.distances);
    site.landmarks.resize(distances.points.size());
    std::iota(site.landmarks.begin(), site.landmarks.end(), std::size_t{0});
    std::stable_sort(site.landmarks.begin(), site.landmarks.end(),
                     [&](std::size_t a, std::size_t b) { return site.distances[a] < site.distances[b]; });
    site.landmarks.resize(std::min(site.landmarks.size(), landmark_count));
    sites.push_back(std::move(site));
  }
  return sites;
}

double KrigingKernel::at(double distance) const { return std::exp(-std::pow(distance / length, power)); }
double KrigingKernel::reach() const { return length * std::pow(-std::log(least), 1.0 / power); }

KernelTable::KernelTable(const KrigingKernel& kernel)
    : kernel_(kernel), steps_per_unit_(static_cast<double>(table_steps) / kernel.reach()) {
  double value = 1.0;
  double slope = 0.0;  // per step
  for (std::size_t i = 1; i <= table_steps + 1; ++i) {
    const double next = kernel.at(static_cast<double>(i) / steps_per_unit_);
    const double next_slope = kernel.power * std::log(next) * next / static_cast<double>(i);
    const double rise = next - value;
    from_node_.push_back({value, slope, 3.0 * rise - 2.0 * slope - next_slope, slope + next_slope - 2.0 * rise});
    value = next;
    slope = next_slope;
  }
}

double KernelTable::at(double distance) const {
  const double place = distance * steps_per_unit_;
  const auto i = static_cast<std::size_t>(place);
  if (i < sharp_steps) return kernel_.at(distance);
  return from_node_[i].at(place - static_cast<double>(i));
}

SiteKriging::SiteKriging(const Surface& surface, const PointDistances& distances, std::vector<KrigingSite> sites,
                         double unit, KrigingKernel kernel)
    : surface_(surface),
      distances_(distances),
      sites_(std::move(sites)),
      unit_(unit),
      kernel_(kernel),
      table_(kernel),
      reach_(unit * kernel.reach()),
      kriging_(covariances(sites_, unit, kernel), sites_.size()),
      near_run_(distances.members.size() / (run_length * block_size) + 1),
      near_block_(distances.members.size() / block_size + 1) {
  for (std::size_t s = 0; s < sites_.size(); ++s) all_.push_back({sites_[s].position, s});
}

SiteKriging::NearSites SiteKriging::within_reach(const NearSites& sites, std::size_t first, std::size_t count) const {
  glm::dvec3 low(std::numeric_limits<double>::infinity());
  glm::dvec3 high(-low);
  const std::size_t last = std::min(first + count, distances_.members.size());
  for (std::size_t m = first; m < last; ++m) {
    const glm::dvec3& p = surface_.positions[distances_.members[m].value()];
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  NearSites near;
  for (const NearSite& site : sites) {
    if (glm::distance(site.position, glm::clamp(site.position, low, high)) < reach_) near.push_back(site);
  }
  return near;
}

const SiteKriging::NearSites& SiteKriging::near_block(std::size_t block) {
  std::optional<NearSites>& near = near_block_[block];
  if (near) return *near;
  const std::size_t run = block / run_length;
  std::optional<NearSites>& around = near_run_[run];
  if (!around) around = within_reach(all_, run * run_length * block_size, run_length * block_size);
  near = within_reach(*around, block * block_size, block_size);
  return *near;
}

std::span<const SiteKriging::Term> SiteKriging::at(std::size_t member) {
  const SurfaceVertexId vertex = distances_.members[member];
  const glm::dvec3& p = surface_.positions[vertex.value()];
  candidates_.clear();
  to_target_.clear();
  terms_.clear();
  distances_.fetch_after(member);
  for (const NearSite& near : near_block(member / block_size)) {
    const glm::dvec3 away = p - near.position;
    const double squared = glm::dot(away, away);
    if (squared >= reach_ * reach_) continue;
    const KrigingSite& site = sites_[near.site];
    if (vertex == site.vertex || (site.slot && distances_.at(*site.slot, member) == 0.0)) {
      terms_.assign(1, {&site, 1.0});
      return terms_;
    }
    const double straight = std::sqrt(squared);
    const double along = way_to(site, distances_, member);
    if (along >= greatest_detour * straight) continue;
    const double share = along <= trusted_detour * straight ? 1.0 : trust(along / straight);
    const double covariance = table_.at(straight / unit_) * share;
    if (!(covariance > kernel_.least)) continue;
    candidates_.push_back(near.site);
    to_target_.push_back((covariance - kernel_.least) / (1.0 - kernel_.least));
  }
  if (candidates_.empty()) return terms_;
  const std::span<const double> weights = kriging_.solve(candidates_, to_target_);
  for (std::size_t c = 0; c < candidates_.size(); ++c) {
    if (weights[c] > 0.0) terms_.push_back({&sites_[candidates_[c]], weights[c]});
  }
  return terms_;
}

}  // namespace semblante
