// Lips and lids that touch or pass each other: a proposed point must lie on its own side, and the mouth must open.

#include <algorithm>
#include <array>
#include <optional>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/anatomy/point_lookup.h"
#include "core/geometry/edge_path_search.h"
#include "core/propose/quick_set.h"
#include "tests/oracle/real_heads.h"
#include "tests/property/propose/closed_heads.h"

namespace semblante::bench {
namespace {

using Names = std::vector<std::string_view>;

struct Rims {
  Names upper, lower;
};
const std::array<Rims, 3> all_rims = {
    Rims{{"2.2", "2.6", "2.7", "8.1", "8.5", "8.6", "8.9", "8.10"}, {"2.3", "2.8", "2.9", "8.2", "8.7", "8.8"}},
    Rims{{"3.1", "3.13", "4.1", "4.3", "4.5"}, {"3.3", "3.9", "5.3"}},
    Rims{{"3.2", "3.14", "4.2", "4.4", "4.6"}, {"3.4", "3.10", "5.4"}}};

/// What is known of the sides from ALL placed points: positive nearer to those of the upper side, by surface.
class TrueSides {
 public:
  explicit TrueSides(const Head& head) {
    EdgePathSearch search(head.surface);
    for (const Rims& rims : all_rims) {
      Differences difference(head.surface.vertex_count(), 0.0);
      for (const auto& [names, sign] : {std::pair(&rims.lower, 1.0), std::pair(&rims.upper, -1.0)}) {
        std::vector<SurfaceVertexId> sources;
        for (const SurfacePoint& point : surface_points(head.surface, some_of(head.points, *names)))
          sources.push_back(point.vertex);
        const auto distances = search.from(sources);
        for (std::size_t v = 0; v < difference.size(); ++v) difference[v] += sign * distances[v];
      }
      differences_.push_back(std::move(difference));
    }
  }

  /// Whether the vertex is on the side of the point; empty for points of neither side.
  [[nodiscard]] std::optional<bool> is_right(const Head& head, const FeaturePoint& point) const {
    const std::string name = to_string(point.id);
    for (std::size_t r = 0; r < all_rims.size(); ++r) {
      const double difference = differences_[r][head.surface.surface_of[point.vertex->value()].value()];
      if (name[0] == '4' || name[0] == '5') continue;
      if (std::find(all_rims[r].upper.begin(), all_rims[r].upper.end(), name) != all_rims[r].upper.end())
        return difference > 0.0;
      if (std::find(all_rims[r].lower.begin(), all_rims[r].lower.end(), name) != all_rims[r].lower.end())
        return difference < 0.0;
    }
    return std::nullopt;
  }

 private:
  using Differences = std::vector<double>;
  std::vector<Differences> differences_;
};

Names quick_without(const Names& left_out) {
  Names names;
  for (const std::string_view name : quick_set) {
    if (std::find(left_out.begin(), left_out.end(), name) == left_out.end()) names.push_back(name);
  }
  return names;
}

/// Every proposed point of a lip or lid is on its own side; where the surface joins both, at least the sure ones. With
/// points of both lips known, lips leave no doubt.
void expect_right_sides(const ClosableHead& closable, const Head& head, const Names& known, const std::string& what,
                        bool asks_for_certainty = false) {
  const TrueSides sides(head);
  int looked_at = 0;
  for (const Proposal& proposal : propose_on(closable, head, some_of(head.points, known)).points) {
    if (!proposal.point.vertex) continue;
    const auto right = sides.is_right(head, proposal.point);
    if (!right) continue;
    ++looked_at;
    if (closable.has_membranes && proposal.confidence != Confidence::high) continue;
    EXPECT_TRUE(*right) << head.name << ", " << what << ": " << to_string(proposal.point.id)
                        << " is on the wrong side (" << proposal.remark << ")";
    if (asks_for_certainty && group_of(proposal.point.id) != 3 && !closable.has_membranes) {
      EXPECT_EQ(proposal.remark, "") << head.name << ", " << what << ": " << to_string(proposal.point.id);
    }
    EXPECT_TRUE(proposal.remark.empty() || proposal.confidence != Confidence::high);
  }
  EXPECT_GE(looked_at, 10) << head.name << ", " << what;
}

const std::array<double, 5> closures = {0.0, 0.5, 0.9, 1.0, 1.3};

std::string words(double closure) { return "closed by " + std::to_string(closure); }

TEST(TouchingRims, ProposedFromTheQuickSetAreOnTheirOwnSide) {
  for (const ClosableHead& closable : closable_heads()) {
    for (const double closure : closures) {
      const Head head = closed(closable.head, closure);
      expect_right_sides(closable, head, quick_without({}), words(closure), true);
      expect_right_sides(closable, lopsided(head), quick_without({}), words(closure) + ", lopsided", true);
    }
  }
}

TEST(TouchingRims, WithoutTheirMiddlesOtherPointsTellTheSides) {
  const std::array<Names, 6> left_out = {Names{"2.2"},   {"2.3"},       {"2.2", "2.3"}, {"2.2", "2.3", "8.1", "8.2"},
                                         {"2.2", "8.2"}, {"3.1", "3.3"}};
  for (const ClosableHead& closable : closable_heads()) {
    for (const double closure : {0.9, 1.3}) {
      const Head head = closed(closable.head, closure);
      for (const Names& names : left_out) {
        std::string what = words(closure) + ", without";
        for (const std::string_view name : names) what.append(" ").append(name);
        expect_right_sides(closable, head, quick_without(names), what);
      }
    }
  }
}

TEST(TouchingRims, OfExpressionsAreOnTheirOwnSide) {
  const auto faces = oracle::faces_folder();
  if (!faces) GTEST_SKIP() << "no folder of real heads";
  for (const ClosableHead& closable : closable_heads()) {
    if (closable.head.name != "ict-facekit") continue;
    for (const char* const name : {"mouthPress", "jawOpen", "jawOpen_mouthClose", "mouthPucker", "mouthSmile_L",
                                   "eyeBlink_R", "eyeWide", "noseSneer"}) {
      const Head head =
          with_positions_of(closable.head, *faces / "ict-facekit/expressions" / (std::string(name) + ".obj"));
      expect_right_sides(closable, head, quick_without({}), name);
    }
  }
}

TEST(TouchingRims, OfFacesOfTheFamilyAreOnTheirOwnSide) {
  for (const ClosableHead& closable : closable_heads()) {
    if (closable.head.name != "sample head") continue;
    const PosedFace face(closable.head, WeightMethod::smooth);
    for (const auto& [viseme, expression] : {std::pair(1, 0), {10, 0}, {13, 0}, {0, 1}, {0, 6}}) {
      Head head = closable.head;
      head.model.positions =
          face.pose(frame_of(static_cast<std::uint8_t>(viseme), static_cast<std::uint8_t>(expression)));
      head.surface = build_surface(head.model);
      for (FeaturePoint& point : head.points) {
        if (point.vertex) point.position = head.model.positions[point.vertex->value()];
      }
      expect_right_sides(closable, head, quick_without({}),
                         "viseme " + std::to_string(viseme) + ", expression " + std::to_string(expression));
    }
  }
}

double way_of(const Head& head, const std::vector<glm::vec3>& moved, std::string_view name) {
  const std::uint32_t vertex = find_point(head.points, name)->vertex->value();
  return glm::distance(head.model.positions[vertex], moved[vertex]);
}

TEST(TouchingRims, OpenAfterwards) {
  for (const ClosableHead& closable : closable_heads()) {
    if (closable.has_membranes) continue;
    for (const double closure : {0.9, 1.0, 1.3}) {
      const Head head = closed(closable.head, closure);
      Head proposed = head;
      proposed.points = some_of(head.points, quick_without({}));
      for (const Proposal& proposal : propose_on(closable, head, proposed.points).points)
        proposed.points.push_back(proposal.point);
      std::sort(proposed.points.begin(), proposed.points.end(),
                [](const FeaturePoint& a, const FeaturePoint& b) { return a.id < b.id; });
      // The jaw drops, and the lower lip with it.
      const auto open = frame_of({{3, 500}, {5, -500}, {10, -500}, {11, -500}, {52, -500}, {57, -500}, {58, -500}});
      const auto moved = PosedFace(proposed, WeightMethod::smooth).pose(open);
      const double lower = way_of(head, moved, "2.3");
      ASSERT_GT(lower, 0.0) << head.name;
      for (const char* const name : {"2.2", "2.6", "2.7", "8.1", "8.5", "8.6", "8.9", "8.10"})
        EXPECT_LT(way_of(head, moved, name), 0.15 * lower) << head.name << ", " << words(closure) << ": " << name;
      for (const char* const name : {"2.8", "2.9", "8.2", "8.7", "8.8"})
        EXPECT_GT(way_of(head, moved, name), 0.4 * lower) << head.name << ", " << words(closure) << ": " << name;
    }
  }
}

}  // namespace
}  // namespace semblante::bench
