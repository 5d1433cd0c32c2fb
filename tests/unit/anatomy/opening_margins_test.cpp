#include "core/anatomy/opening_margins.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace semblante
