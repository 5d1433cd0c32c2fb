#include "core/parametrize/influence_regions.h"

#include <algorithm>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace semblante {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double infinite = std::numeric_limits<double>::infinity();

/// One ordinary vertex P at the origin and points where a test wants them, each at the end of a step whose length the
/// test makes up; no step leads to those at an infinite distance.
class OneVertex {
 public:
  OneVertex() { surface_.positions = {glm::dvec3(0.0)}; }
  void add(std::string_view name, const glm::dvec3& position, double distance) {
    const SurfaceVertexId vertex(static_cast<std::uint32_t>(surface_.positions.size()));
    points_.push_back({testing::fp(name), vertex, position});
    surface_.positions.push_back(position);
    if (distance != infinite) surface_.steps.push_back({distance, vertex});
  }
  [[nodiscard]] std::vector<std::string> region() {
    const auto to_points = static_cast<std::uint32_t>(surface_.steps.size());
    surface_.step_offsets = {0, to_points};
    for (std::uint32_t s = 0; s < surface_.positions.size(); ++s) {
      surface_.part_members.emplace_back(s);
      surface_.part_of.emplace_back(0);
      if (s == 0) continue;
      for (std::uint32_t k = 0; k < to_points; ++k) {
        const double length = surface_.steps[k].length;
        if (surface_.steps[k].to.value() == s) surface_.steps.push_back({length, SurfaceVertexId(0)});
      }
      surface_.step_offsets.push_back(static_cast<std::uint32_t>(surface_.steps.size()));
    }
    surface_.part_offsets = {0, static_cast<std::uint32_t>(surface_.positions.size())};
    const PointDistances distances = measure_distances(surface_, PartId(0), points_);
    std::vector<std::string> names;
    influence_regions(surface_, distances)[0].for_each(
        [&](std::size_t slot) { names.push_back(to_string(points_[slot].id)); });
    return names;
  }

 private:
  Surface surface_;
  std::vector<SurfacePoint> points_;
};

TEST(InfluenceRegion, PointBeyondANearerOne_IsCutOff) {
  OneVertex p;
  p.add("2.1", {1, 0, 0}, 1);
  p.add("2.2", {2, 0, 0}, 2);   // (1, 0, 0) . (1, 0, 0) > 0
  p.add("2.3", {-1, 0, 0}, 1);  // the other side stays
  EXPECT_THAT(p.region(), ElementsAre("2.1", "2.3"));
}

TEST(InfluenceRegion, RightAngle_IsNotBeyond) {
  OneVertex p;
  p.add("2.1", {1, 0, 0}, 1);
  p.add("2.2", {1, 5, 0}, 6);  // (g - f) . (f - P) = (0, 5, 0) . (1, 0, 0) = 0
  EXPECT_THAT(p.region(), ElementsAre("2.1", "2.2"));
}

TEST(InfluenceRegion, CosineAtTheThreshold_DecidesAt1e6) {
  OneVertex below;
  below.add("2.1", {1, 0, 0}, 1);
  below.add("2.2", {1 + 0.9e-6, 1, 0}, 2);  // cosine 0.9e-6: a right angle as far as floats can tell
  EXPECT_THAT(below.region(), ElementsAre("2.1", "2.2"));
  OneVertex above;
  above.add("2.1", {1, 0, 0}, 1);
  above.add("2.2", {1 + 1.1e-6, 1, 0}, 2);
  EXPECT_THAT(above.region(), ElementsAre("2.1"));
}

TEST(InfluenceRegion, ThresholdIsOfTheCosine_NotOfTheProduct) {
  // The same angle a thousand times larger: 1e-6 |g - f| |f - P| grows with both.
  OneVertex p;
  p.add("2.1", {1000, 0, 0}, 1000);
  p.add("2.2", {1000 + 0.9e-3, 1000, 0}, 2000);
  EXPECT_THAT(p.region(), ElementsAre("2.1", "2.2"));
}

// f = 2.1 straight 1 away, g = 2.2 straight 2 away behind it: f first cuts g off; g first leaves f where it is.
std::vector<std::string> region_with_distances(double to_f, double to_g) {
  OneVertex p;
  p.add("2.1", {1, 0, 0}, to_f);
  p.add("2.2", {2, 0, 0}, to_g);
  return p.region();
}

TEST(InfluenceRegion, Tie_TheLowerIdGoesFirst) {
  EXPECT_THAT(region_with_distances(2, 2), ElementsAre("2.1"));
  EXPECT_THAT(region_with_distances(2 * (1 + 0.9e-6), 2), ElementsAre("2.1"));         // still a tie
  EXPECT_THAT(region_with_distances(2 * (1 + 1.1e-6), 2), ElementsAre("2.1", "2.2"));  // not any more
}

TEST(InfluenceRegion, Tie_OrderIsByGroupThenNumber) {
  OneVertex p;
  p.add("2.14", {1, 0, 0}, 2);  // 2.14 comes before 3.1, and 9.2 before 9.15
  p.add("3.1", {2, 0, 0}, 2);
  EXPECT_THAT(p.region(), ElementsAre("2.14"));
  OneVertex q;
  q.add("9.2", {1, 0, 0}, 2);
  q.add("9.15", {2, 0, 0}, 2);
  EXPECT_THAT(q.region(), ElementsAre("9.2"));
}

TEST(InfluenceRegion, UnreachablePoint_NeitherCountsNorCuts) {
  OneVertex p;
  p.add("2.1", {1, 0, 0}, infinite);
  p.add("2.2", {2, 0, 0}, 2);
  EXPECT_THAT(p.region(), ElementsAre("2.2"));
}

TEST(InfluenceRegion, PointsAtOnePlace_BothStay) {
  OneVertex p;
  p.add("2.1", {1, 0, 0}, 1);
  p.add("2.2", {1, 0, 0}, 1);  // g - f = 0 is not beyond
  EXPECT_THAT(p.region(), ElementsAre("2.1", "2.2"));
}

TEST(InfluenceRegion, VertexAtThePointsPlace_CutsNothingOff) {
  OneVertex p;
  p.add("2.1", {0, 0, 0}, 0.5);  // f - P = 0 has no direction
  p.add("2.2", {2, 0, 0}, 2);
  EXPECT_THAT(p.region(), ElementsAre("2.1", "2.2"));
}

TEST(InfluenceRegion, PointsOwnVertex_IsNotOrdinary) {
  const Model model = testing::make_strip(4);
  const Surface surface = build_surface(model);
  const auto points = surface_points(surface, testing::points_at(model, {{"2.1", 0}, {"2.2", 4}}));
  const auto regions = influence_regions(surface, measure_distances(surface, PartId(0), points));
  EXPECT_TRUE(regions[0].empty());
  EXPECT_TRUE(regions[4].empty());
  EXPECT_FALSE(regions[1].empty());
}

TEST(RegionNeighbors, PointsThatShareAVertex_AndNoOthers) {
  std::vector<SlotSet> regions(3);
  regions[0].insert(0);
  regions[0].insert(1);
  regions[1].insert(1);
  regions[1].insert(83);
  regions[2].insert(70);
  const auto neighbors = region_neighbors(regions, 84);
  const auto slots = [](const SlotSet& set) {
    std::vector<std::size_t> found;
    set.for_each([&](std::size_t slot) { found.push_back(slot); });
    return found;
  };
  EXPECT_THAT(slots(neighbors[0]), ElementsAre(1));
  EXPECT_THAT(slots(neighbors[1]), ElementsAre(0, 83));
  EXPECT_THAT(slots(neighbors[83]), ElementsAre(1));
  EXPECT_THAT(slots(neighbors[70]), IsEmpty());  // alone in its vertex
}

}  // namespace
}  // namespace semblante
