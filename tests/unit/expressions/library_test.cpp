// The library of visemes and expressions: units, completeness, and what every entry must do to be what its name says.
#include "core/expressions/library.h"

#include <cmath>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/expressions/generate/render.h"
#include "core/expressions/kernel_rig.h"
#include "core/tables/mpeg4.h"

namespace semblante {
namespace {

FeaturePointId point(const char* id) { return *parse_feature_point(id); }

/// Displacement of a point in a set, FAPU units; zero when the set does not move it.
glm::vec3 moved(const DisplacementSet& set, const char* id) {
  for (const Displacement& d : set.displacements) {
    if (d.point == point(id)) return d.value;
  }
  return glm::vec3(0.0F);
}

const DisplacementSet& viseme(std::string_view name) {
  for (const DisplacementSet& set : viseme_library()) {
    if (set.name == name) return set;
  }
  throw std::runtime_error("no such viseme");
}

const DisplacementSet& expression(std::string_view name) {
  for (const DisplacementSet& set : expression_library()) {
    if (set.name == name) return set;
  }
  throw std::runtime_error("no such expression");
}

TEST(Expressions_Generated, AreWhatTheDataGive) {
  EXPECT_THAT(codegen::out_of_date(SEMBLANTE_SOURCE_DIR, expressions::generated_files), ::testing::IsEmpty())
      << "run: ninja -C build semblante-generate-expressions";
}

TEST(Expressions_Units, FollowTheFapOfTheAxis) {
  EXPECT_EQ(fapu_of(point("2.1"), 1), FapuUnit::mns);    // FAP 3
  EXPECT_EQ(fapu_of(point("2.1"), 0), FapuUnit::mw);     // FAP 15
  EXPECT_EQ(fapu_of(point("3.1"), 1), FapuUnit::irisd);  // FAP 19
  EXPECT_EQ(fapu_of(point("9.1"), 0), FapuUnit::ens);    // FAP 61, against the region's ES
  EXPECT_EQ(fapu_of(point("9.3"), 0), FapuUnit::ens);    // FAP 64
  EXPECT_EQ(fapu_of(point("5.1"), 0), FapuUnit::es);     // FAP 39
  EXPECT_EQ(fapu_of(point("6.1"), 2), FapuUnit::mw);     // FAP 45, against the region's MNS
  EXPECT_EQ(fapu_of(point("10.1"), 1), FapuUnit::ens);   // FAP 65
  EXPECT_EQ(fapu_of(point("10.3"), 0), FapuUnit::ens);   // FAP 67
}

TEST(Expressions_Units, FollowTheRegion_WhereNoFapMoves) {
  EXPECT_EQ(fapu_of(point("2.11"), 0), FapuUnit::mw);
  EXPECT_EQ(fapu_of(point("2.11"), 1), FapuUnit::mns);
  EXPECT_EQ(fapu_of(point("8.9"), 2), FapuUnit::mns);
  EXPECT_EQ(fapu_of(point("9.11"), 1), FapuUnit::mns);  // teeth belong to the mouth
  EXPECT_EQ(fapu_of(point("3.13"), 1), FapuUnit::irisd);
  EXPECT_EQ(fapu_of(point("3.1"), 0), FapuUnit::es);
  EXPECT_EQ(fapu_of(point("3.1"), 2), FapuUnit::es);
  EXPECT_EQ(fapu_of(point("4.3"), 0), FapuUnit::es);
  EXPECT_EQ(fapu_of(point("4.3"), 2), FapuUnit::ens);
  EXPECT_EQ(fapu_of(point("9.5"), 0), FapuUnit::es);
  EXPECT_EQ(fapu_of(point("5.3"), 2), FapuUnit::ens);
  EXPECT_EQ(fapu_of(point("11.1"), 0), FapuUnit::es);
}

TEST(Expressions_ToModelUnits, MultipliesEachAxisByItsUnit) {
  Fapu fapu;
  fapu.value = {2.0, 3.0, 5.0, 7.0, 11.0};  // IRISD ES ENS MNS MW
  const Displacement one{point("2.1"), {1.0F, -10.0F, 100.0F}};
  const auto model = to_model_units({"test", std::span(&one, 1)}, fapu);
  // 2.1: x in MW, y and z in MNS: (1 * 11, -10 * 7, 100 * 7)
  ASSERT_EQ(model.displacements.size(), 1U);
  EXPECT_EQ(model.displacements[0].value, glm::vec3(11.0F, -70.0F, 700.0F));
  EXPECT_TRUE(model.skipped.empty());
}

TEST(Expressions_ToModelUnits, LeavesOutAndNamesPoints_WhenAUnitIsMissing) {
  Fapu fapu;
  fapu.value = {2.0, 3.0, 5.0, std::nullopt, 11.0};
  const std::array<Displacement, 3> three = {{{point("2.1"), {1.0F, 1.0F, 0.0F}},    // y in MNS: missing
                                              {point("2.4"), {1.0F, 0.0F, 0.0F}},    // x in MW: there
                                              {point("4.1"), {0.0F, 1.0F, 0.0F}}}};  // ENS
  const auto model = to_model_units({"test", three}, fapu);
  ASSERT_EQ(model.skipped.size(), 1U);
  EXPECT_EQ(model.skipped[0].point, point("2.1"));
  EXPECT_EQ(model.skipped[0].unit, FapuUnit::mns);
  ASSERT_EQ(model.displacements.size(), 2U);
  EXPECT_EQ(model.displacements[0].point, point("2.4"));
}

TEST(Expressions_ToDense, PutsEachPointInItsPlace) {
  const Displacement one{point("2.3"), {1.0F, 2.0F, 3.0F}};
  const auto dense = to_dense(std::span(&one, 1));
  EXPECT_EQ(dense[6], 1.0F);  // 2.3 is index 2
  EXPECT_EQ(dense[7], 2.0F);
  EXPECT_EQ(dense[8], 3.0F);
  EXPECT_EQ(dense[9], 0.0F);
}

TEST(Expressions_Library, HasTheStandardsNamesInOrder) {
  ASSERT_EQ(viseme_library().size(), mpeg4::visemes.size());
  ASSERT_EQ(expression_library().size(), mpeg4::expressions.size());
  for (std::size_t i = 0; i < 15; ++i) EXPECT_EQ(viseme_library()[i].name, mpeg4::visemes[i].name);
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(expression_library()[i].name, mpeg4::expressions[i].name);
  EXPECT_TRUE(viseme_library()[0].displacements.empty());
  EXPECT_TRUE(expression_library()[0].displacements.empty());
}

TEST(Expressions_Library, MovesNoPupilNoEarNoHead) {
  for (const auto sets : {viseme_library(), expression_library()}) {
    for (const DisplacementSet& set : sets) {
      for (const Displacement& d : set.displacements) {
        EXPECT_TRUE(d.point != point("3.5") && d.point != point("3.6") && d.point != point("7.1")) << set.name;
        EXPECT_NE(group_of(d.point), 10) << set.name;
      }
    }
  }
}

TEST(Expressions_Visemes, MoveMouthAndCheeksOnly) {
  for (const DisplacementSet& set : viseme_library()) {
    for (const Displacement& d : set.displacements) {
      const int group = group_of(d.point);
      EXPECT_TRUE(group == 2 || group == 5 || group == 6 || group == 8 || group == 9) << set.name << to_string(d.point);
    }
  }
}

TEST(Expressions_Visemes, AreSymmetric) {
  for (const DisplacementSet& set : viseme_library()) {
    for (const Displacement& d : set.displacements) {
      const auto mirror = FeaturePointId(mpeg4::feature_points[d.point.value()].mirror);
      const glm::vec3 other = moved(set, to_string(mirror).c_str());
      EXPECT_EQ(other, glm::vec3(-d.value.x, d.value.y, d.value.z)) << set.name << " " << to_string(d.point);
    }
  }
}

/// How far the lips part in the middle, MNS units: positive opens.
float opening(const DisplacementSet& set) { return moved(set, "2.2").y - moved(set, "2.3").y; }

TEST(Expressions_Visemes, DoWithTheLipsWhatTheirSoundsNeed) {
  EXPECT_LE(opening(viseme("p_b_m")), 0.0F);          // shut
  EXPECT_LT(moved(viseme("f_v"), "2.3").z, -100.0F);  // lower lip in, under the teeth
  EXPECT_GT(moved(viseme("th"), "6.1").z, 100.0F);    // tongue out
  EXPECT_LT(moved(viseme("u"), "2.4").x, -100.0F);    // round: corners in
  EXPECT_LT(moved(viseme("o"), "2.4").x, -80.0F);
  EXPECT_GT(moved(viseme("u"), "2.2").z, 100.0F);  // and forward
  EXPECT_GT(moved(viseme("i"), "2.4").x, 60.0F);   // spread
  EXPECT_GT(moved(viseme("s_z"), "2.4").x, 40.0F);
  // Vowels open in the order of their height: i < e < a.
  EXPECT_LT(opening(viseme("i")), opening(viseme("e")));
  EXPECT_LT(opening(viseme("e")), opening(viseme("a")));
  EXPECT_LT(opening(viseme("u")), opening(viseme("o")));
}

TEST(Expressions_AllSets, MoveChinAndLowerLipTogether_WhenTheJawOpens) {
  for (const auto sets : {viseme_library(), expression_library()}) {
    for (const DisplacementSet& set : sets) {
      const float jaw = moved(set, "2.1").y;
      if (jaw > -150.0F) continue;  // a smile lifts the lip by more than that
      EXPECT_LT(moved(set, "2.10").y, 0.7F * jaw) << set.name;
      EXPECT_LT(moved(set, "8.2").y, 0.7F * jaw) << set.name;
      EXPECT_LT(moved(set, "2.3").y, 0.7F * jaw) << set.name;  // down: both are negative
      EXPECT_GT(opening(set), 0.0F) << set.name;
    }
  }
}

TEST(Expressions_Six, DoWhatTheStandardSays) {
  const auto& joy = expression("joy");
  EXPECT_TRUE(moved(joy, "2.4").y > 150 && moved(joy, "2.4").x > 50 && opening(joy) > 0);
  const auto& sadness = expression("sadness");
  EXPECT_TRUE(moved(sadness, "4.1").y > moved(sadness, "4.5").y + 100 && moved(sadness, "2.4").y < -100);
  EXPECT_LT(moved(sadness, "3.1").y, -100);
  const auto& anger = expression("anger");
  EXPECT_TRUE(moved(anger, "4.1").y < -100 && moved(anger, "4.1").x < -30 && opening(anger) <= 0);
  const auto& fear = expression("fear");
  EXPECT_TRUE(moved(fear, "4.1").y > 100 && moved(fear, "4.1").x < -20 && moved(fear, "3.1").y > 100);
  const auto& disgust = expression("disgust");
  EXPECT_TRUE(moved(disgust, "8.1").y > 100 && moved(disgust, "9.1").y > 50);
  const auto& surprise = expression("surprise");
  EXPECT_TRUE(moved(surprise, "4.3").y > 100 && moved(surprise, "2.1").y < -300 && moved(surprise, "3.1").y > 100);
}

TEST(Expressions_Six, AreFarFromEachOther) {
  Fapu head;  // about an adult's, in centimetres
  head.value = {1.0 / 1024, 6.3 / 1024, 4.6 / 1024, 2.1 / 1024, 5.0 / 1024};
  const auto on_head = [&](std::size_t i) {
    return to_dense(to_model_units(expression_library()[i], head).displacements);
  };
  for (std::size_t a = 1; a < 7; ++a) {
    for (std::size_t b = a + 1; b < 7; ++b) {
      const auto p = on_head(a);
      const auto q = on_head(b);
      double pp = 0;
      double qq = 0;
      double pq = 0;
      for (std::size_t i = 0; i < p.size(); ++i) pp += p[i] * p[i], qq += q[i] * q[i], pq += p[i] * q[i];
      EXPECT_LT(pq / std::sqrt(pp * qq), 0.7)
          << expression_library()[a].name << " and " << expression_library()[b].name;
    }
  }
}

TEST(Expressions_KernelRig, HoldsTheLibraryInModelUnits) {
  Rig rig;
  rig.fapu.value = {2.0, 3.0, 5.0, 7.0, std::nullopt};
  rig.left_eye_pivot = {1.0F, 2.0F, 3.0F};
  rig.head_pivot = {4.0F, 5.0F, 6.0F};
  const KernelRig kernel = make_kernel_rig(rig);
  const semblante_rig view = kernel.view();
  ASSERT_EQ(kernel.visemes.size(), 15U * 84 * 3);
  ASSERT_EQ(kernel.expressions.size(), 7U * 84 * 3);
  EXPECT_EQ(view.fapu[3], 7.0F);
  EXPECT_EQ(view.fapu[4], 0.0F);  // unknown
  EXPECT_EQ(view.eye_pivot[0][2], 3.0F);
  EXPECT_EQ(view.head_pivot[0], 4.0F);
  EXPECT_EQ(view.viseme_share, 0.85F);
  // surprise (6), 2.1 (index 0), y: MNS is 7.
  EXPECT_FLOAT_EQ(view.expression[6 * 84 * 3 + 1], moved(expression("surprise"), "2.1").y * 7.0F);
}

// Half way to the corner the line of a smiling lip has risen by a third (0.26 to 0.34 in a measured smile);
// with half and more both lips would be a V.
TEST(Expressions_Joy, CurvesEachLineOfTheLipsInAnArc) {
  const DisplacementSet& joy = expression("joy");
  struct Line {
    const char *middle, *side, *corner;
  };
  for (const Line& line :
       {Line{"2.2", "2.6", "2.4"}, Line{"2.3", "2.8", "2.4"}, Line{"8.1", "8.5", "8.3"}, Line{"8.2", "8.7", "8.3"}}) {
    const float middle = moved(joy, line.middle).y;
    const float risen = (moved(joy, line.side).y - middle) / (moved(joy, line.corner).y - middle);
    EXPECT_GT(risen, 0.25F) << line.side;
    EXPECT_LT(risen, 0.42F) << line.side;
  }
}

}  // namespace
}  // namespace semblante
