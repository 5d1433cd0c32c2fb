#include "core/anatomy/reference_heads.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/propose/quick_set.h"
#include "core/tables/mpeg4.h"
#include "tests/support/meshes.h"

namespace semblante {
namespace {

TEST(ReferenceHeads, AreSymmetricAndMeasuredInEyeSeparations) {
  for (const ReferenceHead& head : reference_heads()) {
    EXPECT_EQ(head.points[testing::fp("3.5").value()], glm::dvec3(0.5, 0.0, 0.0)) << head.name;
    for (std::size_t id = 0; id < feature_point_count; ++id) {
      const auto& partner = head.points[mpeg4::feature_points[id].mirror];
      ASSERT_EQ(head.points[id].has_value(), partner.has_value()) << head.name << mpeg4::feature_points[id].id;
      if (!partner) continue;
      EXPECT_EQ(head.points[id]->x, -partner->x) << head.name << mpeg4::feature_points[id].id;
    }
  }
}

TEST(ReferenceHeads, AgreeWithinHalfAnEyeSeparation) {
  // A slip of a digit in the table would stand out. Hair lines and the depth of tongues differ most.
  const auto heads = reference_heads();
  for (std::size_t id = 0; id < feature_point_count; ++id) {
    for (const ReferenceHead& a : heads) {
      for (const ReferenceHead& b : heads) {
        if (!a.points[id] || !b.points[id]) continue;
        for (int axis = 0; axis < 3; ++axis) {
          EXPECT_LT(std::abs((*a.points[id])[axis] - (*b.points[id])[axis]), 0.5)
              << mpeg4::feature_points[id].id << " of " << a.name << " and " << b.name;
        }
      }
    }
  }
}

TEST(QuickSet, IsTheMiddleAndOneSideAndHasNoDoubles) {
  for (const std::string_view name : quick_set) {
    ASSERT_TRUE(parse_feature_point(name)) << name;
    EXPECT_EQ(std::count(quick_set.begin(), quick_set.end(), name), 1) << name;
    if (name == "3.12") continue;
    EXPECT_NE(mpeg4::feature_points[parse_feature_point(name)->value()].side, mpeg4::Side::right) << name;
  }
}

}  // namespace
}  // namespace semblante
