#include "core/parametrize/cavity_weights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <glm/vector_relational.hpp>

#include "core/anatomy/smooth_step.h"
#include "core/geometry/nearest_point.h"
#include "core/geometry/sparse_cholesky.h"
#include "core/parametrize/greatest_weights.h"

namespace semblante {
namespace {

/// How the rim's motion ends in a cavity, in ES0: it falls by 1/e over `length`, after a rim of the thickness of a lip
/// or lid, which moves as one with the rim's line. Chosen on the shapes of two real heads (tests/bench/README.md).
struct Fade {
  double rim;
  double length;
};
constexpr Fade mouth_fade = {0.30, 0.13};
/// The back of a lip, to this depth, follows the points around it as its front does, less with the depth, and smoothly
/// within `length`.
constexpr struct { double depth = 0.35, length = 0.10; } lip;
constexpr Fade socket_fade = {0.05, 0.055};
/// The flesh between the inside of the mouth and the skin in front of it, in ES0: up to `thin` the inside follows that
/// skin by `lower` below the mouth's middle line and by `upper` above it, where it lies on the skull; beyond `thick`
/// not.
constexpr struct {
  double thin = 0.2, thick = 0.8;
  double lower = 0.8, upper = 0.15;
  double below = -0.15, above = 0.1;  ///< where the one becomes the other, from the corners of the mouth
} flesh;

/// The unknown rows and the equations between them.
class Diffusion {
 public:
  Diffusion(const Surface& surface, const Cavity& cavity, double unit, const RowOfVertex& row_of)
      : surface_(surface), cavity_(cavity), unit_(unit) {
    find_links();
    find_distances();
    find_goals();
    find_columns(row_of);
    start(row_of);
  }

  void solve() {
    const std::size_t members = cavity_.members.size();
    SparseMatrix matrix;
    for (std::uint32_t m = 0; m < members; ++m) {
      const auto links = links_of(m);
      const float pull = static_cast<float>(std::max<std::size_t>(links.size(), 1)) * pull_[m];
      double all = pull;
      for (std::size_t b = 0; b < blocks_; ++b) rows_[m * blocks_ + b] *= pull;
      for (const Link& link : links) {
        all += link.weight;
        if (link.row < members) {
          matrix.entries.push_back({link.row, -link.weight});
          continue;
        }
        const Block* const rim = &rim_rows_[(link.row - members) * blocks_];
        for (std::size_t b = 0; b < blocks_; ++b) rows_[m * blocks_ + b] += link.weight * rim[b];
      }
      matrix.diagonal.push_back(all);
      matrix.offsets.push_back(static_cast<std::uint32_t>(matrix.entries.size()));
    }
    solve_by_cholesky(matrix, rows_, blocks_);
  }

  [[nodiscard]] WeightRow row(std::size_t member) const {
    WeightRow row;
    for (std::size_t c = 0; c < ids_.size(); ++c) row.at(ids_[c]) = rows_[member * blocks_ + c / columns][c % columns];
    return row;
  }

 private:
  /// Neighbouring columns of a row, which a register holds together.
  using Block = glm::vec4;
  static constexpr std::size_t columns = 4;

  struct Link {
    std::uint32_t row;  ///< a member's, or after them one of the rim
    double length;
    float weight;  ///< 1 / length^2
  };

  /// What a member follows far from the rim.
  struct Goal {
    std::size_t begin, end;  ///< of in_front_, the skin in front of it
    double share_of_each;
    double jaw;
  };

  /// Rows 0 to #members - 1 are the members'; those of the rim follow.
  void find_links() {
    constexpr std::uint32_t none = 0xFFFFFFFFU;
    std::vector<std::uint32_t> row_of(surface_.vertex_count(), none);
    const auto members = static_cast<std::uint32_t>(cavity_.members.size());
    for (std::uint32_t m = 0; m < members; ++m) row_of[cavity_.members[m].value()] = m;
    link_offsets_.push_back(0);
    for (const SurfaceVertexId v : cavity_.members) {
      for (const Surface::Step& step : surface_.steps_from(v)) {
        std::uint32_t& row = row_of[step.to.value()];
        if (row == none) {
          row = members + static_cast<std::uint32_t>(rim_.size());
          rim_.push_back(step.to);
        }
        const double length = std::max(step.length / unit_, shortest_link);
        links_.push_back({row, length, static_cast<float>(1.0 / (length * length))});
      }
      link_offsets_.push_back(static_cast<std::uint32_t>(links_.size()));
    }
  }

  /// The distances of the members from the rim along edges, in ES0.
  void find_distances() {
    const std::size_t members = cavity_.members.size();
    distance_.assign(members, std::numeric_limits<double>::infinity());
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    const auto lower = [&](std::uint32_t m, double to) {
      if (to >= distance_[m]) return;
      distance_[m] = to;
      queue.emplace(to, m);
    };
    for (std::uint32_t m = 0; m < members; ++m) {
      for (const Link& link : links_of(m)) {
        if (link.row >= members) lower(m, link.length);
      }
    }
    while (!queue.empty()) {
      const auto [to, m] = queue.top();
      queue.pop();
      if (to > distance_[m]) continue;
      for (const Link& link : links_of(m)) {
        if (link.row < members) lower(link.row, to + link.length);
      }
    }
  }

  [[nodiscard]] bool is_on_lip(std::size_t member) const { return cavity_.is_mouth && distance_[member] < lip.depth; }

  /// What each member of the mouth would follow far from the rim: the skin in front of it, if that is near, and the
  /// jaw.
  void find_goals() {
    if (!cavity_.is_mouth) return;
    const auto [skin, vertices] = skin_around();
    std::optional<NearestPoint> nearest;
    if (!skin.empty()) nearest.emplace(skin);
    const double thick = flesh.thick * unit_;
    std::optional<std::uint32_t> last;  // nearest to the member before, which is near this one as a rule
    for (const SurfaceVertexId member : cavity_.members) {
      const glm::dvec3& p = surface_.positions[member.value()];
      const glm::dvec3 from_corners = (p - cavity_.middle) / unit_;
      Goal goal{in_front_.size(), in_front_.size(), 0.0, jaw_share_in_mouth(from_corners)};
      // On the middle of a symmetric head the skin on both sides is as near.
      std::vector<std::uint32_t> ties;
      const double bound = last ? std::min(thick, glm::distance(p, skin[*last]) * (1.0 + 1e-9)) : thick;
      if (nearest) ties = nearest->nearest_with_ties(p, bound);
      last = ties.empty() ? std::nullopt : std::optional(ties.front());
      if (!ties.empty()) {
        const double distance = glm::distance(p, skin[ties.front()]);
        const double up = smooth_step(flesh.below, flesh.above, from_corners.y);
        const double share = (1.0 - smooth_step(flesh.thin, flesh.thick, distance / unit_)) *
                             (up * flesh.upper + (1.0 - up) * flesh.lower);
        goal.share_of_each = share / static_cast<double>(ties.size());
        goal.jaw *= 1.0 - share;
        if (share > 0.0) {
          for (const std::uint32_t tie : ties) in_front_.push_back(vertices[tie]);
        }
        goal.end = in_front_.size();
      }
      goals_.push_back(goal);
    }
  }

  /// The vertices in front of the cavity and around it.
  [[nodiscard]] std::pair<std::vector<glm::dvec3>, std::vector<SurfaceVertexId>> skin_around() const {
    glm::dvec3 least(std::numeric_limits<double>::infinity());
    glm::dvec3 greatest = -least;
    for (const SurfaceVertexId v : cavity_.members) {
      least = glm::min(least, surface_.positions[v.value()]);
      greatest = glm::max(greatest, surface_.positions[v.value()]);
    }
    const glm::dvec3 reach(flesh.thick * unit_);
    std::pair<std::vector<glm::dvec3>, std::vector<SurfaceVertexId>> skin;
    const auto add = [&](SurfaceVertexId v) {
      const glm::dvec3& p = surface_.positions[v.value()];
      if (glm::any(glm::lessThan(p, least - reach)) || glm::any(glm::greaterThan(p, greatest + reach))) return;
      if (std::binary_search(cavity_.members.begin(), cavity_.members.end(), v)) return;
      skin.first.push_back(p);
      skin.second.push_back(v);
    };
    for (const SurfaceVertexId v : surface_.members_of(surface_.part_of[cavity_.members.front().value()])) add(v);
    return skin;
  }

  /// The points that any row can have: those of the rim, the back of the lips and the skin in front, and the jaw's.
  void find_columns(const RowOfVertex& row_of) {
    SlotSet used;
    const auto use = [&](const WeightRow& row) {
      row.for_each([&](std::size_t id, double w) {
        if (w > 0.0) used.insert(id);
      });
    };
    for (const SurfaceVertexId v : rim_) use(row_of(v));
    for (const SurfaceVertexId v : in_front_) use(row_of(v));
    for (std::size_t m = 0; m < cavity_.members.size(); ++m) {
      if (is_on_lip(m)) use(row_of(cavity_.members[m]));
    }
    if (cavity_.is_mouth) used.insert(jaw_point());
    used.for_each([&](std::size_t id) {
      column_of_[id] = ids_.size();
      ids_.push_back(id);
    });
    blocks_ = (ids_.size() + columns - 1) / columns;
  }

  [[nodiscard]] WeightRow row_of_goal(const Goal& goal, const RowOfVertex& row_of) const {
    WeightRow row;
    for (std::size_t k = goal.begin; k < goal.end; ++k) {
      row_of(in_front_[k]).for_each([&](std::size_t id, double w) { row.at(id) += goal.share_of_each * w; });
    }
    row.at(jaw_point()) += goal.jaw;
    return row;
  }

  void read_row(const WeightRow& row, std::size_t at, std::vector<Block>& rows) const {
    row.for_each([&](std::size_t id, double w) {
      if (!(w > 0.0)) return;  // it may have no column
      const std::size_t c = column_of_[id];
      rows[at * blocks_ + c / columns][c % columns] = static_cast<float>(w);
    });
  }

  /// The rim's rows, and what the members are pulled to, and how much.
  void start(const RowOfVertex& row_of) {
    const std::size_t members = cavity_.members.size();
    rim_rows_.assign(rim_.size() * blocks_, Block(0.0F));
    rows_.assign(members * blocks_, Block(0.0F));
    for (std::size_t r = 0; r < rim_.size(); ++r) read_row(row_of(rim_[r]), r, rim_rows_);
    for (std::size_t m = 0; m < goals_.size(); ++m) read_row(row_of_goal(goals_[m], row_of), m, rows_);
    const Fade& fade = cavity_.is_mouth ? mouth_fade : socket_fade;
    pull_.resize(members);
    for (std::size_t m = 0; m < members; ++m) {
      pull_[m] = static_cast<float>(smooth_step(0.0, fade.rim, distance_[m]) / (4.0 * fade.length * fade.length));
      if (is_on_lip(m)) pull_to_front(m, row_of(cavity_.members[m]));
    }
  }

  /// Adds the pull of a member of the back of a lip towards the row of its place among the points.
  void pull_to_front(std::size_t m, const WeightRow& in_front) {
    const auto more =
        static_cast<float>((1.0 - smooth_step(0.0, lip.depth, distance_[m])) / (4.0 * lip.length * lip.length));
    const float share = more / (pull_[m] + more);
    for (std::size_t c = 0; c < ids_.size(); ++c) {
      float& own = rows_[m * blocks_ + c / columns][static_cast<int>(c % columns)];
      own += share * (static_cast<float>(in_front[ids_[c]]) - own);
    }
    pull_[m] += more;
  }

  [[nodiscard]] std::span<const Link> links_of(std::uint32_t m) const {
    return std::span(links_).subspan(link_offsets_[m], link_offsets_[m + 1] - link_offsets_[m]);
  }
  static std::size_t jaw_point() { return parse_feature_point("2.1")->value(); }
  /// Edges of length zero occur; in ES0.
  static constexpr double shortest_link = 1e-3;

  const Surface& surface_;
  const Cavity& cavity_;
  double unit_;
  std::vector<SurfaceVertexId> rim_;
  std::vector<Link> links_;
  std::vector<std::uint32_t> link_offsets_;
  std::vector<std::size_t> ids_;                              ///< by column: id of its point
  std::array<std::size_t, feature_point_count> column_of_{};  ///< by id
  std::size_t blocks_ = 0;                                    ///< of a row
  std::vector<Goal> goals_;                                   ///< of the members of a mouth
  std::vector<SurfaceVertexId> in_front_;
  std::vector<double> distance_;  ///< of the members from the rim
  std::vector<float> pull_;       ///< of the members: how strongly each is pulled to its row in rows_
  std::vector<Block> rim_rows_;
  std::vector<Block> rows_;  ///< of the members: what each is pulled to, then the solution
};

}  // namespace

WeightTable<double> cavity_rows(const Surface& surface, const Cavity& cavity, double unit, const RowOfVertex& row_of) {
  Diffusion diffusion(surface, cavity, unit, row_of);
  diffusion.solve();
  WeightTable<double> rows;
  for (std::size_t m = 0; m < cavity.members.size(); ++m) {
    WeightRow row = diffusion.row(m);
    keep_greatest(row);
    push_row(rows, row);
  }
  return rows;
}

}  // namespace semblante
