#include "core/anatomy/opening_margins.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "core/anatomy/cavities.h"
#include "tests/support/meshes.h"
#include "tests/support/sample_head_model.h"

namespace semblante {
namespace {

FeaturePointId fp(const char* name) { return parse_feature_point(name).value(); }

class OpeningMargins : public ::testing::Test {
 protected:
  Surface surface_ = build_surface(testing::sample_head_model());
  std::vector<SurfacePoint> points_ = surface_points(surface_, testing::sample_head_points());

  static double share_of(const MarginSite& site, const char* name) {
    for (const auto& [id, share] : site.shares) {
      if (id == fp(name)) return share;
    }
    return 0.0;
  }
  [[nodiscard]] const glm::dvec3& at(const MarginSite& site) const { return surface_.positions[site.vertex.value()]; }
  [[nodiscard]] const glm::dvec3& at(const char* name) const {
    return std::find_if(points_.begin(), points_.end(), [&](const SurfacePoint& p) { return p.id == fp(name); })
        ->position;
  }
};

TEST_F(OpeningMargins, SharesArePositiveAndSumToOne) {
  const auto sites = margin_sites(surface_, points_);
  EXPECT_GT(sites.size(), 40U);
  for (const MarginSite& site : sites) {
    double sum = 0.0;
    for (const auto& [id, share] : site.shares) {
      EXPECT_GT(share, 0.0);
      sum += share;
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
  }
}

TEST_F(OpeningMargins, AreNeverAtAPointAndNeverTwiceAtOneVertex) {
  const auto sites = margin_sites(surface_, points_);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    for (const SurfacePoint& point : points_) EXPECT_NE(sites[i].vertex, point.vertex);
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(sites[i].vertex, sites[j].vertex);
  }
}

// Upper and lower lid that each go their way for a shut eye are at one height: 3.1's share is the opening there.
TEST_F(OpeningMargins, LidsFollowTheirMiddleInTheMeasureOfTheOpening) {
  const double open = at("3.1").y - at("3.3").y;
  int upper = 0;
  for (const MarginSite& site : margin_sites(surface_, points_)) {
    const double share = share_of(site, "3.1");
    if (share == 0.0) continue;
    ++upper;
    const double after = at(site).y - share * open;
    // The lower lid's edge is a smooth curve through its corners and its middle.
    EXPECT_LT(after, std::max(at("3.7").y, at("3.11").y) + 0.05 * open);
    EXPECT_GT(after, at("3.3").y - 0.05 * open);
    const double off_middle = std::abs(at(site).x - at("3.1").x) / (at("3.7").x - at("3.11").x);
    if (off_middle < 0.1) {
      EXPECT_GT(share, 0.9);
    }
    if (off_middle > 0.4) {
      EXPECT_LT(share, 0.6);
    }
  }
  EXPECT_GT(upper, 8);
}

TEST_F(OpeningMargins, TouchingLipsMoveInOneMeasure) {
  const auto sites = margin_sites(surface_, points_);
  int pairs = 0;
  for (const MarginSite& above : sites) {
    for (const MarginSite& below : sites) {
      if (share_of(above, "2.2") == 0.0 || share_of(below, "2.3") == 0.0) continue;
      if (std::abs(at(above).x - at(below).x) > 1e-6) continue;
      EXPECT_NEAR(share_of(above, "2.2"), share_of(below, "2.3"), 0.01);
      ++pairs;
    }
  }
  EXPECT_GE(pairs, 4);
}

TEST_F(OpeningMargins, AreLeftOutWherePointsAreMissing) {
  std::erase_if(points_, [](const SurfacePoint& p) { return p.id == fp("3.3") || p.id == fp("2.6"); });
  for (const MarginSite& site : margin_sites(surface_, points_)) {
    EXPECT_EQ(share_of(site, "3.1"), 0.0);
    EXPECT_EQ(share_of(site, "2.6"), 0.0);
    EXPECT_TRUE(share_of(site, "2.4") == 0.0 || share_of(site, "2.8") > 0.0);
  }
}

/// A coarse plate of columns -4 to 4 and rows -1 to 1. With `slit` the mouth is a hole between two rims that meet at
/// columns -4 and 4; else one line of vertices is both rims.
class CoarseMouth {
 public:
  explicit CoarseMouth(bool slit) : slit_(slit) {
    std::vector<glm::vec3> positions;
    for (const float y : {-1.0F, 0.0F, 1.0F}) {
      for (int column = -4; column <= 4; ++column) positions.emplace_back(column, y, 0.0F);
    }
    for (int column = -3; column <= 3; ++column) positions.emplace_back(column, 0.2F, 0.0F);
    std::vector<Triangle> triangles;
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t above_a, std::uint32_t above_b) {
      triangles.push_back({a, b, above_b});
      triangles.push_back({a, above_b, above_a});
    };
    for (int column = -4; column < 4; ++column) {
      add(chin(column), chin(column + 1), lower(column), lower(column + 1));
      add(upper(column), upper(column + 1), nose(column), nose(column + 1));
    }
    model_ = testing::make_model(std::move(positions), std::move(triangles));
    surface_ = build_surface(model_);
  }

  [[nodiscard]] static std::uint32_t chin(int column) { return static_cast<std::uint32_t>(column + 4); }
  [[nodiscard]] static std::uint32_t lower(int column) { return chin(column) + 9; }
  [[nodiscard]] static std::uint32_t nose(int column) { return chin(column) + 18; }
  [[nodiscard]] std::uint32_t upper(int column) const {
    return slit_ && column > -4 && column < 4 ? static_cast<std::uint32_t>(column + 3 + 27) : lower(column);
  }

  /// The points of the lips: at the middle, the corners, and half way between them.
  [[nodiscard]] testing::Marks marks() const {
    return {{"2.2", upper(0)}, {"2.3", lower(0)},  {"2.4", lower(4)}, {"2.5", lower(-4)},
            {"2.6", upper(2)}, {"2.7", upper(-2)}, {"2.8", lower(2)}, {"2.9", lower(-2)}};
  }

  /// The shares at a vertex, empty without a place there; by name.
  [[nodiscard]] std::map<std::string, double> shares_at(std::uint32_t vertex, const testing::Marks& marks) const {
    std::map<std::string, double> shares;
    const auto points = surface_points(surface_, testing::points_at(model_, marks));
    for (const MarginSite& site : margin_sites(surface_, points)) {
      if (site.vertex != surface_.surface_of[vertex]) continue;
      for (const auto& [id, share] : site.shares) shares[to_string(id)] += share;
    }
    return shares;
  }
  /// Whether a vertex is said to lie behind the rim of the mouth.
  [[nodiscard]] bool is_inside(std::uint32_t vertex, const testing::Marks& marks) const {
    const auto cavities =
        find_cavities(surface_, PartId(0), surface_points(surface_, testing::points_at(model_, marks)));
    return std::any_of(cavities.begin(), cavities.end(), [&](const Cavity& cavity) {
      return std::binary_search(cavity.members.begin(), cavity.members.end(), surface_.surface_of[vertex]);
    });
  }

 private:
  bool slit_;
  Model model_;
  Surface surface_;
};

using Shares = std::map<std::string, double>;
using testing::with;

// The points beside the middle are at the chin's vertices, as a coarse mesh and a guess may have it.
TEST(OpeningMarginsOfACoarseMouth, FollowTheHoleThoughPointsLieBesideIt) {
  const CoarseMouth mouth(true);
  const auto at_rim = [&](std::uint32_t vertex) {
    return mouth.shares_at(vertex,
                           with(mouth.marks(), {{"2.8", CoarseMouth::chin(2)}, {"2.9", CoarseMouth::chin(-2)}}));
  };
  EXPECT_EQ(at_rim(mouth.lower(1)), (Shares{{"2.3", 0.5}, {"2.8", 0.5}}));
  EXPECT_EQ(at_rim(mouth.lower(2)), (Shares{{"2.8", 1.0}}));
  EXPECT_EQ(at_rim(mouth.lower(-1)), (Shares{{"2.3", 0.5}, {"2.9", 0.5}}));
  EXPECT_EQ(at_rim(mouth.upper(1)), (Shares{{"2.2", 0.5}, {"2.6", 0.5}}));
  EXPECT_TRUE(at_rim(CoarseMouth::chin(1)).empty());
}

// Between the hole and the shortest path through a point below it; the inside of a mouth does not follow the lip fully.
TEST(OpeningMarginsOfACoarseMouth, TheBorderOfTheHoleIsNoInside) {
  const CoarseMouth mouth(true);
  EXPECT_FALSE(mouth.is_inside(mouth.lower(-1), with(mouth.marks(), {{"2.1", CoarseMouth::chin(0)},
                                                                     {"2.9", CoarseMouth::chin(-3)},
                                                                     {"9.3", CoarseMouth::nose(0)}})));
}

TEST(OpeningMarginsOfACoarseMouth, OnALineOfBothLipsAreTheMeanOfBoth) {
  const CoarseMouth mouth(false);
  const auto at_line = [&](std::uint32_t vertex) {
    return mouth.shares_at(vertex, with(mouth.marks(), {{"2.6", mouth.lower(1)}, {"2.7", mouth.lower(-1)}}));
  };
  EXPECT_EQ(at_line(mouth.lower(0)), (Shares{{"2.2", 0.5}, {"2.3", 0.5}}));
  EXPECT_EQ(at_line(mouth.lower(1)), (Shares{{"2.6", 0.5}, {"2.3", 0.25}, {"2.8", 0.25}}));
  const Shares beside = at_line(mouth.lower(2));
  EXPECT_EQ(beside.at("2.8"), 0.5);
  EXPECT_NEAR(beside.at("2.6") + beside.at("2.4"), 0.5, 1e-12);
  EXPECT_TRUE(at_line(mouth.lower(4)).empty()) << "a corner moves as its point";
}

/// A plate with a slit of four columns as the eye, whose fold is the row above it, bent to an arc.
class Fold : public ::testing::Test {
 protected:
  Fold() { bend(0.75F); }

  /// The height of the fold half way to the corners.
  void bend(float y) {
    for (const std::uint32_t vertex : half_way_) plate_.model.positions.at(vertex).y = y;
  }

  testing::ClosedMouth plate_ = testing::make_closed_mouth();
  std::uint32_t brow_ = plate_.at(0, 2);
  std::array<std::uint32_t, 2> half_way_ = {plate_.at(-1, 1), plate_.at(1, 1)};

  struct Site {
    glm::dvec3 place;
    double of_fold, of_edge;  ///< shares of 3.13 and 3.1
  };

  /// The places on the fold, with 3.13 at a vertex of the plate.
  std::vector<Site> sites(std::uint32_t at) {
    const Surface surface = build_surface(plate_.model);
    const auto points = surface_points(surface, testing::points_at(plate_.model, {{"3.11", plate_.at(-2, 0)},
                                                                                  {"3.7", plate_.at(2, 0)},
                                                                                  {"3.1", plate_.at(0, 0, true)},
                                                                                  {"3.3", plate_.at(0, 0, false)},
                                                                                  {"3.13", at},
                                                                                  {"4.3", brow_}}));
    std::vector<Site> result;
    for (const MarginSite& site : margin_sites(surface, points)) {
      if (site.is_edge) continue;
      Site& found = result.emplace_back(Site{surface.positions[site.vertex.value()], 0.0, 0.0});
      double sum = 0.0;
      for (const auto& [id, s] : site.shares) {
        sum += s;
        found.of_fold += id == fp("3.13") ? s : 0.0;
        found.of_edge += id == fp("3.1") ? s : 0.0;
      }
      EXPECT_DOUBLE_EQ(sum, 1.0);
    }
    return result;
  }
};

// Held at its point alone, it would get a notch there when the brow rises.
TEST_F(Fold, IsAnArcFromCornerToCorner) {
  const auto found = sites(plate_.at(0, 1));
  ASSERT_EQ(found.size(), 2U);
  for (const Site& site : found) {
    EXPECT_EQ(std::abs(site.place.x), 1.0);
    EXPECT_EQ(site.place.y, 0.75);
    EXPECT_DOUBLE_EQ(site.of_fold, 0.75);
    EXPECT_EQ(site.of_edge, 0.0);
  }
}

// The skin beside it goes down with the edge in a blink.
TEST_F(Fold, AtAVertexBelowItsLine_FollowsTheEdgeToo) {
  bend(0.6F);  // four fifths of the way up to the line
  const auto found = sites(plate_.at(0, 1));
  ASSERT_EQ(found.size(), 2U);
  for (const Site& site : found) {
    EXPECT_NEAR(site.of_fold, 0.8 * 0.75, 1e-6);
    EXPECT_NEAR(site.of_edge, 0.2 * 0.75, 1e-6);
  }
}

TEST_F(Fold, FarBelowTheBrow_HasNoPlaces) {
  plate_.model.positions[brow_].z = 3.0F;
  EXPECT_TRUE(sites(plate_.at(0, 1)).empty());
}

TEST_F(Fold, WithoutAVertexNearItsLine_HasNoPlaces) {
  bend(1.0F);
  EXPECT_TRUE(sites(plate_.at(0, 1)).empty());
}

TEST_F(Fold, NearerToTheEdgeThanTheMeshIsFine_LeavesTheEdgeAsItIs) {
  const std::uint32_t middle = plate_.at(0, 1);
  plate_.model.positions[middle].y = 0.1F;
  EXPECT_TRUE(sites(middle).empty());
}

}  // namespace
}  // namespace semblante
