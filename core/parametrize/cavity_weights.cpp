#include "core/parametrize/cavity_weights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <queue>

#include "core/anatomy/smooth_step.h"

namespace semblante {
namespace {

/// How the rim's motion ends in a cavity, in ES0: it falls by 1/e over `length`, after a rim of the thickness of a lip
/// or lid, which moves as one with the rim's line. Chosen on the shapes of two real heads (tests/bench/README.md).
struct Fade {
  double rim;
  double length;
};
constexpr Fade mouth_fade = {0.20, 0.22};
/// The back of a lip is continuous with its front up to this depth.
constexpr double lip = 0.10;
constexpr Fade socket_fade = {0.05, 0.055};
/// Sweeps end when no weight changes by more; the start is close to the solution.
constexpr double least_change = 2e-3;
constexpr int most_sweeps = 100;
/// Steps go beyond each equation's own solution (successive over-relaxation), from the rim inwards: that converges in
/// about a fifth of the sweeps.
constexpr double over_relaxation = 1.6;

/// The unknown rows and the equations between them.
class Diffusion {
 public:
  Diffusion(const Surface& surface, const Cavity& cavity, double unit,
            const std::function<WeightRow(SurfaceVertexId)>& row_of)
      : surface_(surface), cavity_(cavity), unit_(unit) {
    find_links();
    find_columns(row_of);
    start(row_of);
  }

  void solve() {
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
      double change = 0.0;
      for (const std::uint32_t member : order_) change = std::max(change, relax(member));
      if (change < least_change) break;
    }
  }

  /// The distance of a member from the rim along edges, in ES0.
  [[nodiscard]] double depth(std::size_t member) const { return distance_[member]; }
  [[nodiscard]] WeightRow row(std::size_t member) const {
    WeightRow row{};
    for (std::size_t c = 0; c < ids_.size(); ++c) row[ids_[c]] = rows_[member * ids_.size() + c];
    return row;
  }

 private:
  struct Link {
    std::uint32_t row;  ///< of rows_
    double length;
    double weight;  ///< 1 / length^2
  };

  /// Rows 0 to #members - 1 are the members'; those of the rim follow.
  void find_links() {
    std::map<SurfaceVertexId, std::uint32_t> rim;
    link_offsets_.push_back(0);
    for (const SurfaceVertexId v : cavity_.members) {
      for (const Surface::Step& step : surface_.steps_from(v)) {
        const auto at = std::lower_bound(cavity_.members.begin(), cavity_.members.end(), step.to);
        std::uint32_t row = static_cast<std::uint32_t>(at - cavity_.members.begin());
        if (at == cavity_.members.end() || *at != step.to) {
          row = rim.try_emplace(step.to, static_cast<std::uint32_t>(cavity_.members.size() + rim.size())).first->second;
          if (row - cavity_.members.size() == rim_.size()) rim_.push_back(step.to);
        }
        const double length = std::max(step.length / unit_, shortest_link);
        links_.push_back({row, length, 1.0 / (length * length)});
      }
      link_offsets_.push_back(static_cast<std::uint32_t>(links_.size()));
    }
  }

  /// The points that any row can have: those of the rim, and the jaw's.
  void find_columns(const std::function<WeightRow(SurfaceVertexId)>& row_of) {
    std::array<bool, feature_point_count> used{};
    for (const SurfaceVertexId v : rim_) {
      const WeightRow row = row_of(v);
      for (std::size_t id = 0; id < row.size(); ++id) used[id] = used[id] || row[id] > 0.0;
    }
    const std::size_t jaw = parse_feature_point("2.1")->value();
    if (cavity_.is_mouth) used[jaw] = true;
    for (std::size_t id = 0; id < used.size(); ++id) {
      if (!used[id]) continue;
      if (id == jaw) jaw_column_ = ids_.size();
      ids_.push_back(id);
    }
  }

  /// The rim's rows, and in each member that of the rim's vertex it is nearest to, faded by the distance.
  void start(const std::function<WeightRow(SurfaceVertexId)>& row_of) {
    const std::size_t members = cavity_.members.size();
    rows_.assign((members + rim_.size()) * ids_.size(), 0.0);
    for (std::size_t r = 0; r < rim_.size(); ++r) {
      const WeightRow row = row_of(rim_[r]);
      for (std::size_t c = 0; c < ids_.size(); ++c) rows_[(members + r) * ids_.size() + c] = row[ids_[c]];
    }
    for (const SurfaceVertexId v : cavity_.members) {
      jaw_share_.push_back(
          cavity_.is_mouth ? jaw_share_in_mouth((surface_.positions[v.value()] - cavity_.middle) / unit_) : 0.0);
    }
    distance_.assign(members, std::numeric_limits<double>::infinity());
    std::vector<std::uint32_t> from(members);
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    const auto lower = [&](std::uint32_t m, double to, std::uint32_t row) {
      if (to >= distance_[m]) return;
      distance_[m] = to;
      from[m] = row;
      queue.emplace(to, m);
    };
    for (std::uint32_t m = 0; m < members; ++m) {
      for (const Link& link : links_of(m)) {
        if (link.row >= members) lower(m, link.length, link.row);
      }
    }
    while (!queue.empty()) {
      const auto [to, m] = queue.top();
      queue.pop();
      if (to > distance_[m]) continue;
      order_.push_back(m);
      for (const Link& link : links_of(m)) {
        if (link.row < members) lower(link.row, to + link.length, from[m]);
      }
    }
    const Fade& fade = cavity_.is_mouth ? mouth_fade : socket_fade;
    pull_.resize(members);
    for (const std::uint32_t m : order_) {
      pull_[m] = smooth_step(0.0, fade.rim, distance_[m]) / (4.0 * fade.length * fade.length);
      const double rim_share = std::exp(-std::max(0.0, distance_[m] - fade.rim / 2.0) / fade.length);
      for (std::size_t c = 0; c < ids_.size(); ++c) {
        rows_[m * ids_.size() + c] =
            rim_share * rows_[from[m] * ids_.size() + c] + (1.0 - rim_share) * own_weight(m, c);
      }
    }
  }

  /// Solves the equation of one member for its own row; the greatest change of a weight.
  double relax(std::uint32_t m) {
    const auto links = links_of(m);
    const double pull = static_cast<double>(links.size()) * pull_[m];
    double all = pull;
    sums_.assign(ids_.size(), 0.0);
    if (jaw_column_ < ids_.size()) sums_[jaw_column_] = pull * jaw_share_[m];
    for (const Link& link : links) {
      all += link.weight;
      const double* const other = &rows_[link.row * ids_.size()];
      for (std::size_t c = 0; c < ids_.size(); ++c) sums_[c] += link.weight * other[c];
    }
    double* const own = &rows_[m * ids_.size()];
    double change = 0.0;
    const double share = 1.0 / all;
    for (std::size_t c = 0; c < ids_.size(); ++c) {
      const double step = over_relaxation * (sums_[c] * share - own[c]);
      change = std::max(change, std::abs(step));
      own[c] += step;
    }
    return change;
  }

  [[nodiscard]] std::span<const Link> links_of(std::uint32_t m) const {
    return std::span(links_).subspan(link_offsets_[m], link_offsets_[m + 1] - link_offsets_[m]);
  }
  [[nodiscard]] double own_weight(std::uint32_t m, std::size_t column) const {
    return column == jaw_column_ ? jaw_share_[m] : 0.0;
  }

  /// Edges of length zero occur; in ES0.
  static constexpr double shortest_link = 1e-3;

  const Surface& surface_;
  const Cavity& cavity_;
  double unit_;
  std::vector<SurfaceVertexId> rim_;
  std::vector<Link> links_;
  std::vector<std::uint32_t> link_offsets_;
  std::vector<std::size_t> ids_;  ///< of the columns
  std::size_t jaw_column_ = std::numeric_limits<std::size_t>::max();
  std::vector<double> distance_;      ///< of the members from the rim
  std::vector<double> jaw_share_;     ///< of the members
  std::vector<double> pull_;          ///< of the members, towards their own rows
  std::vector<double> rows_;          ///< members and rim, by columns
  std::vector<std::uint32_t> order_;  ///< members, from the rim inwards
  std::vector<double> sums_;
};

}  // namespace

std::vector<WeightRow> cavity_rows(const Surface& surface, const Cavity& cavity, double unit,
                                   const std::function<WeightRow(SurfaceVertexId)>& row_of) {
  Diffusion diffusion(surface, cavity, unit, row_of);
  diffusion.solve();
  std::vector<WeightRow> rows;
  for (std::size_t m = 0; m < cavity.members.size(); ++m) {
    WeightRow& row = rows.emplace_back(diffusion.row(m));
    const double depth = diffusion.depth(m);
    if (!cavity.is_mouth || depth >= lip) continue;
    const double share = smooth_step(0.0, lip, depth);
    const WeightRow in_front = row_of(cavity.members[m]);
    for (std::size_t id = 0; id < row.size(); ++id) row[id] = share * row[id] + (1.0 - share) * in_front[id];
  }
  return rows;
}

}  // namespace semblante
