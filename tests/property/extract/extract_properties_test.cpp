// What section 8 promises on any head: what is put on comes off again, on whatever scale.
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/extract/extract.h"
#include "core/extract/named_set.h"

namespace semblante {
namespace {

/// A head of points alone, of any size and proportions, somewhere in space: vertex i is the i-th marked point.
struct RandomHead {
  FeaturePointSet points;
  std::vector<glm::vec3> neutral;
  Fapu fapu;
  double size = 1.0;

  RandomHead(std::mt19937& random, double exponent) : size(std::pow(10.0, exponent)) {
    std::uniform_real_distribution<double> place(-1.0, 1.0);
    std::bernoulli_distribution is_marked(0.8);
    for (std::size_t id = 0; id < feature_point_count; ++id) {
      const double x = place(random), y = place(random), z = place(random);
      if (!is_marked(random)) continue;
      points.push_back(
          {FeaturePointId(static_cast<std::uint8_t>(id)), VertexId(static_cast<std::uint32_t>(neutral.size())), {}});
      neutral.emplace_back(glm::dvec3(x, y, z) * size);
      points.back().position = neutral.back();
    }
    std::uniform_real_distribution<double> share(0.1, 0.8);
    for (auto& unit : fapu.value) unit = share(random) * size / 1024.0;
  }

  std::vector<glm::vec3> wear(const NamedSet& set) const {
    auto expression = neutral;
    for (const Displacement& d : to_model_units(set.view(), fapu).displacements) {
      const auto point =
          std::find_if(points.begin(), points.end(), [&](const FeaturePoint& p) { return p.id == d.point; });
      if (point != points.end()) expression[point->vertex->value()] += d.value;
    }
    return expression;
  }
};

NamedSet random_set(std::mt19937& random) {
  std::uniform_real_distribution<float> units(-1500.0F, 1500.0F);
  std::bernoulli_distribution moves(0.5);
  NamedSet set;
  for (std::size_t id = 0; id < feature_point_count; ++id) {
    const float x = units(random), y = units(random), z = units(random);
    if (moves(random))
      set.displacements.push_back({FeaturePointId(static_cast<std::uint8_t>(id)), {x, moves(random) ? y : 0.0F, z}});
  }
  return set;
}

TEST(ExtractProperties, WhatASetMovesGivesTheSetBack) {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    std::mt19937 random(seed);
    const RandomHead head(random, static_cast<double>(seed % 7) - 3.0);
    const NamedSet set = random_set(random);
    const auto result = extract_displacements(head.points, head.fapu, head.neutral, head.wear(set));
    ASSERT_TRUE(result) << seed << ": " << result.error().message;
    std::vector<Displacement> expected;
    for (const Displacement& d : set.displacements) {
      if (std::any_of(head.points.begin(), head.points.end(), [&](const auto& p) { return p.id == d.point; }))
        expected.push_back(d);
    }
    ASSERT_EQ(result->displacements.size(), expected.size()) << seed;
    EXPECT_EQ(result->at_rest.size() + result->displacements.size(), head.points.size()) << seed;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_EQ(result->displacements[i].point, expected[i].point) << seed;
      for (int axis = 0; axis < 3; ++axis) {
        // Positions are float32 and below 4 sizes: two roundings of half an ulp of that.
        const double ulp = 4.0 * head.size / (1 << 23);
        const double unit = *head.fapu[fapu_of(expected[i].point, axis)];
        EXPECT_NEAR(result->displacements[i].value[axis], expected[i].value[axis], ulp / unit + 1e-3) << seed;
      }
    }
  }
}

// A set is of no head: the same head in another unit gives the same set.
TEST(ExtractProperties, TheUnitOfAModelIsNoPartOfItsSets) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    const RandomHead head(random, 0.0);
    const auto expression = head.wear(random_set(random));
    auto larger_neutral = head.neutral;
    auto larger_expression = expression;
    for (auto* shape : {&larger_neutral, &larger_expression}) {
      for (auto& p : *shape) p *= 1024.0F;  // exact in float32
    }
    Fapu larger = head.fapu;
    for (auto& unit : larger.value) *unit *= 1024.0;
    const auto one = extract_displacements(head.points, head.fapu, head.neutral, expression);
    const auto other = extract_displacements(head.points, larger, larger_neutral, larger_expression);
    ASSERT_TRUE(one);
    ASSERT_TRUE(other);
    ASSERT_EQ(one->displacements.size(), other->displacements.size());
    for (std::size_t i = 0; i < one->displacements.size(); ++i)
      EXPECT_EQ(one->displacements[i].value, other->displacements[i].value);
  }
}

}  // namespace
}  // namespace semblante
