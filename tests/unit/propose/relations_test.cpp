#include "core/propose/relations.h"

#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace semblante {
namespace {

using testing::fp;

TEST(Relations, PutALipPointHalfWayBetweenMiddleAndCorner) {
  Places settled;
  settled[fp("2.2").value()] = glm::dvec3(0.0, 1.0, 2.0);
  settled[fp("2.4").value()] = glm::dvec3(0.4, 0.9, 1.8);
  EXPECT_EQ(apply_relations(fp("2.6"), {0.3, 0.95, 1.9}, settled), glm::dvec3(0.2, 0.95, 1.9));
}

// A lip of height 1 in its middle.
TEST(Relations, KeepTheContourOfAHighLowerLipBelowItsEdge) {
  Places settled;
  settled[fp("2.3").value()] = glm::dvec3(0.0, 0.0, 2.0);
  settled[fp("8.2").value()] = glm::dvec3(0.0, -1.0, 2.0);
  settled[fp("2.8").value()] = glm::dvec3(0.5, 0.25, 1.5);
  EXPECT_EQ(apply_relations(fp("8.7"), {0.5, 0.2, 1.5}, settled), glm::dvec3(0.5, 0.25 - 0.7, 1.5));
  EXPECT_EQ(apply_relations(fp("8.7"), {0.5, -0.6, 1.5}, settled), glm::dvec3(0.5, -0.6, 1.5));
  EXPECT_EQ(apply_relations(fp("8.8"), {-0.5, 0.2, 1.5}, settled), glm::dvec3(-0.5, 0.2, 1.5)) << "2.9 is not known";
}

TEST(Relations, LeaveAPlaceAloneWhoseNeighboursAreNotKnown) {
  Places settled;
  settled[fp("2.2").value()] = glm::dvec3(0.0, 1.0, 2.0);
  EXPECT_EQ(apply_relations(fp("2.6"), {0.3, 0.95, 1.9}, settled), glm::dvec3(0.3, 0.95, 1.9));
  EXPECT_EQ(apply_relations(fp("9.3"), {0.3, 0.95, 1.9}, settled), glm::dvec3(0.3, 0.95, 1.9));
}

TEST(Relations, LeanOnPointsThatHaveNone) {
  // Proposals settle the points without relations first.
  for (const char* const name :
       {"2.2", "2.3", "2.4", "2.5", "3.7", "3.8", "3.11", "3.12", "6.2", "8.1", "8.2", "8.3", "8.4", "9.12"}) {
    EXPECT_FALSE(has_relation(fp(name))) << name;
  }
  EXPECT_TRUE(has_relation(fp("8.5")));
}

}  // namespace
}  // namespace semblante
