#include "core/extract/own_articulation.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/bridges/arkit.h"
#include "core/expressions/contact.h"
#include "tests/support/meshes.h"

namespace semblante {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double unit = 0.001;
constexpr std::uint32_t upper = 60, lower = 50;

const DisplacementSet& viseme(std::string_view name) {
  const auto library = viseme_library();
  return *std::find_if(library.begin(), library.end(), [&](const DisplacementSet& set) { return set.name == name; });
}

/// By how much a viseme of the library opens the mouth at an articulation; model units.
double opening(std::string_view name, double articulation) {
  double apart = 0.0;
  for (const Displacement& d : articulated(viseme(name), articulation)) {
    if (d.point == *parse_feature_point("2.2")) apart += static_cast<double>(d.value.y);
    if (d.point == *parse_feature_point("2.3")) apart -= static_cast<double>(d.value.y);
  }
  return unit * apart;
}

/// A square with the lips' points on it, all units known.
class OwnArticulation : public ::testing::Test {
 protected:
  OwnArticulation() : model_(testing::make_grid(10, 10)) {
    points_ = testing::points_at(model_, {{"2.2", upper}, {"2.3", lower}});
    for (auto& value : fapu_.value) value = unit;
    set(FapuUnit::mw, 2.0 * unit);
  }
  void set(FapuUnit name, double value) { fapu_.value[static_cast<std::size_t>(name)] = value; }
  /// A shape that opens the mouth, a quarter of it upwards.
  void add_shape(std::string name, double opens) {
    const auto up = static_cast<float>(0.25 * opens);
    const auto down = static_cast<float>(-0.75 * opens);
    model_.examples.push_back({std::move(name), {lower, upper}, {{0, down, 0}, {0, up, 0}}});
  }
  [[nodiscard]] std::optional<Articulation> measured() const { return own_articulation(model_, points_, fapu_); }

  Model model_;
  FeaturePointSet points_;
  Fapu fapu_;
};

TEST_F(OwnArticulation, IsThatAtWhichTheLibraryOpensAsFar) {
  for (const double articulation : {0.5, 1.0, 2.25, 3.5}) {
    model_.examples.clear();
    for (const auto& [shape, name] : {std::pair("viseme_aa", "a"), {"viseme_E", "e"}, {"viseme_O", "o"}})
      add_shape(shape, opening(name, articulation));
    const auto own = measured();
    ASSERT_TRUE(own);
    EXPECT_NEAR(own->value, articulation, 1e-4);
    EXPECT_THAT(own->reason, HasSubstr("a (viseme_aa), e (viseme_E), o (viseme_O) the mouth opens"));
    EXPECT_THAT(own->reason, Not(HasSubstr("limit")));
  }
}

/// The articulation multiplies the library in units_of_library, which may differ from the units of the face.
TEST_F(OwnArticulation, IsThatOfTheUnitsInWhichTheFaceWearsTheLibrary) {
  set(FapuUnit::mns, 0.1 * unit);
  ASSERT_NE(units_of_library(fapu_)[FapuUnit::mns], fapu_[FapuUnit::mns]);
  add_shape("viseme_aa", opening("a", 1.5) * *units_of_library(fapu_)[FapuUnit::mns] / unit);
  ASSERT_TRUE(measured());
  EXPECT_NEAR(measured()->value, 1.5, 1e-4);
}

TEST_F(OwnArticulation, OfSeveralVowels_LiesBetweenTheirs) {
  add_shape("Fcl_MTH_A", opening("a", 3.0));
  add_shape("Fcl_MTH_O", opening("o", 1.5));
  const double value = measured()->value;
  EXPECT_GT(value, 2.25) << "the wider vowel tells more";
  EXPECT_LT(value, 3.0);
}

TEST_F(OwnArticulation, StaysWithinItsLimits_AndSaysSo) {
  add_shape("viseme_aa", opening("a", 7.0));
  EXPECT_EQ(measured()->value, most_articulation);
  EXPECT_THAT(measured()->reason, HasSubstr("an articulation of 7.00, and 4.00 is the limit"));
}

TEST_F(OwnArticulation, ReadsArkitsShapes) {
  // All of ARKit's shapes, so that each viseme has its sum; the jaw alone opens the mouth.
  for (std::size_t shape = 0; shape < arkit_count; ++shape)
    add_shape(std::string(arkit_name(shape)), arkit_name(shape) == "jawOpen" ? 2.0 * opening("a", 1.0) : 0.0);
  const auto own = measured();
  ASSERT_TRUE(own);
  EXPECT_THAT(own->reason, HasSubstr("ARKit shapes)"));
  const double before = own->value;
  for (Example& example : model_.examples)
    for (glm::vec3& d : example.displacements) d *= 1.2F;
  EXPECT_GT(measured()->value, before + 0.1);
}

TEST_F(OwnArticulation, IsUnknownWithoutOpenVowels) {
  EXPECT_FALSE(measured()) << "no shapes";
  add_shape("viseme_PP", 0.5);
  add_shape("happy", 0.5);
  EXPECT_FALSE(measured()) << "closed lips and an expression";
  add_shape("A", 0.1 * opening("a", 1.0));
  EXPECT_FALSE(measured()) << "a shape of that name which does not open the mouth";
  model_.examples.back().displacements[0].y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(measured());
}

TEST_F(OwnArticulation, IsUnknownWithoutTheUnitOrALip) {
  add_shape("viseme_aa", opening("a", 2.0));
  ASSERT_TRUE(measured());
  const auto on_vertices = points_;
  points_[0].vertex.reset();
  EXPECT_FALSE(measured()) << "a bare position";
  points_ = on_vertices;
  points_.pop_back();
  EXPECT_FALSE(measured()) << "not marked";
  points_ = on_vertices;
  fapu_.value[static_cast<std::size_t>(FapuUnit::mns)].reset();
  EXPECT_FALSE(measured());
}

}  // namespace
}  // namespace semblante
