#include "core/extract/own_sets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/bridges/arkit.h"
#include "core/extract/shape_names.h"
#include "tests/support/meshes.h"

namespace semblante {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(ShapeNames_OfAvatars, NameVisemesAndExpressions) {
  const NamedFace p{SetKind::viseme, 1};
  EXPECT_EQ(face_of_shape_name("viseme_PP"), p);
  EXPECT_EQ(face_of_shape_name("vrc.v_pp"), p);
  EXPECT_EQ(face_of_shape_name("p_b_m"), p);
  const NamedFace a{SetKind::viseme, 10};
  EXPECT_EQ(face_of_shape_name("viseme_aa"), a);
  EXPECT_EQ(face_of_shape_name("Face.M_F00_000_00_Fcl_MTH_A"), std::nullopt) << "words that say nothing of the place";
  EXPECT_EQ(face_of_shape_name("Fcl_MTH_A"), a);
  EXPECT_EQ(face_of_shape_name("A"), a);
  const NamedFace joy{SetKind::expression, 1};
  EXPECT_EQ(face_of_shape_name("Fcl_ALL_Joy"), joy);
  EXPECT_EQ(face_of_shape_name("happy"), joy);
  EXPECT_EQ(face_of_shape_name("surprised"), (NamedFace{SetKind::expression, 6}));
}

TEST(ShapeNames_OfAvatars, AreNotPartsOfAFace) {
  for (const char* const name : {"Fcl_EYE_Joy", "Fcl_BRW_Angry", "mouthSmile", "sil", "none", "", "_", "viseme_sil"}) {
    EXPECT_EQ(face_of_shape_name(name), std::nullopt) << name;
  }
}

TEST(ShapeNames_OfARKit, HaveSidesInBothSpellings) {
  EXPECT_EQ(arkit_of_shape_name("mouthSmile_L"), arkit_of_shape_name("mouthSmileLeft"));
  EXPECT_TRUE(arkit_of_shape_name("mouthSmile_L"));
  EXPECT_TRUE(arkit_of_shape_name("JawOpen"));
  EXPECT_EQ(arkit_of_shape_name("mouthSmile"), std::nullopt);
}

/// A square with the chin's and the mouth's points on it, all units known.
class OwnSets : public ::testing::Test {
 protected:
  OwnSets() : model_(testing::make_grid(10, 10)) {
    points_ = testing::points_at(model_, {{"2.1", 5}, {"2.2", 60}, {"8.3", 50}});
    for (auto& unit : fapu_.value) unit = 0.001;
  }

  void add_shape(const char* name, std::uint32_t vertex, glm::vec3 by) {
    model_.examples.push_back({name, {vertex}, {by}});
  }

  Model model_;
  FeaturePointSet points_;
  Fapu fapu_;
};

TEST_F(OwnSets, AreFoundByName) {
  add_shape("viseme_aa", 5, {0, -1, 0});
  add_shape("Fcl_ALL_Joy", 50, {0.5, 0.5, 0});
  add_shape("Fcl_EYE_Joy", 60, {0, 9, 0});

  const auto own = own_sets(model_, points_, fapu_);

  ASSERT_TRUE(own) << own.error().message;
  ASSERT_EQ(own->sets.size(), 2U);
  EXPECT_EQ(own->sets[0].name, "a");
  EXPECT_EQ(own->sets[0].kind, SetKind::viseme);
  ASSERT_EQ(own->sets[0].displacements.size(), 1U);
  EXPECT_NEAR(own->sets[0].displacements[0].value.y, -1000.0F, 0.01F);
  EXPECT_EQ(own->sets[1].name, "joy");
  EXPECT_THAT(own->words, ElementsAre(HasSubstr("a (viseme_aa), joy (Fcl_ALL_Joy)"), HasSubstr("p_b_m, f_v")));
}

TEST_F(OwnSets, AreMadeOfARKitsShapesWhereNoneIsNamed) {
  // All of ARKit's shapes move the corner, so every face has its recipe.
  for (std::size_t shape = 0; shape < arkit_count; ++shape) {
    add_shape(std::string(arkit_name(shape)).c_str(), 50, {0, 0.2, 0});
  }
  const auto own = own_sets(model_, points_, fapu_);

  ASSERT_TRUE(own) << own.error().message;
  EXPECT_GT(own->sets.size(), 12U);
  EXPECT_THAT(own->words[0], HasSubstr("ARKit shapes)"));

  // One of its two hundred parts is no face.
  std::erase_if(model_.examples, [](const Example& e) { return e.name != "cheekPuff"; });
  EXPECT_FALSE(own_sets(model_, points_, fapu_));
}

TEST_F(OwnSets, WithoutAnyTellWhy) {
  const auto none = own_sets(model_, points_, fapu_);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().where, "/expressions");
  EXPECT_THAT(none.error().message, HasSubstr("the model has none"));

  add_shape("bigger nose", 5, {0, 0, 1});
  const auto no_faces = own_sets(model_, points_, fapu_);
  ASSERT_FALSE(no_faces);
  EXPECT_THAT(no_faces.error().message, HasSubstr("none of the 1 morph targets"));
}

TEST_F(OwnSets, ThatMoveNoPointAreLeftOutWithWords) {
  add_shape("viseme_aa", 5, {0, -1, 0});
  add_shape("happy", 7, {1, 1, 1});

  const auto own = own_sets(model_, points_, fapu_);

  ASSERT_TRUE(own);
  EXPECT_EQ(own->sets.size(), 1U);
  EXPECT_THAT(own->words, ::testing::Contains(HasSubstr("its own shape for joy is left out")));
}

TEST_F(OwnSets, LeaveWhatWasChosenByHand) {
  std::vector<NamedSet> worn = {{"a", SetKind::viseme, {}}};
  wear_own(worn,
           {{"a", SetKind::viseme, {{*parse_feature_point("2.1"), {1, 1, 1}}}}, {"joy", SetKind::expression, {}}});
  ASSERT_EQ(worn.size(), 2U);
  EXPECT_TRUE(worn[0].displacements.empty());
  EXPECT_EQ(worn[1].name, "joy");
}

}  // namespace
}  // namespace semblante
