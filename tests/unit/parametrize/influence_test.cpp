#include "core/parametrize/influence.h"

#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/parametrize/surface_weights.h"
#include "tests/support/meshes.h"

namespace semblante {
namespace {

using ::testing::ElementsAre;
using ::testing::FloatEq;
using ::testing::IsEmpty;
using ::testing::Pair;

/// A strip of skin with 2.1 and 2.2 at its ends and one further part of a given role.
class InfluenceOfRoles : public ::testing::Test {
 protected:
  using Row = std::map<std::string, float>;

  std::vector<Row> rows_with(const Model& more, PartRole role,
                             std::initializer_list<std::pair<std::string_view, std::uint32_t>> marks) {
    Model model = testing::make_strip(4);
    first_ = testing::append(model, more, "");
    const Surface surface = build_surface(model);
    const auto points = surface_points(surface, testing::points_at(model, marks));
    const auto weights = surface_weights(surface, points);
    std::vector<Part> parts(surface.part_count());
    parts[1].role = role;
    const auto table =
        influence_with_roles(surface, parts, points, share_of_jaw(surface, parts, points), weights->rows);
    std::vector<Row> rows(table.row_count());
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const auto ids = table.points_of(r);
      EXPECT_TRUE(std::is_sorted(ids.begin(), ids.end()));
      for (std::size_t k = 0; k < ids.size(); ++k) rows[r][to_string(ids[k])] = table.weights_of(r)[k];
    }
    return rows;
  }

  const Model further_strip = testing::shifted(testing::make_strip(4), {0, 0, -50});
  std::uint32_t first_ = 0;
};

TEST_F(InfluenceOfRoles, Skin_IsTheQuotientOfEq7) {
  const auto rows = rows_with(testing::make_box({0, 0, 5}, {1, 1, 6}), PartRole::rest, {{"2.1", 0}, {"2.2", 4}});
  EXPECT_THAT(rows[0], ElementsAre(Pair("2.1", 1.0F)));
  // b1: one neighbour on either side, d = 4 for both. W = sin(3/4 90 deg) and sin(1/4 90 deg), their quotients
  // 0.923880 / (0.923880 + 0.382683) = 0.707107 and 0.292893.
  EXPECT_THAT(rows[1], ElementsAre(Pair("2.1", FloatEq(0.70710678F)), Pair("2.2", FloatEq(0.29289322F))));
}

TEST_F(InfluenceOfRoles, PartsThatMoveRigidly_HaveNoRows) {
  for (const PartRole role : {PartRole::rest, PartRole::left_eye, PartRole::right_eye, PartRole::upper_teeth}) {
    // Even with points on them.
    const auto rows = rows_with(further_strip, role, {{"2.1", 0}, {"3.5", 10}, {"9.8", 14}});
    for (std::size_t v = first_; v < rows.size(); ++v) EXPECT_THAT(rows[v], IsEmpty());
  }
}

TEST_F(InfluenceOfRoles, LowerTeeth_FollowTheJawAlone) {
  const auto rows = rows_with(further_strip, PartRole::lower_teeth, {{"2.1", 0}, {"9.9", 10}, {"9.11", 14}});
  for (std::size_t v = first_; v < rows.size(); ++v) EXPECT_THAT(rows[v], ElementsAre(Pair("2.1", 1.0F)));
}

TEST_F(InfluenceOfRoles, LowerTeethWithoutAJawPoint_StayWithTheHead) {
  const auto rows = rows_with(further_strip, PartRole::lower_teeth, {{"2.2", 0}});
  for (std::size_t v = first_; v < rows.size(); ++v) EXPECT_THAT(rows[v], IsEmpty());
}

TEST_F(InfluenceOfRoles, Tongue_TakesTheJawOnTopOfItsOwn) {
  const auto rows = rows_with(further_strip, PartRole::tongue, {{"2.1", 0}, {"6.1", 10}, {"6.2", 14}});
  EXPECT_THAT(rows[10], ElementsAre(Pair("2.1", 1.0F), Pair("6.1", 1.0F)));
  EXPECT_THAT(rows[11],
              ElementsAre(Pair("2.1", 1.0F), Pair("6.1", FloatEq(0.70710678F)), Pair("6.2", FloatEq(0.29289322F))));
}

TEST_F(InfluenceOfRoles, TongueWithoutPoints_TakesTheJawAlone) {
  const auto rows = rows_with(further_strip, PartRole::tongue, {{"2.1", 0}});
  for (std::size_t v = first_; v < rows.size(); ++v) EXPECT_THAT(rows[v], ElementsAre(Pair("2.1", 1.0F)));
}

TEST_F(InfluenceOfRoles, Attached_TakesTheRowOfTheNearestSkin) {
  // A strip a little in front of the skin's, so that each vertex has its own right behind it.
  Model veil = testing::make_strip(4);
  for (glm::vec3& p : veil.positions) p.z = 0.1F;
  const auto rows = rows_with(veil, PartRole::attached, {{"2.1", 0}, {"2.2", 4}});
  for (std::size_t v = 0; v < 10; ++v) EXPECT_EQ(rows[first_ + v], rows[v]);
}

TEST_F(InfluenceOfRoles, LashBentOverOtherSkin_FollowsItsRoot) {
  // It stands at b0, and its tip ends right above b3: nearer to it than its root is, but not attached there.
  const Model lash = testing::make_model({{0, 0, 0}, {0, 0.1F, 0}, {0, 0, 0.5F}, {1.5F, 0, 0.8F}, {3, 0, 0.9F}},
                                         {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}});
  const auto rows = rows_with(lash, PartRole::attached, {{"2.1", 0}, {"2.2", 4}});
  for (std::size_t v = first_; v < rows.size(); ++v) EXPECT_THAT(rows[v], ElementsAre(Pair("2.1", 1.0F)));
}

TEST(InfluenceOfGums, BothRowsOfTeethInOnePart_AreToldApart) {
  // A strip of gums and tongue, 40 squares long: upper teeth stand in its left end, lower teeth in its right end.
  Model model = testing::make_strip(4);
  const std::uint32_t gums = testing::append(model, testing::shifted(testing::make_strip(40), {0, 0, -50}), "");
  testing::append(model, testing::make_box({0, 0, -50}, {1, 1, -51}), "");
  testing::append(model, testing::make_box({39, 0, -50}, {40, 1, -51}), "");
  const Surface surface = build_surface(model);
  const auto points = surface_points(surface, testing::points_at(model, {{"2.1", 0}, {"6.1", gums + 30}}));
  const auto weights = surface_weights(surface, points);
  std::vector<Part> parts(surface.part_count());
  parts[1].role = PartRole::tongue;
  parts[2].role = PartRole::upper_teeth;
  parts[3].role = PartRole::lower_teeth;
  const auto table = influence_with_roles(surface, parts, points, share_of_jaw(surface, parts, points), weights->rows);
  const auto jaw = [&](std::uint32_t v) {
    const auto ids = table.points_of(v);
    return ids.empty() || ids[0] != testing::fp("2.1") ? 0.0F : table.weights_of(v)[0];
  };
  EXPECT_EQ(jaw(gums), 0.0F);
  EXPECT_EQ(jaw(gums + 1), 0.0F);
  EXPECT_EQ(jaw(gums + 39), 1.0F);
  EXPECT_EQ(jaw(gums + 40), 1.0F);
  EXPECT_EQ(jaw(gums + 30), 1.0F);  // the tongue's point
  for (std::uint32_t v = gums; v < gums + 40; ++v) EXPECT_LE(jaw(v), jaw(v + 1));
  // The tongue's own point moves its vertex, not the gums.
  EXPECT_EQ(table.points_of(gums + 30).back(), testing::fp("6.1"));
  EXPECT_EQ(table.points_of(gums + 40).size(), 1U);
}

}  // namespace
}  // namespace semblante
