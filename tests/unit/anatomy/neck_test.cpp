#include "core/anatomy/neck.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/anatomy/neck_folds.h"
#include "core/anatomy/part_roles.h"
#include "core/anatomy/plausible_joints.h"
#include "tests/support/meshes.h"

namespace semblante {
namespace {

constexpr std::uint32_t slices = 24;

/// A surface of revolution about y from `top` down to `bottom` in rings 0.1 apart. Vertex (ring, slice) is ring *
/// slices + slice; slice 0 is in front, at +z.
Model revolution(double top, double bottom, const std::function<double(double)>& radius) {
  const auto rings = static_cast<std::uint32_t>(std::lround((top - bottom) / 0.1)) + 1;
  std::vector<glm::vec3> positions;
  std::vector<Triangle> triangles;
  for (std::uint32_t r = 0; r < rings; ++r) {
    const double y = top - 0.1 * r;
    for (std::uint32_t s = 0; s < slices; ++s) {
      const double angle = 2.0 * std::numbers::pi * s / slices;
      positions.emplace_back(radius(y) * std::sin(angle), y, radius(y) * std::cos(angle));
    }
  }
  for (std::uint32_t r = 0; r + 1 < rings; ++r) {
    for (std::uint32_t s = 0; s < slices; ++s) {
      const std::uint32_t a = r * slices + s;
      const std::uint32_t b = r * slices + (s + 1) % slices;
      triangles.push_back({a, a + slices, b});
      triangles.push_back({b, a + slices, b + slices});
    }
  }
  return testing::make_model(positions, triangles, "head");
}

/// A head of radius 1 about y = 1, a neck of radius 0.5 below y = 0.1, shoulders of radius 2 from y = -0.9 down.
double figure(double y) {
  if (y > 0.1) return std::max(0.45, std::sqrt(std::max(0.0, 1.0 - (y - 1.0) * (y - 1.0))));
  if (y > -0.9) return 0.5;
  return std::min(2.0, 0.5 + 3.0 * (-0.9 - y));
}

struct Figure {
  Model model;
  Surface surface;
  FeaturePointSet points;
  std::vector<Part> parts;
  std::vector<std::uint8_t> turn;

  NeckJoints joints;

  explicit Figure(double bottom, const std::function<double(double)>& radius = figure)
      : model(revolution(1.9, bottom, radius)) {}

  void find() {
    surface = build_surface(model);
    points = testing::points_at(model, {{"2.1", 18 * slices}, {"9.3", 9 * slices}});
    for (const auto& [id, x] : {std::pair("3.5", 0.3F), std::pair("3.6", -0.3F)}) {
      points.push_back({testing::fp(id), std::nullopt, glm::vec3(x, 1.1F, 0.9F)});
    }
    std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
    parts = describe_parts(model, surface, points);
    turn =
        turn_with_head(surface, parts, points, glm::vec3(0.0F, 0.6F, -0.2F), plausible_joints(joints, parts, points));
  }
  [[nodiscard]] int at(std::uint32_t ring, std::uint32_t slice = 0) const {
    return turn[surface.surface_of[ring * slices + slice].value()];
  }
};

TEST(TurnWithHead, FallsOffAlongTheNeck_AndIsNothingBelow) {
  Figure figure(-4.0);
  figure.find();
  ASSERT_FALSE(figure.turn.empty());
  for (std::uint32_t slice = 0; slice < slices; ++slice) {
    for (std::uint32_t ring = 0; ring < 12; ++ring) EXPECT_EQ(figure.at(ring, slice), 255) << ring;
    for (std::uint32_t ring = 31; ring < 60; ++ring) EXPECT_EQ(figure.at(ring, slice), 0) << ring;
    int between = 0;
    for (std::uint32_t ring = 12; ring < 31; ++ring) {
      EXPECT_LE(figure.at(ring, slice), figure.at(ring - 1, slice));
      between += figure.at(ring, slice) > 0 && figure.at(ring, slice) < 255 ? 1 : 0;
    }
    EXPECT_GT(between, 4);
  }
}

TEST(TurnWithHead, EndsAtTheBorderOfACutNeck) {
  Figure figure(-0.7);
  figure.find();
  ASSERT_FALSE(figure.turn.empty());
  EXPECT_EQ(figure.at(0), 255);
  EXPECT_EQ(figure.at(26), 0);
  EXPECT_GT(figure.at(22), 60);
}

TEST(TurnWithHead, EndsAtTheBorder_OfANeckCutAskew) {
  Figure figure(-0.9);
  // In front the neck ends at ring 28, at the back at ring 24.
  const auto last_ring = [](std::uint32_t slice) {
    return 26.0 + 2.0 * std::cos(2.0 * std::numbers::pi * slice / slices);
  };
  std::erase_if(figure.model.triangles, [&](const Triangle& t) {
    return std::any_of(t.begin(), t.end(), [&](std::uint32_t v) { return v / slices > last_ring(v % slices); });
  });
  figure.model.primitives[0].triangle_count = static_cast<std::uint32_t>(figure.model.triangles.size());
  figure.find();
  ASSERT_FALSE(figure.turn.empty());
  for (std::uint32_t slice = 0; slice < slices; ++slice) {
    const auto last = static_cast<std::uint32_t>(last_ring(slice));
    EXPECT_EQ(figure.at(last, slice), 0) << slice;
    EXPECT_GT(figure.at(last - 4, slice), 0) << slice;
    EXPECT_EQ(figure.at(10, slice), 255) << slice;
  }
}

TEST(TurnWithHead, HasMostOfTheTurnLow_InFrontOnly) {
  Figure figure(-4.0);
  figure.find();
  ASSERT_FALSE(figure.turn.empty());
  const std::uint32_t middle = 22;  // of the rings of the neck
  EXPECT_GT(figure.at(middle, 0), figure.at(middle, slices / 4));
  EXPECT_GT(figure.at(middle, slices / 4), figure.at(middle, slices / 2));
}

/// The same without shoulders: a body as narrow as its neck.
double narrow_figure(double y) { return y > -0.9 ? figure(y) : 0.55; }

TEST(TurnWithHead, EndsAtTheJointOfTheNeck_WhereNoShouldersAreFound) {
  Figure without(-8.0, narrow_figure);
  without.find();
  ASSERT_FALSE(without.turn.empty());
  EXPECT_GT(without.at(60), 10) << "without a joint the whole body takes part";

  Figure with(-8.0, narrow_figure);
  with.joints.neck = SkinJoint{"Neck", {0.0F, -0.9F, -0.1F}};
  with.joints.head = SkinJoint{"Head", {0.0F, 0.2F, 0.0F}};
  with.find();
  ASSERT_FALSE(with.turn.empty());
  for (std::uint32_t slice = 0; slice < slices; ++slice) {
    for (std::uint32_t ring = 0; ring < 12; ++ring) EXPECT_EQ(with.at(ring, slice), 255) << ring;
    for (std::uint32_t ring = 28; ring < 99; ++ring) EXPECT_EQ(with.at(ring, slice), 0) << ring;
    for (std::uint32_t ring = 12; ring < 28; ++ring) EXPECT_LE(with.at(ring, slice), with.at(ring - 1, slice));
  }
}

TEST(TurnWithHead, KeepsMeasuredShoulders_NearTheJoint) {
  Figure measured(-4.0);
  measured.find();
  for (const float y : {-0.6F, -1.3F}) {
    Figure hinted(-4.0);
    hinted.joints.neck = SkinJoint{"Neck", {0.0F, y, -0.1F}};
    hinted.find();
    EXPECT_EQ(hinted.turn, measured.turn) << y;
  }
}

/// Triangles of the figure that face away when its head nods by 0.6 rad, each vertex by its share of the angle.
int turned_over_by_nodding(const Figure& figure, const glm::vec3& pivot) {
  const auto nod = [&](std::uint32_t v) {
    const float angle = 0.6F * static_cast<float>(figure.turn[figure.surface.surface_of[v].value()]) / 255.0F;
    const glm::vec3 d = figure.model.positions[v] - pivot;
    return pivot +
           glm::vec3(d.x, std::cos(angle) * d.y - std::sin(angle) * d.z, std::sin(angle) * d.y + std::cos(angle) * d.z);
  };
  int count = 0;
  for (const Triangle& t : figure.model.triangles) {
    const auto& p = figure.model.positions;
    const glm::vec3 before = glm::cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
    const glm::vec3 after = glm::cross(nod(t[1]) - nod(t[0]), nod(t[2]) - nod(t[0]));
    count += glm::dot(before, after) < 0.0F ? 1 : 0;
  }
  return count;
}

/// The same with shoulders close below the chin.
double stocky_figure(double y) {
  if (y > 0.1) return figure(y);
  if (y > -0.3) return 0.5;
  return std::min(2.0, 0.5 + 3.0 * (-0.3 - y));
}

TEST(UnfoldNeck, SpreadsTheTurn_WhereAShortNeckWouldTurnOver) {
  Figure figure(-2.0, stocky_figure);
  figure.find();
  const glm::vec3 pivot(0.0F, 0.6F, -0.8F);  // so far behind that the chin comes down by more than the neck's length
  ASSERT_FALSE(figure.turn.empty());
  const std::vector<std::uint8_t> before = figure.turn;
  const int folded = turned_over_by_nodding(figure, pivot);
  ASSERT_GT(folded, 0);
  unfold_neck(figure.surface, figure.model.triangles, pivot, figure.turn);
  EXPECT_LT(turned_over_by_nodding(figure, pivot), folded);
  for (std::size_t s = 0; s < before.size(); ++s) {
    EXPECT_EQ(figure.turn[s] == 0, before[s] == 0);
    EXPECT_EQ(figure.turn[s] == 255, before[s] == 255);
  }
}

TEST(UnfoldNeck, LeavesANeckThatDoesNotTurnOver) {
  Figure figure(-4.0);
  figure.find();
  const glm::vec3 pivot(0.0F, 0.6F, -0.2F);
  const std::vector<std::uint8_t> before = figure.turn;
  ASSERT_EQ(turned_over_by_nodding(figure, pivot), 0);
  unfold_neck(figure.surface, figure.model.triangles, pivot, figure.turn);
  EXPECT_EQ(figure.turn, before);
}

TEST(PlausibleJoints, AreBehindTheChin_AndTheNeckBelowIt) {
  Figure figure(-4.0);
  figure.find();
  const auto kept = [&](glm::vec3 neck, glm::vec3 head) {
    return plausible_joints({SkinJoint{"n", neck}, SkinJoint{"h", head}}, figure.parts, figure.points);
  };
  // The chin is at y = 0.1, the eyes 1 above it.
  const NeckJoints both = kept({0, -0.8F, -0.1F}, {0, 0.3F, -0.1F});
  EXPECT_TRUE(both.neck && both.head);
  EXPECT_FALSE(kept({0, 0.2F, -0.1F}, {0, 0.3F, -0.1F}).neck) << "above the chin";
  EXPECT_FALSE(kept({0, -0.3F, -0.1F}, {0, -0.35F, -0.1F}).neck) << "above the head's joint";
  EXPECT_FALSE(kept({0, -3.5F, -0.1F}, {0, 0.3F, -0.1F}).neck) << "at the hips";
  EXPECT_FALSE(kept({1.5F, -0.8F, -0.1F}, {0, 0.3F, -0.1F}).neck) << "of another figure beside it";
  EXPECT_FALSE(kept({0, -0.8F, 0.6F}, {0, 0.3F, 0.6F}).head) << "before the chin";
  EXPECT_FALSE(kept({0, -0.8F, -0.1F}, {0, 1.3F, -0.1F}).head) << "above the eyes";
  EXPECT_FALSE(kept({0, -0.8F, -4.0F}, {0, 0.3F, -4.0F}).head) << "far behind";
  const auto without_points = plausible_joints({SkinJoint{"n", {0, -0.8F, -0.1F}}, {}}, figure.parts, {});
  EXPECT_FALSE(without_points.neck);
}

TEST(TurnWithHead, IsTheWholeModel_WithoutANeck) {
  Figure figure(0.0);
  figure.find();
  EXPECT_TRUE(figure.turn.empty());
}

TEST(TurnWithHead, TakesHairAlong_AndLeavesTheCollar) {
  Figure figure(-4.0);
  const auto ring_of = [](double top, double bottom, double radius) {
    return revolution(top, bottom, [radius](double) { return radius; });
  };
  const std::uint32_t collar = testing::append(figure.model, ring_of(-0.5, -0.9, 0.7), "collar");
  // Longer than the neck, but most of it is on the head.
  const std::uint32_t hair = testing::append(figure.model, ring_of(1.8, -0.8, 1.1), "hair");
  figure.find();
  const PartId collar_part = figure.surface.part_of[figure.surface.surface_of[collar].value()];
  const PartId hair_part = figure.surface.part_of[figure.surface.surface_of[hair].value()];
  EXPECT_EQ(figure.parts[collar_part.value()].role, PartRole::body);
  EXPECT_NE(figure.parts[hair_part.value()].role, PartRole::body);
  for (const SurfaceVertexId v : figure.surface.members_of(collar_part)) EXPECT_EQ(figure.turn[v.value()], 0);
  for (const SurfaceVertexId v : figure.surface.members_of(hair_part)) EXPECT_EQ(figure.turn[v.value()], 255);
}

TEST(TurnWithHead, LetsLongHairLieStillOnTheShoulders) {
  Figure figure(-4.0);
  const auto ring_of = [](double top, double bottom, double radius) {
    return revolution(top, bottom, [radius](double) { return radius; });
  };
  // Most of it is below the chin, and one strand is all there.
  const std::uint32_t hair = testing::append(figure.model, ring_of(1.8, -3.5, 1.2), "hairdo");
  const std::uint32_t strand = testing::append(figure.model, ring_of(-0.4, -3.4, 1.3), "hairdo");
  const std::uint32_t shirt = testing::append(figure.model, ring_of(-0.4, -3.6, 2.2), "shirt");
  figure.find();
  const auto part_of = [&](std::uint32_t vertex) {
    return figure.surface.part_of[figure.surface.surface_of[vertex].value()];
  };
  EXPECT_NE(figure.parts[part_of(hair).value()].role, PartRole::body);
  EXPECT_NE(figure.parts[part_of(strand).value()].role, PartRole::body);
  EXPECT_EQ(figure.parts[part_of(shirt).value()].role, PartRole::body);
  const auto turn_at = [&](std::uint32_t first, std::uint32_t ring, std::uint32_t slice) {
    return static_cast<int>(figure.turn[figure.surface.surface_of[first + ring * slices + slice].value()]);
  };
  for (const std::uint32_t slice : {0U, slices / 4, slices / 2}) {
    int before = 255;
    for (std::uint32_t ring = 0; ring <= 53; ++ring) {
      const int turn = turn_at(hair, ring, slice);
      EXPECT_LE(turn, before) << ring;
      if (ring <= 10) {  // down to y = 0.8, above the jaw
        EXPECT_EQ(turn, 255) << ring;
      }
      if (ring >= 32) {  // from y = -1.4 on, below the shoulders
        EXPECT_EQ(turn, 0) << ring;
      }
      before = turn;
    }
    EXPECT_EQ(turn_at(strand, 12, slice), turn_at(hair, 34, slice));
  }
}

TEST(TurnWithHead, KeepsTheRoleThatTheUserSet) {
  Figure figure(-4.0);
  const std::uint32_t collar =
      testing::append(figure.model, revolution(-0.5, -0.9, [](double) { return 0.7; }), "collar");
  figure.find();
  const PartId part = figure.surface.part_of[figure.surface.surface_of[collar].value()];
  std::vector<std::optional<PartRole>> by_user(figure.parts.size());
  by_user[part.value()] = PartRole::rest;
  std::vector<Part> parts = describe_parts(figure.model, figure.surface, figure.points, by_user);
  const auto turn = turn_with_head(figure.surface, parts, figure.points, glm::vec3(0.0F, 0.6F, -0.2F));
  EXPECT_EQ(parts[part.value()].role, PartRole::rest);
  EXPECT_EQ(turn[figure.surface.surface_of[collar].value()], 255);
}

}  // namespace
}  // namespace semblante
