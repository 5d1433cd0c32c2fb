#include "core/lod/decimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/lod/level_error.h"
#include "core/lod/lod_poses.h"
#include "core/parametrize/parametrize.h"
#include "tests/support/meshes.h"

namespace semblante {
namespace {

using testing::make_ball;
using testing::make_grid;
using testing::points_at;

/// A rig as decimate() reads it: parts, and rows that move nothing.
Rig plain_rig(const Model& model, const Surface& surface, FeaturePointSet points = {}) {
  Rig rig;
  rig.points = std::move(points);
  rig.parts.resize(surface.part_count());
  for (const SurfaceVertexId v : surface.surface_of) rig.part_of_vertex.push_back(surface.part_of[v.value()]);
  for (std::size_t v = 0; v < model.positions.size(); ++v) rig.influence.end_row();
  return rig;
}

std::vector<LevelOfDetail> decimate_to(const Model& model, std::vector<std::uint32_t> budgets,
                                       FeaturePointSet points = {}) {
  const Surface surface = build_surface(model);
  LodOptions options;
  options.budgets = std::move(budgets);
  return *decimate(model, surface, plain_rig(model, surface, std::move(points)), options);
}

/// A bent sheet, so that no two collapses cost the same.
Model make_sheet(std::uint32_t side) {
  Model model = make_grid(side, side);
  for (glm::vec3& p : model.positions) p.z = 1.5F * std::sin(0.31F * p.x) * std::cos(0.23F * p.y);
  return model;
}

void add_uvs(Model& model) {
  for (const glm::vec3& p : model.positions) model.uvs.emplace_back(p.x * 0.01F, p.y * 0.01F);
  model.uv_triangles = model.triangles;
}

std::set<std::uint32_t> used_vertices(const std::vector<Triangle>& triangles) {
  std::set<std::uint32_t> used;
  for (const Triangle& t : triangles) used.insert(t.begin(), t.end());
  return used;
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;
std::map<Edge, int> edges_of(const std::vector<Triangle>& triangles) {
  std::map<Edge, int> edges;
  for (const Triangle& t : triangles) {
    for (std::size_t c = 0; c < 3; ++c) ++edges[std::minmax(t[c], t[(c + 1) % 3])];
  }
  return edges;
}

std::set<std::uint32_t> border_of(const std::vector<Triangle>& triangles) {
  std::set<std::uint32_t> border;
  for (const auto& [edge, count] : edges_of(triangles)) {
    if (count == 1) border.insert({edge.first, edge.second});
  }
  return border;
}

double area_of(const Model& model, const std::vector<Triangle>& triangles) {
  double area = 0.0;
  for (const Triangle& t : triangles) {
    area += 0.5 * glm::length(glm::cross(model.positions[t[1]] - model.positions[t[0]],
                                         model.positions[t[2]] - model.positions[t[0]]));
  }
  return area;
}

TEST(Decimate, EveryLevelIsWithinItsBudgetAndPartOfTheOneBefore) {
  const Model model = make_sheet(40);
  const auto levels = decimate_to(model, {800, 400, 200});
  ASSERT_EQ(levels.size(), 3U);
  std::set<std::uint32_t> before = used_vertices(model.triangles);
  for (const LevelOfDetail& level : levels) {
    const auto used = used_vertices(level.triangles);
    EXPECT_EQ(used.size(), level.vertex_count);
    EXPECT_LE(level.vertex_count, level.budget);
    EXPECT_GE(level.vertex_count, level.budget * 9 / 10);
    EXPECT_TRUE(std::includes(before.begin(), before.end(), used.begin(), used.end()));
    EXPECT_TRUE(std::is_sorted(level.source_triangles.begin(), level.source_triangles.end()));
    before = used;
  }
}

TEST(Decimate, TheSameInputGivesTheSameLevels) {
  const Model model = make_sheet(25);
  const auto once = decimate_to(model, {300, 100});
  const auto twice = decimate_to(model, {300, 100});
  ASSERT_EQ(once.size(), twice.size());
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_EQ(once[i].triangles, twice[i].triangles);
}

TEST(Decimate, FeaturePointsStay) {
  const Model model = make_sheet(20);
  const FeaturePointSet points = points_at(model, {{"4.1", 100}, {"4.2", 222}, {"9.3", 317}});
  const auto levels = decimate_to(model, {60}, points);
  ASSERT_EQ(levels.size(), 1U);
  const auto used = used_vertices(levels[0].triangles);
  for (const FeaturePoint& point : points) EXPECT_TRUE(used.contains(point.vertex->value())) << to_string(point.id);
}

TEST(Decimate, TheWayBetweenLipPointsStays) {
  const Model model = make_grid(20, 20);  // flat: all else may go
  const FeaturePointSet points = points_at(model, {{"2.2", 10 * 21 + 10}, {"2.4", 10 * 21 + 15}, {"2.5", 10 * 21 + 5}});
  const auto levels = decimate_to(model, {40}, points);
  ASSERT_EQ(levels.size(), 1U);
  const auto used = used_vertices(levels[0].triangles);
  for (std::uint32_t x = 5; x <= 15; ++x) EXPECT_TRUE(used.contains(10 * 21 + x)) << x;
}

TEST(Decimate, WhereUpperLipMeetsLowerLipBothStay) {
  const Model model = make_grid(10, 10);
  const Surface surface = build_surface(model);
  Rig rig = plain_rig(model, surface);
  rig.influence = {};
  for (std::uint32_t v = 0; v < model.positions.size(); ++v) {
    rig.influence.push(*parse_feature_point(model.positions[v].y >= 5.0F ? "2.2" : "2.3"), 1.0F);
    rig.influence.end_row();
  }
  LodOptions options;
  options.budgets = {30};
  const auto levels = decimate(model, surface, rig, options);
  ASSERT_EQ(levels->size(), 1U);
  const auto used = used_vertices(levels->front().triangles);
  for (std::uint32_t x = 0; x <= 10; ++x) {
    EXPECT_TRUE(used.contains(5 * 11 + x)) << x;
    EXPECT_TRUE(used.contains(4 * 11 + x)) << x;
  }
}

TEST(Decimate, AnOpeningWithAnEyelidPointOnItKeepsItsRim) {
  Model model = make_grid(12, 12);
  // A hole of 4 by 4 squares; its rim are the vertices (4..8, 4..8) on the outside of it.
  std::erase_if(model.triangles, [&](const Triangle& t) {
    return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) {
      const glm::vec3& p = model.positions[v];
      return p.x >= 4.0F && p.x <= 8.0F && p.y >= 4.0F && p.y <= 8.0F;
    });
  });
  model.primitives[0].triangle_count = static_cast<std::uint32_t>(model.triangles.size());
  const auto levels = decimate_to(model, {40}, points_at(model, {{"3.1", 8 * 13 + 6}}));
  ASSERT_EQ(levels.size(), 1U);
  const auto used = used_vertices(levels[0].triangles);
  for (std::uint32_t i = 4; i <= 8; ++i) {
    EXPECT_TRUE(used.contains(4 * 13 + i) && used.contains(8 * 13 + i) && used.contains(i * 13 + 4) &&
                used.contains(i * 13 + 8))
        << i;
  }
}

TEST(Decimate, BordersStayWhereTheyAre) {
  const Model model = make_grid(16, 16);
  const auto levels = decimate_to(model, {30});
  ASSERT_EQ(levels.size(), 1U);
  const auto border = border_of(model.triangles);
  for (const std::uint32_t v : border_of(levels[0].triangles)) EXPECT_TRUE(border.contains(v));
  EXPECT_NEAR(area_of(model, levels[0].triangles), 256.0, 1e-3);  // no corner was cut off
}

TEST(Decimate, SeamsOfTheTextureStayOneLineOnBothSides) {
  // Two halves with textures of their own, meeting at x = 8; vertices are shared, UVs are not.
  Model model = make_grid(16, 16);
  for (const glm::vec3& p : model.positions) model.uvs.emplace_back(p.x, p.y);
  for (const glm::vec3& p : model.positions) model.uvs.emplace_back(p.x + 100.0F, p.y);
  const auto count = static_cast<std::uint32_t>(model.positions.size());
  for (const Triangle& t : model.triangles) {
    const bool right = model.positions[t[0]].x + model.positions[t[1]].x + model.positions[t[2]].x > 24.0F;
    Triangle uv = t;
    for (std::uint32_t& corner : uv) corner += right ? count : 0;
    model.uv_triangles.push_back(uv);
  }
  const auto levels = decimate_to(model, {60});
  ASSERT_EQ(levels.size(), 1U);
  for (std::size_t t = 0; t < levels[0].triangles.size(); ++t) {
    const bool right = levels[0].uv_triangles[t][0] >= count;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t v = levels[0].triangles[t][c];
      EXPECT_EQ(levels[0].uv_triangles[t][c], v + (right ? count : 0));  // each vertex keeps the UV of its side
      EXPECT_TRUE(right ? model.positions[v].x >= 8.0F : model.positions[v].x <= 8.0F);
    }
  }
  EXPECT_LE(levels[0].vertex_count, 60U);
}

TEST(Decimate, MaterialsKeepTheirBorders) {
  Model model = make_grid(16, 16);
  std::vector<std::uint8_t> labels;
  for (const Triangle& t : model.triangles) {
    labels.push_back(model.positions[t[0]].y + model.positions[t[1]].y + model.positions[t[2]].y > 24.0F ? 1 : 0);
  }
  const Surface surface = build_surface(model);
  LodOptions options;
  options.budgets = {50};
  options.labels = labels;
  const auto levels = decimate(model, surface, plain_rig(model, surface), options);
  ASSERT_EQ(levels->size(), 1U);
  double upper = 0.0;
  const LevelOfDetail& level = levels->front();
  for (std::size_t t = 0; t < level.triangles.size(); ++t) {
    if (labels[level.source_triangles[t]] == 1) upper += area_of(model, {level.triangles[t]});
  }
  EXPECT_NEAR(upper, 128.0, 1e-3);
}

TEST(Decimate, VerticesSplitByAFileWithoutReasonAreOneAgain) {
  // As an STL or an unindexed glTF has it: every triangle with vertices of its own.
  const Model joined = make_sheet(20);
  Model split;
  for (const Triangle& t : joined.triangles) {
    Triangle own{};
    for (std::size_t c = 0; c < 3; ++c) {
      own[c] = static_cast<std::uint32_t>(split.positions.size());
      split.positions.push_back(joined.positions[t[c]]);
    }
    split.triangles.push_back(own);
  }
  split.primitives.push_back({"", -1, 0, static_cast<std::uint32_t>(split.triangles.size())});
  const auto levels = decimate_to(split, {100});
  ASSERT_EQ(levels.size(), 1U);
  EXPECT_LE(used_vertices(levels[0].triangles).size(), 100U);
}

TEST(Decimate, ColorsKeepTheirBorders_UnlessEveryTriangleHasItsOwn) {
  // Two halves, red and blue, with vertices of their own at the border between them.
  Model model = make_grid(16, 16);
  model.colors.assign(model.positions.size(), {255, 0, 0});
  std::map<std::uint32_t, std::uint32_t> blue_of;
  std::vector<bool> is_upper;
  for (Triangle& t : model.triangles) {
    is_upper.push_back(model.positions[t[0]].y + model.positions[t[1]].y + model.positions[t[2]].y > 24.0F);
    for (std::uint32_t& v : t) {
      if (!is_upper.back()) continue;
      const auto [entry, is_new] = blue_of.try_emplace(v, static_cast<std::uint32_t>(model.positions.size()));
      if (is_new) {
        model.positions.push_back(glm::vec3(model.positions[v]));
        model.colors.push_back({0, 0, 255});
      }
      v = entry->second;
    }
  }
  const auto levels = decimate_to(model, {50});
  ASSERT_EQ(levels.size(), 1U);
  double blue = 0.0;
  for (const Triangle& t : levels[0].triangles) {
    EXPECT_EQ(model.colors[t[0]], model.colors[t[1]]);
    EXPECT_EQ(model.colors[t[0]], model.colors[t[2]]);
    if (model.colors[t[0]] == Color8{0, 0, 255}) blue += area_of(model, {t});
  }
  EXPECT_NEAR(blue, 128.0, 1e-3);

  Model split = make_sheet(20);
  const Model joined = split;
  split.positions.clear();
  for (Triangle& t : split.triangles) {
    for (std::uint32_t& v : t) {
      split.positions.push_back(joined.positions[v]);
      v = static_cast<std::uint32_t>(split.positions.size() - 1);
      split.colors.push_back(split.positions.size() % 6 < 3 ? Color8{200, 100, 50} : Color8{50, 100, 200});
    }
  }
  const auto flat = decimate_to(split, {100});
  ASSERT_EQ(flat.size(), 1U);
  EXPECT_LE(flat[0].vertex_count, 100U);
}

TEST(Decimate, VerticesStayWhereColorsChange) {
  Model model = make_sheet(40);
  const auto near_spot = [&] {
    std::size_t count = 0;
    const auto levels = decimate_to(model, {300});
    for (const std::uint32_t v : used_vertices(levels.at(0).triangles))
      count += glm::distance(model.positions[v], {20.0F, 20.0F, model.positions[v].z}) < 6.0F ? 1 : 0;
    return count;
  };
  const std::size_t without = near_spot();
  for (const glm::vec3& p : model.positions)
    model.colors.push_back(glm::distance(p, {20.0F, 20.0F, p.z}) < 4.0F ? Color8{60, 40, 30} : Color8{220, 180, 160});
  EXPECT_GT(near_spot(), without * 3 / 2);
}

TEST(Decimate, FlatShadedFilesLoseTheirNormalsAndOtherCreasesStay) {
  Model model = make_sheet(20);
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    const float angle = static_cast<float>(t) * 1.3F;
    model.normals.emplace_back(std::sin(angle), 0.0F, std::cos(angle));
    const auto n = static_cast<std::uint32_t>(t);
    model.normal_triangles.push_back({n, n, n});
  }
  const auto flat = decimate_to(model, {100});
  ASSERT_EQ(flat.size(), 1U);
  for (const glm::vec3& normal : flat[0].normals) EXPECT_GT(normal.z, 0.9F) << "smooth ones";
  EXPECT_LE(flat[0].vertex_count, 100U);

  // One crease along y = 10.
  model.normals = {{0.0F, 0.0F, 1.0F}, {0.0F, 1.0F, 0.0F}};
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    const std::uint32_t n = t < model.triangles.size() / 2 ? 0 : 1;
    model.normal_triangles[t] = {n, n, n};
  }
  const auto creased = decimate_to(model, {100});
  ASSERT_EQ(creased.size(), 1U);
  ASSERT_EQ(creased[0].normal_triangles.size(), creased[0].triangles.size());
  for (std::size_t t = 0; t < creased[0].triangles.size(); ++t) {
    for (const std::uint32_t v : creased[0].triangles[t]) {
      const float y = model.positions[v].y;
      const glm::vec3 normal = creased[0].normals[creased[0].normal_triangles[t][0]];
      EXPECT_TRUE(normal == model.normals[0] ? y <= 10.0F : normal == model.normals[1] && y >= 10.0F);
    }
  }
}

TEST(Decimate, NothingTurnsOver) {
  Model model = make_ball({0.0F, 0.0F, 0.0F}, 5.0F, 64, 32);
  add_uvs(model);
  const Surface surface = build_surface(model);
  for (const LevelOfDetail& level : decimate_to(model, {1000, 400, 150})) {
    const LevelError error = measure_level(model, surface, level, {});
    EXPECT_EQ(error.flipped_triangles, 0U);
    EXPECT_EQ(error.flipped_uvs, 0U);
    for (const Triangle& t : level.triangles) {
      const glm::vec3 center = model.positions[t[0]] + model.positions[t[1]] + model.positions[t[2]];
      EXPECT_GT(glm::dot(center, glm::cross(model.positions[t[1]] - model.positions[t[0]],
                                            model.positions[t[2]] - model.positions[t[0]])),
                0.0F);
    }
  }
}

TEST(Decimate, PlacesThatAreNoManifoldStayWhole) {
  Model model = make_sheet(20);
  // A fin: a third and a fourth triangle on an edge; and a triangle given twice.
  const std::uint32_t a = 10 * 21 + 10;
  const auto tip = static_cast<std::uint32_t>(model.positions.size());
  model.positions.emplace_back(10.5F, 10.0F, 4.0F);
  model.positions.emplace_back(10.5F, 10.0F, -4.0F);
  const std::vector<Triangle> odd = {{a, a + 1, tip}, {a, a + 1, tip + 1}, model.triangles[5]};
  model.triangles.insert(model.triangles.end(), odd.begin(), odd.end());
  model.triangles.push_back({7, 7, 8});  // no triangle
  model.primitives[0].triangle_count = static_cast<std::uint32_t>(model.triangles.size());
  const auto levels = decimate_to(model, {120});
  ASSERT_EQ(levels.size(), 1U);
  const auto& triangles = levels[0].triangles;
  for (const Triangle& t : odd) {
    const auto same = [&](const Triangle& other) { return std::is_permutation(t.begin(), t.end(), other.begin()); };
    EXPECT_EQ(std::count_if(triangles.begin(), triangles.end(), same),
              std::count_if(model.triangles.begin(), model.triangles.end(), same));
  }
  EXPECT_LE(levels[0].vertex_count, 120U);
}

TEST(Decimate, DegenerateMeshesSurvive) {
  Model needle = make_grid(30, 1);
  for (glm::vec3& p : needle.positions) p.y = 0.0F;  // all triangles without area
  EXPECT_LE(decimate_to(needle, {20}).size(), 1U);
  Model point = make_grid(10, 10);
  for (glm::vec3& p : point.positions) p = glm::vec3(1.0F);
  EXPECT_LE(decimate_to(point, {20}).size(), 1U);
  Model single = testing::make_model({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  EXPECT_TRUE(decimate_to(single, {2}).empty());
  EXPECT_TRUE(decimate_to(make_sheet(5), {1000}).empty());  // no smaller than it is
}

/// Two tips, 0 and 1, over a wavy rim.
Model make_double_fan(std::uint32_t rim) {
  Model model;
  model.positions = {{0.0F, 0.0F, 1.0F}, {0.0F, 0.0F, -1.0F}};
  for (std::uint32_t i = 0; i < rim; ++i) {
    const float angle = 6.2831853F * static_cast<float>(i) / static_cast<float>(rim);
    model.positions.emplace_back(std::cos(angle), std::sin(angle), 0.01F * std::sin(7.0F * angle));
    const std::uint32_t here = 2 + i;
    const std::uint32_t next = 2 + (i + 1) % rim;
    model.triangles.push_back({0, here, next});
    model.triangles.push_back({1, next, here});
  }
  return model;
}

TEST(Decimate, TheMiddleOfALargeFanStays) {
  const auto levels = decimate_to(make_double_fan(200), {100});
  ASSERT_EQ(levels.size(), 1U);
  EXPECT_LE(levels[0].vertex_count, 100U);
  const auto used = used_vertices(levels[0].triangles);
  EXPECT_TRUE(used.contains(0) && used.contains(1));
}

TEST(Decimate, AFanThatNoModellerMakesStaysWhole) {
  // Looking at every neighbour of the tips for every one of them would take hours.
  EXPECT_TRUE(decimate_to(make_double_fan(20'000), {5000}).empty());
}

/// A ball of the face, and the same ball elsewhere in another role; how many vertices each keeps.
struct TwoBalls {
  Model model = make_ball({0.0F, 0.0F, 0.0F}, 5.0F, 64, 32);
  std::uint32_t second;
  Surface surface;
  Rig rig;
  TwoBalls(const glm::vec3& at, PartRole role)
      : second(testing::append(model, make_ball(at, 5.0F, 64, 32), "other")), surface(build_surface(model)) {
    rig = plain_rig(model, surface);
    rig.parts[1].role = role;
  }
  [[nodiscard]] std::array<std::size_t, 2> kept(std::uint32_t budget) const {
    LodOptions options;
    options.budgets = {budget};
    const auto levels = decimate(model, surface, rig, options);
    if (!levels.ok() || levels->size() != 1U) return {0, 0};
    const auto used = used_vertices(levels->front().triangles);
    const auto of_second = static_cast<std::size_t>(std::distance(used.lower_bound(second), used.end()));
    const auto parts = parts_of_level(rig, levels->front());
    EXPECT_EQ(parts[0].vertex_count + parts[1].vertex_count, used.size());
    EXPECT_EQ(parts[0].triangle_count + parts[1].triangle_count, levels->front().triangles.size());
    EXPECT_LE(used.size(), budget);
    EXPECT_GE(used.size(), budget * 9 / 10);
    return {used.size() - of_second, of_second};
  }
};

TEST(Decimate, VerticesGoToTheFace_ThenToHair_ThenToEyesAndTeeth) {
  const glm::vec3 beside(20.0F, 0.0F, 0.0F);
  const auto [face, skin] = TwoBalls(beside, PartRole::skin).kept(600);
  const std::size_t hair = TwoBalls(beside, PartRole::rest).kept(600)[1];
  const std::size_t eye = TwoBalls(beside, PartRole::left_eye).kept(600)[1];
  const std::size_t tooth = TwoBalls(beside, PartRole::upper_teeth).kept(600)[1];
  EXPECT_NEAR(static_cast<double>(face), static_cast<double>(skin), 30.0) << "without points both are skin";
  EXPECT_GT(skin, hair);
  EXPECT_GT(hair, eye);
  EXPECT_GT(eye, tooth);
  EXPECT_GT(tooth, 10U) << "it must not vanish";
}

TEST(Decimate, WhatIsFarFromTheFace_GetsFewerVertices) {
  const auto skin_at = [](float x) {
    TwoBalls balls({x, 0.0F, 0.0F}, PartRole::skin);
    balls.rig.points = testing::points_at(balls.model, {{"2.1", 5}, {"5.1", 900}, {"8.3", 1200}});
    return balls.kept(600)[1];
  };
  const std::size_t hand = skin_at(60.0F);
  const std::size_t foot = skin_at(150.0F);
  EXPECT_GT(skin_at(11.0F), 2 * hand);
  EXPECT_GT(hand, foot);
  EXPECT_GT(foot, 8U);
}

TEST(Decimate, ALevelKeepsThePrimitivesOfItsTriangles) {
  Model model = make_sheet(12);
  testing::append(model, testing::shifted(make_sheet(12), {30.0F, 0.0F, 0.0F}), "second");
  const auto levels = decimate_to(model, {100});
  ASSERT_EQ(levels.size(), 1U);
  Model level = model;
  apply_level(level, levels[0]);
  std::uint32_t first = 0;
  for (const Primitive& primitive : level.primitives) {
    EXPECT_EQ(primitive.first_triangle, first);
    first += primitive.triangle_count;
  }
  EXPECT_EQ(first, level.triangles.size());
  for (std::uint32_t t = level.primitives[1].first_triangle; t < first; ++t) {
    EXPECT_GE(level.positions[level.triangles[t][0]].x, 30.0F);
  }
}

TEST(Decimate, AFaceInWhichItBendsKeepsWhatIsFlatAtRest) {
  const Model model = make_grid(30, 30);
  const Surface surface = build_surface(model);
  LodPose bent{"bent", model.positions};
  for (glm::vec3& p : bent.positions) p.z = p.x > 15.0F ? 2.0F * std::sin(p.x) * std::sin(p.y) : 0.0F;
  const std::vector<LodPose> poses = {bent};
  LodOptions options;
  options.budgets = {300};
  const auto plain = decimate(model, surface, plain_rig(model, surface), options);
  options.poses = poses;
  const auto aware = decimate(model, surface, plain_rig(model, surface), options);
  const double without = measure_level(model, surface, plain->front(), poses).poses[0].rms;
  const double with = measure_level(model, surface, aware->front(), poses).poses[0].rms;
  EXPECT_LT(with, 0.5 * without);
}

TEST(Decimate, StopsOnRequest) {
  const Model model = make_sheet(20);
  const Surface surface = build_surface(model);
  LodOptions options;
  options.budgets = {100};
  options.progress = [](double) { return false; };
  const auto levels = decimate(model, surface, plain_rig(model, surface), options);
  ASSERT_FALSE(levels.ok());
  EXPECT_EQ(levels.error().code, ErrorCode::cancelled);
}

TEST(DefaultBudgets, SaveHalfAtLeastAndLeaveLightModelsAlone) {
  EXPECT_EQ(default_budgets(500000), (std::vector<std::uint32_t>{50000, 20000, 10000, 5000, 2500}));
  EXPECT_EQ(default_budgets(28000), (std::vector<std::uint32_t>{10000, 5000, 2500}));
  EXPECT_EQ(default_budgets(10001), (std::vector<std::uint32_t>{5000, 2500}));
  EXPECT_TRUE(default_budgets(10000).empty());
}

}  // namespace
}  // namespace semblante
