#include "core/anatomy/point_order.h"

#include <limits>

#include <gtest/gtest.h>

#include "core/types/places.h"

namespace semblante {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

FeaturePointId id(const char* name) { return *parse_feature_point(name); }

TEST(PointOrder, NoOrderAsksForItsOpposite) {
  for (const PointOrder& a : point_orders()) {
    EXPECT_NE(a.more, a.less);
    for (const PointOrder& b : point_orders())
      EXPECT_FALSE(a.axis == b.axis && a.more == b.less && a.less == b.more) << to_string(a.more);
  }
}

TEST(PointOrder, WithoutOtherPoints_EveryPlaceIsInOrder) {
  const OrderBounds bounds = order_bounds(id("3.9"), Places{});
  EXPECT_EQ(bounds.least, glm::dvec3(-endless));
  EXPECT_EQ(bounds.most, glm::dvec3(endless));
}

TEST(PointOrder, AFoldOfALidIsBelowTheEdgeAndBetweenTheCorners) {
  Places places{};
  places[id("3.3").value()] = {0.5, 0.0, 0.4};    // edge of the lower lid
  places[id("3.7").value()] = {0.7, 0.0, 0.3};    // outer corner
  places[id("3.11").value()] = {0.3, 0.0, 0.4};   // inner corner
  places[id("9.15").value()] = {0.0, -0.7, 0.5};  // below the nose
  const OrderBounds fold = order_bounds(id("3.9"), places);
  EXPECT_TRUE(fold.contains({0.5, -0.1, 0.4}));
  EXPECT_TRUE(fold.contains({0.5, point_order_tolerance, 0.4}));  // as precise as points are marked
  EXPECT_FALSE(fold.contains({0.5, 0.1, 0.4}));
  EXPECT_FALSE(fold.contains({0.8, -0.1, 0.4}));
  EXPECT_FALSE(fold.contains({0.2, -0.1, 0.4}));
  EXPECT_FALSE(fold.contains({0.5, -0.8, 0.4}));
}

}  // namespace
}  // namespace semblante
