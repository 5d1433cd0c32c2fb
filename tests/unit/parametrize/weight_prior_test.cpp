#include "core/parametrize/weight_prior.h"

#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace semblante {
namespace {

std::uint8_t id(std::string_view name) { return testing::fp(name).value(); }

WeightPrior::Places all_apart() {
  WeightPrior::Places places{};
  for (std::uint32_t id = 0; id < places.size(); ++id) places[id] = {id, glm::dvec3(id)};
  return places;
}

WeightRow row_of(std::initializer_list<std::pair<const char*, double>> weights) {
  WeightRow row;
  for (const auto& [name, weight] : weights) row.at(id(name)) = weight;
  return row;
}

WeightRow corrected(const WeightPrior& prior, WeightRow row, const WeightPrior::Places& places = all_apart(),
                    const glm::dvec3& position = glm::dvec3(0.0)) {
  prior.correct(row, position, places);
  return row;
}

TEST(WeightPrior, WithoutATableChangesNothing) {
  const WeightRow row = row_of({{"4.1", 0.5}, {"4.3", 0.3}});
  EXPECT_EQ(corrected({}, row), row);
}

TEST(WeightPrior, AddsTheProductOfThePairTimesItsEntryOnBothSides) {
  const WeightPrior::Entry table[] = {{id("4.1"), id("4.3"), id("3.1"), 50}};
  const WeightPrior prior{table};
  EXPECT_DOUBLE_EQ(corrected(prior, row_of({{"4.1", 0.5}, {"4.3", 0.4}}))[id("3.1")], 0.1);
  EXPECT_DOUBLE_EQ(corrected(prior, row_of({{"4.2", 0.5}, {"4.4", 0.4}}))[id("3.2")], 0.1);
  EXPECT_EQ(corrected(prior, row_of({{"4.1", 0.5}, {"4.4", 0.4}}))[id("3.1")], 0.0);
}

TEST(WeightPrior, UsesTheShareOfTheRoot) {
  const WeightPrior::Entry table[] = {{id("4.1"), WeightPrior::root, id("4.1"), -100}};
  const WeightRow row = corrected(WeightPrior{table}, row_of({{"4.1", 0.75}}));
  EXPECT_DOUBLE_EQ(row[id("4.1")], 0.75 * 0.75 / (0.75 + 0.75 * 0.25 * 0.75));
  EXPECT_EQ(corrected(WeightPrior{table}, row_of({{"4.1", 1.0}}))[id("4.1")], 1.0);
}

TEST(WeightPrior, ActsOnOneSideOfAPointByTheOffsetFromIt) {
  const auto up = static_cast<std::uint8_t>(WeightPrior::first_axis + 1);
  const WeightPrior::Entry table[] = {{id("11.1"), up, id("4.1"), 50}};
  const WeightPrior prior{table};
  const WeightPrior::Places places = all_apart();
  const WeightRow row = row_of({{"11.1", 0.4}});
  const glm::dvec3 point = places[id("11.1")].position;
  const glm::dvec3 above(0.0, WeightPrior::offset_unit, 0.0);
  EXPECT_NEAR(corrected(prior, row, places, point + above)[id("4.1")], 0.4 * 0.5, 1e-12);
  EXPECT_NEAR(corrected(prior, row, places, point + above)[id("4.2")], 0.4 * 0.5, 1e-12);
  EXPECT_EQ(corrected(prior, row, places, point - above), row);
  EXPECT_EQ(corrected(prior, row, places, point), row);
}

TEST(WeightPrior, TurnsOffsetsToTheSideRoundOnTheOtherSide) {
  const auto across = static_cast<std::uint8_t>(WeightPrior::first_axis);
  const WeightPrior::Entry table[] = {{id("4.3"), across, id("4.5"), 50}};
  const WeightPrior prior{table};
  const WeightPrior::Places places = all_apart();
  const glm::dvec3 side(WeightPrior::offset_unit, 0.0, 0.0);
  const glm::dvec3 left = places[id("4.3")].position + side;
  const glm::dvec3 right = places[id("4.4")].position - side;
  EXPECT_NEAR(corrected(prior, row_of({{"4.3", 0.4}}), places, left)[id("4.5")], 0.2, 1e-12);
  EXPECT_NEAR(corrected(prior, row_of({{"4.4", 0.4}}), places, right)[id("4.6")], 0.2, 1e-12);
}

TEST(WeightPrior, ActsAlikeOnBothSidesOfAPointByTheSquareOfTheOffset) {
  const auto back = static_cast<std::uint8_t>(WeightPrior::first_product + 2);
  const WeightPrior::Entry table[] = {{id("2.1"), back, id("2.1"), 50}};
  const WeightPrior prior{table};
  const WeightPrior::Places places = all_apart();
  const glm::dvec3 point = places[id("2.1")].position;
  for (const double z : {-1.0, 1.0}) {
    const glm::dvec3 there = point + glm::dvec3(0.0, 0.0, z * WeightPrior::offset_unit);
    EXPECT_NEAR(corrected(prior, row_of({{"2.1", 0.4}}), places, there)[id("2.1")], 0.6, 1e-12);
  }
}

TEST(WeightPrior, TurnsProductsWithTheOffsetToTheSideRoundOnTheOtherSide) {
  const auto across_and_back = static_cast<std::uint8_t>(WeightPrior::first_product + 4);
  const WeightPrior::Entry table[] = {{id("2.11"), across_and_back, id("2.13"), 50}};
  const WeightPrior prior{table};
  const WeightPrior::Places places = all_apart();
  const glm::dvec3 unit(WeightPrior::offset_unit);
  const glm::dvec3 left = places[id("2.11")].position + unit;
  const glm::dvec3 right = places[id("2.12")].position + unit * glm::dvec3(-1.0, 1.0, 1.0);
  EXPECT_NEAR(corrected(prior, row_of({{"2.11", 0.4}}), places, left)[id("2.13")], 0.2, 1e-12);
  EXPECT_NEAR(corrected(prior, row_of({{"2.12", 0.4}}), places, right)[id("2.14")], 0.2, 1e-12);
}

TEST(WeightPrior, KeepsWeightsPositiveAndSumsAtMostOne) {
  const WeightPrior::Entry table[] = {{id("4.1"), id("4.3"), id("4.1"), -900}, {id("4.1"), id("4.3"), id("4.5"), 900}};
  const WeightRow row = corrected(WeightPrior{table}, row_of({{"4.1", 0.5}, {"4.3", 0.5}}));
  EXPECT_LT(row[id("4.1")], 0.1);
  EXPECT_GT(row[id("4.1")], 0.0);
  row.for_each([](std::size_t, double w) { EXPECT_GE(w, 0.0); });
  EXPECT_NEAR(sum_of(row), 1.0, 1e-12);
}

TEST(WeightPrior, GivesNoWeightToPointsThatAreNotThereAndNoneToPairsAtOnePlace) {
  const WeightPrior::Entry table[] = {{id("4.1"), id("4.3"), id("3.1"), 50}};
  const WeightRow row = row_of({{"4.1", 0.5}, {"4.3", 0.4}});
  WeightPrior::Places absent = all_apart();
  absent[id("3.1")].vertex = WeightPrior::nowhere;
  EXPECT_EQ(corrected(WeightPrior{table}, row, absent), row);
  WeightPrior::Places together = all_apart();
  together[id("4.3")] = together[id("4.1")];
  EXPECT_EQ(corrected(WeightPrior{table}, row, together), row);
}

TEST(WeightPrior, LeavesTheEdgesOfLipsAndLidsAlone) {
  EXPECT_FALSE(WeightPrior::allows(id("2.2"), id("2.4")));
  EXPECT_FALSE(WeightPrior::allows(id("3.1"), id("3.7")));
  EXPECT_TRUE(WeightPrior::allows(id("2.2"), id("8.1")));
  EXPECT_TRUE(WeightPrior::allows(id("3.1"), id("2.4")));
  EXPECT_FALSE(WeightPrior::allows(id("3.1"), WeightPrior::first_axis));
  EXPECT_TRUE(WeightPrior::allows(id("4.1"), WeightPrior::first_axis));
  EXPECT_FALSE(WeightPrior::allows(id("4.1"), WeightPrior::first_product));
  EXPECT_TRUE(WeightPrior::allows(id("2.1"), WeightPrior::first_product));
  for (const auto& edge : {row_of({{"2.2", 0.6}, {"2.6", 0.4}}), row_of({{"3.1", 0.3}, {"3.7", 0.7}})}) {
    EXPECT_EQ(corrected(trained_weight_prior(), edge, all_apart(), glm::dvec3(0.5)), edge);
  }
}

TEST(WeightPrior, IsTrained) {
  const WeightRow brow = row_of({{"4.1", 0.5}, {"4.2", 0.5}});
  EXPECT_NE(corrected(trained_weight_prior(), brow), brow);
}

}  // namespace
}  // namespace semblante
