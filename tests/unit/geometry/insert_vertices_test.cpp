#include "core/geometry/insert_vertices.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/geometry/triangle_shape.h"
#include "tests/support/meshes.h"

namespace semblante {
namespace {

using ::testing::ElementsAre;
using testing::make_model;

/// Two triangles over the unit square, in primitives of their own, with UVs, normals and a morph target. The edge from
/// (0, 0) to (1, 1) is a seam: vertices 0 and 3 are one place, 2 and 4 another; the UVs differ.
Model make_square() {
  Model model = make_model({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {3, 4, 5}});
  model.primitives = {{"right", -1, 0, 1}, {"left", -1, 1, 1}};
  model.uvs = {{0, 0}, {0.5, 0}, {0.5, 1}, {1, 0}, {1, 1}, {0.75, 1}};
  model.uv_triangles = model.triangles;
  model.normals = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
  model.normal_triangles = {{0, 1, 2}, {0, 2, 1}};
  model.examples = {{"smile", {1, 2, 4}, {{0, 0, 4}, {0, 0, 2}, {0, 0, 2}}}};
  return model;
}

double area_of(const Model& model) {
  double area = 0.0;
  for (const Triangle& t : model.triangles)
    area += area_vector(model.positions[t[0]], model.positions[t[1]], model.positions[t[2]]).z / 2.0;
  return area;
}

TEST(MeantCorner, WithinATenthOfTheShorterEdge) {
  const glm::dvec3 a(0, 0, 0);
  const glm::dvec3 b(10, 0, 0);
  const glm::dvec3 c(0, 2, 0);
  EXPECT_EQ(meant_corner({0.981, 0.019, 0.0}, a, b, c), 0U) << "0.19 from a corner with an edge of 2";
  EXPECT_EQ(meant_corner({0.979, 0.021, 0.0}, a, b, c), std::nullopt);
  EXPECT_EQ(meant_corner({0.0, 0.91, 0.09}, a, b, c), 1U);
  EXPECT_EQ(meant_corner({0.3, 0.3, 0.4}, a, b, c), std::nullopt);
}

TEST(MovedToEdge, WithinATwentieth) {
  EXPECT_EQ(moved_to_edge({0.475, 0.05, 0.475}), glm::dvec3(0.5, 0.0, 0.5));
  EXPECT_EQ(moved_to_edge({0.47, 0.06, 0.47}), glm::dvec3(0.47, 0.06, 0.47));
  EXPECT_EQ(moved_to_edge({0.0, 0.25, 0.75}), glm::dvec3(0.0, 0.25, 0.75));
}

TEST(InsertVertices, NoPlace_ChangesNothing) {
  Model model = make_square();
  model.normals.clear();
  model.normal_triangles.clear();
  const Insertion insertion = insert_vertices(model, build_surface(model), {});
  EXPECT_TRUE(insertion.vertices.empty());
  EXPECT_TRUE(model.normals.empty());
}

TEST(InsertVertices, Colors_AreInterpolatedAsLight) {
  Model model = make_square();
  model.colors = {{0, 0, 0}, {255, 0, 0}, {255, 0, 0}, white, white, white};
  const TrianglePlace place{0, {0.5, 0.25, 0.25}};
  insert_vertices(model, build_surface(model), std::span(&place, 1));
  ASSERT_EQ(model.colors.size(), 7U);
  EXPECT_EQ(model.colors[6], (Color8{188, 0, 0})) << "half the light";
}

TEST(InsertVertices, InsideATriangle_SplitsItIntoThree_AndInterpolates) {
  Model model = make_square();
  const TrianglePlace place{0, {0.25, 0.25, 0.5}};
  const Insertion insertion = insert_vertices(model, build_surface(model), std::span(&place, 1));
  EXPECT_THAT(insertion.vertex_of_place, ElementsAre(6));
  ASSERT_EQ(model.positions.size(), 7U);
  EXPECT_EQ(model.positions[6], glm::vec3(0.75F, 0.5F, 0.0F));
  EXPECT_THAT(model.triangles, ElementsAre(Triangle{6, 1, 2}, Triangle{0, 6, 2}, Triangle{0, 1, 6}, Triangle{3, 4, 5}));
  EXPECT_EQ(model.uv_triangles, model.triangles) << "as in a model from glTF";
  EXPECT_EQ(model.uvs.at(6), glm::vec2(0.375F, 0.5F));
  EXPECT_LT(glm::distance(model.normals.at(3), glm::normalize(glm::vec3(0.25F, 0.5F, 0.25F))), 1e-6F);
  EXPECT_EQ(model.normal_triangles[0], (Triangle{3, 1, 2}));
  EXPECT_EQ(model.primitives[0].triangle_count, 3U);
  EXPECT_EQ(model.primitives[1].first_triangle, 3U);
  EXPECT_EQ(model.primitives[1].triangle_count, 1U);
  EXPECT_EQ(model.examples[0].at(6), glm::vec3(0.0F, 0.0F, 2.0F));
  EXPECT_DOUBLE_EQ(area_of(model), 1.0);
}

TEST(InsertVertices, OnASeam_SplitsBothSides_WhichStayStitched) {
  Model model = make_square();
  const std::size_t before = build_surface(model).vertex_count();
  const TrianglePlace place{1, {0.25, 0.75, 0.0}};
  const Insertion insertion = insert_vertices(model, build_surface(model), std::span(&place, 1));
  ASSERT_EQ(model.positions.size(), 8U);
  EXPECT_THAT(insertion.vertex_of_place, ElementsAre(6));
  EXPECT_EQ(model.positions[6], glm::vec3(0.75F, 0.75F, 0.0F));
  EXPECT_EQ(model.positions[7], model.positions[6]);
  EXPECT_EQ(model.uvs.at(6), glm::vec2(1.0F, 0.75F)) << "of its own side";
  EXPECT_EQ(model.uvs.at(7), glm::vec2(0.375F, 0.75F)) << "of the other side";
  EXPECT_EQ(model.triangles.size(), 4U);
  EXPECT_EQ(model.primitives[0].triangle_count, 2U);
  EXPECT_EQ(model.primitives[1].triangle_count, 2U);
  EXPECT_EQ(model.examples[0].at(6).z, 1.5F);
  EXPECT_EQ(model.examples[0].at(7).z, 1.5F);
  const Surface surface = build_surface(model);
  EXPECT_EQ(surface.vertex_count(), before + 1);
  EXPECT_EQ(surface.part_count(), 1U);
  EXPECT_EQ(surface.surface_of[6], surface.surface_of[7]);
  EXPECT_DOUBLE_EQ(area_of(model), 1.0);
}

TEST(InsertVertices, SeveralOnOneTriangle_EachGetsItsVertex_TheSamePlaceTheSameOne) {
  Model model = make_square();
  const std::vector<TrianglePlace> places = {
      {0, {0.25, 0.25, 0.5}}, {0, {0.5, 0.25, 0.25}}, {0, {0.25, 0.25, 0.5}}, {0, {0.5, 0.5, 0.0}}};
  const Insertion insertion = insert_vertices(model, build_surface(model), places);
  EXPECT_THAT(insertion.vertex_of_place, ElementsAre(6, 7, 6, 8));
  EXPECT_EQ(model.positions[7], glm::vec3(0.5F, 0.25F, 0.0F));
  EXPECT_EQ(model.positions[8], glm::vec3(0.5F, 0.0F, 0.0F));
  EXPECT_DOUBLE_EQ(area_of(model), 1.0);
  for (const Triangle& t : model.triangles)
    EXPECT_GT(area_vector(model.positions[t[0]], model.positions[t[1]], model.positions[t[2]]).z, 0.0);
}

TEST(InsertVertices, ModelWithoutNormals_GetsTheSmoothOnesOfBefore) {
  Model model = make_model({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
  const TrianglePlace place{3, {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}};
  insert_vertices(model, build_surface(model), std::span(&place, 1));
  ASSERT_EQ(model.normals.size(), 5U);
  EXPECT_LT(glm::distance(model.normals[0], -glm::normalize(glm::vec3(1.0F))), 1e-6F);
  for (const glm::vec3& normal : model.normals) EXPECT_NEAR(glm::length(normal), 1.0F, 1e-6F);
}

TEST(InsertVertices, AnotherShape_GetsTheSameVertices) {
  Model model = make_square();
  std::vector<glm::vec3> shape = model.positions;
  for (glm::vec3& p : shape) p = glm::vec3(2.0F * p.x, p.y, 1.0F);
  const std::vector<TrianglePlace> places = {{0, {0.25, 0.25, 0.5}}, {0, {0.5, 0.25, 0.25}}, {1, {0.5, 0.5, 0.0}}};
  const Insertion insertion = insert_vertices(model, build_surface(model), places);
  add_inserted(shape, insertion.vertices);
  ASSERT_EQ(shape.size(), model.positions.size());
  for (std::size_t v = 0; v < shape.size(); ++v)
    EXPECT_EQ(shape[v], glm::vec3(2.0F * model.positions[v].x, model.positions[v].y, 1.0F)) << v;
}

}  // namespace
}  // namespace semblante
