#include "core/expressions/contact.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

namespace semblante {
namespace {

constexpr double mouth_nose = 2.0;
constexpr float give = static_cast<float>(lip_give * mouth_nose);

FeaturePointId fp(const char* name) { return parse_feature_point(name).value(); }

FeaturePointSet lips(float apart) {
  FeaturePointSet points;
  for (const char* const name : {"2.2", "2.3", "2.6", "2.7", "2.8", "2.9"}) {
    const bool upper = number_of(fp(name)) == 2 || number_of(fp(name)) == 6 || number_of(fp(name)) == 7;
    points.push_back({fp(name), VertexId(0), {0.0F, upper ? apart : 0.0F, 0.0F}});
  }
  return points;
}

float y_of(const std::vector<Displacement>& displacements, const char* name) {
  for (const Displacement& d : displacements) {
    if (d.point == fp(name)) return d.value.y;
  }
  return 0.0F;
}

TEST(StopAtContact, LetsLipsMeetAndNoMore) {
  std::vector<Displacement> closing = {{fp("2.2"), {0.0F, -0.3F, 0.1F}}, {fp("2.3"), {0.0F, 0.1F, 0.2F}}};
  stop_at_contact(closing, lips(0.2F), mouth_nose);
  EXPECT_NEAR(y_of(closing, "2.3") - y_of(closing, "2.2"), 0.2F + give, 1e-6F);
  EXPECT_NEAR(y_of(closing, "2.2"), -0.3F + (0.2F - give) / 2.0F, 1e-6F);  // both stay behind by as much
  EXPECT_EQ(closing[0].value.z, 0.1F);
  EXPECT_EQ(closing[1].value.z, 0.2F);
}

TEST(StopAtContact, GoesByMeasuredGapsWhereTheyAreKnown) {
  std::vector<Displacement> closing = {{fp("2.2"), {0.0F, -0.3F, 0.0F}},
                                       {fp("2.3"), {0.0F, 0.1F, 0.0F}},
                                       {fp("2.7"), {0.0F, -0.3F, 0.0F}},
                                       {fp("2.9"), {0.0F, 0.3F, 0.0F}}};
  stop_at_contact(closing, lips(0.2F), mouth_nose, LipGaps{{0.1, 0.0, 0.5}});
  EXPECT_NEAR(y_of(closing, "2.3") - y_of(closing, "2.2"), 0.1F + give, 1e-6F);
  EXPECT_NEAR(y_of(closing, "2.9") - y_of(closing, "2.7"), 0.5F + give, 1e-6F);
}

TEST(StopAtContact, LipsOfOneSkinDoNotYield) {
  std::vector<Displacement> closing = {{fp("2.2"), {0.0F, -0.3F, 0.0F}},
                                       {fp("2.3"), {0.0F, 0.1F, 0.0F}},
                                       {fp("8.1"), {0.0F, -0.2F, 0.0F}},
                                       {fp("8.2"), {0.0F, -0.2F, 0.0F}}};
  stop_at_contact(closing, lips(0.2F), mouth_nose, LipGaps{{0.1, 0.0, 0.0}, true});
  EXPECT_NEAR(y_of(closing, "2.3") - y_of(closing, "2.2"), 0.1F, 1e-6F);
  // A quarter of the closing remains, and of what the outer contours would close.
  EXPECT_NEAR(y_of(closing, "8.1"), -0.05F, 1e-6F);
  EXPECT_EQ(y_of(closing, "8.2"), -0.2F);
}

TEST(StopAtContact, LeavesWhatDoesNotMeetAlone) {
  const std::vector<Displacement> apart = {{fp("2.6"), {0.0F, -0.05F, 0.0F}}, {fp("2.8"), {0.0F, 0.05F, 0.0F}}};
  std::vector<Displacement> same = apart;
  stop_at_contact(same, lips(0.2F), mouth_nose);
  EXPECT_EQ(y_of(same, "2.6"), y_of(apart, "2.6"));
  EXPECT_EQ(y_of(same, "2.8"), y_of(apart, "2.8"));
  // Both go up together: touching lips stay as they are.
  std::vector<Displacement> together = {{fp("2.2"), {0.0F, 0.5F, 0.0F}}, {fp("2.3"), {0.0F, 0.5F, 0.0F}}};
  stop_at_contact(together, lips(0.0F), mouth_nose);
  EXPECT_EQ(y_of(together, "2.2"), 0.5F);
  EXPECT_EQ(y_of(together, "2.3"), 0.5F);
}

TEST(StopAtContact, NeedsBothPoints) {
  std::vector<Displacement> closing = {{fp("2.2"), {0.0F, -0.3F, 0.0F}}, {fp("2.3"), {0.0F, 0.1F, 0.0F}}};
  FeaturePointSet points = lips(0.0F);
  std::erase_if(points, [](const FeaturePoint& p) { return p.id == fp("2.3"); });
  stop_at_contact(closing, points, mouth_nose);
  EXPECT_EQ(y_of(closing, "2.2"), -0.3F);
}

FeaturePointSet lip_and_teeth(float back) {
  return {{fp("2.3"), VertexId(0), {0.0F, 0.0F, back}}, {fp("9.10"), VertexId(0), {0.0F, 0.0F, 0.0F}}};
}

float z_of(const std::vector<Displacement>& displacements, const char* name) {
  for (const Displacement& d : displacements) {
    if (d.point == fp(name)) return d.value.z;
  }
  return 0.0F;
}

TEST(ReachUpperTeeth, TakesTheLowerLipToWhereThisHeadHasThem) {
  for (const float back : {0.3F, 0.5F, 0.8F}) {
    std::vector<Displacement> lip = {
        {fp("2.2"), {0.0F, 0.1F, 0.01F}}, {fp("2.3"), {0.0F, 0.1F, -0.4F}}, {fp("8.2"), {0.0F, 0.1F, -0.2F}}};
    reach_upper_teeth(lip, lip_and_teeth(back));
    EXPECT_NEAR(z_of(lip, "2.3"), -share_to_teeth * back, 1e-6);
    EXPECT_NEAR(z_of(lip, "8.2"), -share_to_teeth * back / 2.0, 1e-6);  // as the set has them to each other
    EXPECT_EQ(z_of(lip, "2.2"), 0.01F);
    EXPECT_EQ(y_of(lip, "2.3"), 0.1F);
  }
}

TEST(ReachUpperTeeth, KeepsWithinReason) {
  const std::vector<Displacement> lip = {{fp("2.3"), {0.0F, 0.1F, -0.1F}}};
  for (const auto& [back, scale] : {std::pair(10.0F, most_to_teeth), std::pair(-1.0F, 1.0 / most_to_teeth)}) {
    std::vector<Displacement> there = lip;
    reach_upper_teeth(there, lip_and_teeth(back));
    EXPECT_NEAR(z_of(there, "2.3"), -0.1 * scale, 1e-6);
  }
}

TEST(ReachUpperTeeth, NeedsLipAndTeeth) {
  std::vector<Displacement> lip = {{fp("2.3"), {0.0F, 0.1F, -0.1F}}};
  reach_upper_teeth(lip, lips(0.1F));
  EXPECT_EQ(z_of(lip, "2.3"), -0.1F);
  std::vector<Displacement> other = {{fp("2.2"), {0.0F, 0.1F, -0.1F}}};
  reach_upper_teeth(other, lip_and_teeth(1.0F));
  EXPECT_EQ(z_of(other, "2.2"), -0.1F);
}

TEST(OnFace, BringsTheLipToTheTeethInFvAlone) {
  Fapu fapu;
  fapu.value = {1.0 / 1024, 6.0 / 1024, 4.5 / 1024, mouth_nose / 1024, 5.0 / 1024};
  for (std::size_t v = 0; v < viseme_library().size(); ++v) {
    const DisplacementSet& set = viseme_library()[v];
    EXPECT_EQ(set.meets_upper_teeth, set.name == "f_v");
    const float plain = z_of(to_model_units(set, fapu).displacements, "2.3");
    const float there = z_of(on_face(set, fapu, lip_and_teeth(1.0F)).displacements, "2.3");
    if (set.name == "f_v") {
      EXPECT_NEAR(there, -share_to_teeth, 1e-5);
    } else {
      EXPECT_EQ(there, plain) << set.name;
    }
  }
}

TEST(OnFace, ShutsTheLipsInPbmHoweverFarTheyAreApart) {
  Fapu fapu;
  fapu.value = {1.0 / 1024, 6.0 / 1024, 4.5 / 1024, mouth_nose / 1024, 5.0 / 1024};
  for (const float apart : {0.0F, 0.05F, 0.15F}) {
    const auto p_b_m = on_face(viseme_library()[1], fapu, lips(apart)).displacements;
    EXPECT_NEAR(y_of(p_b_m, "2.3") - y_of(p_b_m, "2.2"), apart + give, 1e-5F) << apart;
    EXPECT_NEAR(y_of(p_b_m, "2.8") - y_of(p_b_m, "2.6"), apart + give, 1e-5F) << apart;
  }
}

TEST(OnFace, ArticulationMultipliesTheOpeningOfTheJawInVisemes) {
  Fapu fapu;
  fapu.value = {1.0 / 1024, 6.0 / 1024, 4.5 / 1024, mouth_nose / 1024, 5.0 / 1024};
  const auto jaw = to_model_units(jaw_open_action(), fapu).displacements;
  const auto at = [&](const DisplacementSet& set, double articulation) {
    return on_face(set, fapu, {}, std::nullopt, articulation).displacements;
  };
  const DisplacementSet& a = viseme_library()[10];
  ASSERT_EQ(a.name, "a");
  ASSERT_GT(a.jaw_open, 0.3);
  for (const char* const point : {"2.1", "2.3", "2.10", "8.2"}) {
    for (const double articulation : {least_articulation, 0.5, most_articulation}) {
      const double more = (articulation - 1.0) * a.jaw_open * static_cast<double>(y_of(jaw, point));
      EXPECT_NEAR(y_of(at(a, articulation), point), static_cast<double>(y_of(at(a, 1.0), point)) + more, 1e-5)
          << point << " " << articulation;
    }
  }
  // No point joins the set: by Eq. 5 it would take that point from an expression.
  EXPECT_EQ(at(a, 2.0).size(), a.displacements.size());
}

TEST(OnFace, ArticulationLeavesClosedLipsAndExpressionsAsTheyAre) {
  EXPECT_EQ(viseme_library()[1].jaw_open, 0.0) << "p_b_m";
  for (const DisplacementSet& set : expression_library()) EXPECT_EQ(set.jaw_open, 0.0) << set.name;
}

TEST(OnFace, IsTheSetInModelUnits_WherePointsAreUnknown) {
  Fapu fapu;
  fapu.value = {1.0 / 1024, 6.0 / 1024, 4.5 / 1024, mouth_nose / 1024, 5.0 / 1024};
  for (const DisplacementSet& set : viseme_library()) {
    const auto plain = to_model_units(set, fapu).displacements;
    const auto there = on_face(set, fapu, {}).displacements;
    ASSERT_EQ(plain.size(), there.size());
    for (std::size_t i = 0; i < plain.size(); ++i) EXPECT_EQ(plain[i].value, there[i].value);
  }
}

/// People: the values of heads with known points lie between these.
TEST(UnitsOfLibrary, OfPeopleAreTheirOwn) {
  Fapu fapu;
  for (const std::array<double, 5>& of :
       {std::array{0.16, 1.0, 0.76, 0.33, 0.79}, std::array{0.16, 1.0, 0.85, 0.30, 0.85},
        std::array{0.21, 1.0, 0.65, 0.33, 1.00}, std::array{0.18, 1.0, 0.9, 0.48, 0.8}}) {
    std::copy(of.begin(), of.end(), fapu.value.begin());
    EXPECT_EQ(units_of_library(fapu).value, fapu.value);
  }
}

/// A monkey: a mouth a quarter of the eyes' distance wide, twice as far below the nose.
TEST(UnitsOfLibrary, OfAMuzzleFollowItsMouthAndEyes) {
  Fapu fapu;
  fapu.value = {0.7, 1.0, 1.2, 0.6, 0.3};
  const Fapu units = units_of_library(fapu);
  EXPECT_EQ(units[FapuUnit::irisd], 0.7);
  EXPECT_EQ(units[FapuUnit::ens], most_nose_of_eyes * 1.0);
  EXPECT_EQ(units[FapuUnit::mns], most_lip_of_mouth * 0.3);
  EXPECT_EQ(units[FapuUnit::mw], 0.3);
  // joy draws the corners up by less than half of the way from the middle of the mouth to them: an arc, not a V
  const auto joy = on_face(expression_library()[1], fapu, {}).displacements;
  EXPECT_LT(y_of(joy, "2.4") - y_of(joy, "2.3"), 0.5F * 0.5F * 1024.0F * 0.3F);
  EXPECT_GT(y_of(joy, "2.4"), 0.0F);
}

/// A witch: her nose hangs so low that its base is just above the lip.
TEST(UnitsOfLibrary, UnderAHangingNose_OpenTheMouthAsFarAsPeoplesDo) {
  Fapu fapu;
  fapu.value = {0.16, 1.0, 0.9, 0.05, 0.8};
  EXPECT_EQ(units_of_library(fapu)[FapuUnit::mns], least_lip_of_mouth * 0.8);
  fapu.value[static_cast<std::size_t>(FapuUnit::mw)] = 2.0;  // a frog's mouth: people's eyes say how far it opens
  EXPECT_EQ(units_of_library(fapu)[FapuUnit::mns], least_lip_of_eyes * 1.0);
  fapu.origin[static_cast<std::size_t>(FapuUnit::mns)] = FapuOrigin::user;
  EXPECT_EQ(units_of_library(fapu)[FapuUnit::mns], 0.05);
}

TEST(UnitsOfLibrary, GivenByHandStay_AndMissingOnesLimitNothing) {
  Fapu fapu;
  fapu.value = {0.7, 1.0, 1.2, 0.6, 0.3};
  fapu.origin[static_cast<std::size_t>(FapuUnit::mns)] = FapuOrigin::user;
  EXPECT_EQ(units_of_library(fapu)[FapuUnit::mns], 0.6);
  fapu.value = {0.7, std::nullopt, 1.2, 0.6, std::nullopt};
  fapu.origin = {};
  EXPECT_EQ(units_of_library(fapu).value, fapu.value);
}

/// What somebody made or measured has the units of the standard.
TEST(UnitsOfLibrary, AreOfTheLibraryAlone) {
  Fapu fapu;
  fapu.value = {0.7, 1.0, 1.2, 0.6, 0.3};
  const DisplacementSet& joy = expression_library()[1];
  const auto made = on_face({"joy", joy.displacements}, fapu, {}).displacements;
  EXPECT_FLOAT_EQ(y_of(made, "2.4"), y_of(to_model_units(joy, fapu).displacements, "2.4"));
}

}  // namespace
}  // namespace semblante
