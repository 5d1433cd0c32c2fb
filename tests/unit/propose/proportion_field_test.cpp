#include "core/propose/proportion_field.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace semblante {
namespace {

TEST(ProportionField, MeetsItsSamplesAndIsSureThere) {
  const ProportionField field({{{0, 0, 0}, {0.1, 0, 0}, 0.001}, {{1, 0, 0}, {1, 0.2, 0}, 0.001}});
  EXPECT_LT(glm::distance(field.at({0, 0, 0}).place, {0.1, 0, 0}), 0.002);
  EXPECT_LT(glm::distance(field.at({1, 0, 0}).place, {1, 0.2, 0}), 0.002);
  EXPECT_LT(field.at({1, 0, 0}).deviation, 0.002);
  EXPECT_GT(field.at({0, 2, 0}).deviation, 0.05);
}

TEST(ProportionField, CarriesAShiftOfAllSamplesEverywhere) {
  std::vector<ProportionField::Sample> samples;
  for (const glm::dvec3& p : {glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)}) {
    samples.push_back({p, p + glm::dvec3(0.1, 0.1, 0.1), 0.01});
  }
  const ProportionField field(std::move(samples));
  EXPECT_LT(glm::distance(field.at({0.4, 0.4, 0.4}).place, {0.5, 0.5, 0.5}), 0.03);
}

TEST(ProportionField, OfNoSamplesLeavesPlacesAlone) {
  EXPECT_EQ(ProportionField({}).at({1, 2, 3}).place, glm::dvec3(1, 2, 3));
}

TEST(ProportionField, BearsTheSamePlaceTwice) {
  const ProportionField field({{{1, 0, 0}, {1.1, 0, 0}, 0.0}, {{1, 0, 0}, {1.3, 0, 0}, 0.0}});
  const double x = field.at({1, 0, 0}).place.x;
  EXPECT_GT(x, 0.9);
  EXPECT_LT(x, 1.5);
}

}  // namespace
}  // namespace semblante
