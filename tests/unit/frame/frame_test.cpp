#include "core/frame/frame.h"

#include <set>
#include <tuple>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include "core/frame/frame_guess.h"
#include "core/frame/human_size.h"

namespace semblante {
namespace {

TEST(Frame, All24Axes_AreDifferentRotations) {
  std::set<std::string> seen;
  for (const Axes& axes : all_axes()) {
    ASSERT_TRUE(are_valid(axes));
    const glm::dmat3 m = to_mpeg4(axes);
    EXPECT_EQ(glm::determinant(m), 1.0);
    EXPECT_EQ(m * to_vector(axes.up), glm::dvec3(0, 1, 0));
    EXPECT_EQ(m * to_vector(axes.front), glm::dvec3(0, 0, 1));
    seen.insert(std::string(to_string(axes.up)) + std::string(to_string(axes.front)));
  }
  EXPECT_EQ(seen.size(), 24U);
  EXPECT_EQ(to_mpeg4({}), glm::dmat3(1.0));
  EXPECT_FALSE(are_valid({Direction::plus_y, Direction::minus_y}));
}

TEST(Frame, Names_AreRead_AndNothingElse) {
  for (std::size_t i = 0; i < direction_names.size(); ++i)
    EXPECT_EQ(parse_direction(direction_names[i]), static_cast<Direction>(i));
  EXPECT_EQ(parse_direction("z"), Direction::plus_z);
  EXPECT_EQ(parse_direction("-x"), Direction::minus_x);
  for (const char* const text : {"", "+", "-", "W", "+YY", "++Y", "up", " Y"})
    EXPECT_EQ(parse_direction(text), std::nullopt);
  for (std::size_t i = 0; i < length_unit_names.size(); ++i)
    EXPECT_EQ(parse_length_unit(length_unit_names[i]), static_cast<LengthUnit>(i));
  EXPECT_EQ(parse_length_unit("km"), std::nullopt);
}

TEST(FrameWish, WhatTheUserSays_StandsInPlaceOfTheGuess) {
  const ModelFrame guess{{Direction::plus_z, Direction::minus_y}, true, LengthUnit::inch, false, {"seen"}};
  EXPECT_EQ(apply_wish(guess, {}), guess);
  const ModelFrame unit = apply_wish(guess, {LengthUnit::centimetre, {}, {}});
  EXPECT_EQ(unit.unit, LengthUnit::centimetre);
  EXPECT_TRUE(unit.unit_sure);
  EXPECT_EQ(unit.axes, guess.axes);
  const ModelFrame both = apply_wish(guess, {{}, Direction::plus_x, Direction::plus_y});
  EXPECT_EQ(both.axes, (Axes{Direction::plus_x, Direction::plus_y}));
  EXPECT_EQ(both.reasons.size(), 3U) << "what was seen, that it speaks otherwise, what the user says";
}

TEST(FrameWish, OneDirectionAlone_TakesTheOtherFromTheGuess_OrTheLeastTurn) {
  const auto axes = [](FrameWish wish, Axes guessed = {}) {
    return apply_wish({guessed, false, {}, false, {}}, wish).axes;
  };
  EXPECT_EQ(axes({{}, Direction::plus_x, {}}), (Axes{Direction::plus_x, Direction::plus_z}));
  EXPECT_EQ(axes({{}, Direction::plus_z, {}}), (Axes{Direction::plus_z, Direction::minus_y}));
  EXPECT_EQ(axes({{}, Direction::minus_z, {}}), (Axes{Direction::minus_z, Direction::plus_y}));
  EXPECT_EQ(axes({{}, {}, Direction::minus_x}), (Axes{Direction::plus_y, Direction::minus_x}));
  EXPECT_EQ(axes({{}, {}, Direction::minus_y}), (Axes{Direction::plus_z, Direction::minus_y}));
  for (const Axes& guessed : all_axes()) {
    for (std::size_t d = 0; d < direction_names.size(); ++d) {
      EXPECT_TRUE(are_valid(axes({{}, static_cast<Direction>(d), {}}, guessed)));
      EXPECT_TRUE(are_valid(axes({{}, {}, static_cast<Direction>(d)}, guessed)));
    }
  }
}

std::string shown(const std::optional<UnitBySize>& by_size) {
  return by_size ? std::string(to_string(by_size->unit)) + (by_size->is_sure ? "" : "?") : std::string();
}

TEST(HumanSize, Eyes_AreAFaceApart_InOneUnitOnly) {
  EXPECT_EQ(shown(unit_of_eye_separation(0.063)), "m");
  EXPECT_EQ(shown(unit_of_eye_separation(0.61)), "dm");
  EXPECT_EQ(shown(unit_of_eye_separation(6.5)), "cm");
  EXPECT_EQ(shown(unit_of_eye_separation(66.0)), "mm");
  EXPECT_EQ(shown(unit_of_eye_separation(4.0)), "cm?") << "close-set in cm, or a cartoon's in inches";
  EXPECT_EQ(shown(unit_of_eye_separation(2.5)), "in?") << "inches, or a model without a true size";
  EXPECT_EQ(shown(unit_of_eye_separation(1000.0)), "");
}

TEST(HumanSize, Height_OfAHeadABustOrABody_TellsTheUnit) {
  const auto of_height = [](double height) { return shown(unit_of_height(height)); };
  EXPECT_EQ(of_height(0.28), "m");
  EXPECT_EQ(of_height(2.9), "dm");
  EXPECT_EQ(of_height(28.0), "cm");
  EXPECT_EQ(of_height(280.0), "mm");
  EXPECT_EQ(of_height(1800.0), "mm") << "a body";
  EXPECT_EQ(of_height(1.8), "m?") << "a body, or a head in dm";
  EXPECT_EQ(of_height(180.0), "cm?") << "a body, or a head in mm";
  EXPECT_EQ(of_height(24.0), "cm?") << "a head in cm, or a bust in inches";
  EXPECT_EQ(of_height(60.0), "cm?") << "a bust in cm, or a body in inches";
  EXPECT_EQ(of_height(9.0), "in?") << "a head in inches, or a model without a true size";
  EXPECT_EQ(of_height(14.0), "in?") << "a bust in inches, likewise";
  EXPECT_EQ(of_height(1e9), "");
  EXPECT_EQ(of_height(0.0), "");
}

}  // namespace
}  // namespace semblante
