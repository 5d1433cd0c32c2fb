#include "core/geometry/surface.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/geometry/stitch.h"
#include "tests/support/meshes.h"

namespace semblante {
namespace {

using ::testing::ElementsAre;
using testing::make_model;

// Two triangles that share the edge (1,0)-(1,1) by position only: 1 and 3 are one place, 2 and 4 another.
const std::vector<glm::vec3> seam_positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 0, 0}, {1, 1, 0}, {2, 0, 0}};
const std::vector<Triangle> seam_triangles = {{0, 1, 2}, {3, 5, 4}};

TEST(Stitch, CoincidingBoundaryEdges_BecomeOne) {
  EXPECT_THAT(stitch_seams(seam_positions, seam_triangles), ElementsAre(0, 1, 2, 1, 2, 5));
}

TEST(Stitch, MinusZero_EqualsPlusZero) {
  auto positions = seam_positions;
  positions[3].y = -0.0F;
  positions[4].z = -0.0F;
  EXPECT_THAT(stitch_seams(positions, seam_triangles), ElementsAre(0, 1, 2, 1, 2, 5));
}

TEST(Stitch, NextFloat_IsAnotherPlace) {
  auto positions = seam_positions;
  positions[3].x = std::nextafter(1.0F, 2.0F);
  EXPECT_THAT(stitch_seams(positions, seam_triangles), ElementsAre(0, 1, 2, 3, 4, 5));
}

TEST(Stitch, TouchingAtOneVertex_StaysApart) {
  // The second triangle meets the first in the place of vertex 1 alone.
  const std::vector<glm::vec3> positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 0, 0}, {2, 1, 0}, {2, 0, 0}};
  EXPECT_THAT(stitch_seams(positions, std::vector<Triangle>{{0, 1, 2}, {3, 5, 4}}), ElementsAre(0, 1, 2, 3, 4, 5));
}

TEST(Stitch, BoundaryOnAnInnerEdge_StaysApart) {
  // A lash whose root lies on an edge that two skin triangles share: only one of the two is a boundary edge.
  const std::vector<glm::vec3> positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {2, 0, 0},
                                            {1, 0, 0}, {1, 1, 0}, {1, 0, 1}};
  EXPECT_THAT(stitch_seams(positions, std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}, {4, 6, 5}}),
              ElementsAre(0, 1, 2, 3, 4, 5, 6));
}

TEST(Stitch, ThreeSheetsAtOneEdge_AllBecomeOne) {
  auto positions = seam_positions;
  positions.insert(positions.end(), {{1, 0, 0}, {1, 1, 0}, {1, 0, 1}});
  auto triangles = seam_triangles;
  triangles.push_back({6, 7, 8});
  EXPECT_THAT(stitch_seams(positions, triangles), ElementsAre(0, 1, 2, 1, 2, 5, 1, 2, 8));
}

TEST(Stitch, TriangleGivenTwice_CountsOnce) {
  auto triangles = seam_triangles;
  triangles.push_back({2, 0, 1});  // the first again, another corner first
  EXPECT_THAT(stitch_seams(seam_positions, triangles), ElementsAre(0, 1, 2, 1, 2, 5));
}

TEST(Stitch, TriangleWithAVertexTwice_IsNoTriangle) {
  auto triangles = seam_triangles;
  triangles.push_back({1, 2, 1});  // else the edge 1-2 would have two triangles
  EXPECT_THAT(stitch_seams(seam_positions, triangles), ElementsAre(0, 1, 2, 1, 2, 5));
}

TEST(Stitch, EdgesWithoutLengthAtOnePlace_AllEndsBecomeOne) {
  // Two collapsed quads at the pole of a sphere: 0, 1 and 2, 3 all lie at the origin.
  const std::vector<glm::vec3> positions = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_THAT(stitch_seams(positions, std::vector<Triangle>{{0, 1, 4}, {2, 3, 5}}), ElementsAre(0, 0, 0, 0, 4, 5));
}

TEST(Stitch, NothingAtAll_GivesNothing) { EXPECT_TRUE(stitch_seams({}, {}).empty()); }

TEST(Surface, Seam_GivesOneGraphWithEuclideanLengths) {
  const Surface surface = build_surface(make_model(seam_positions, seam_triangles));
  ASSERT_EQ(surface.vertex_count(), 4U);  // 0; 1 and 3; 2 and 4; 5
  EXPECT_THAT(surface.surface_of, ElementsAre(SurfaceVertexId(0), SurfaceVertexId(1), SurfaceVertexId(2),
                                              SurfaceVertexId(1), SurfaceVertexId(2), SurfaceVertexId(3)));
  EXPECT_THAT(surface.file_vertex_of, ElementsAre(VertexId(0), VertexId(1), VertexId(2), VertexId(5)));
  EXPECT_EQ(surface.part_count(), 1U);
  ASSERT_EQ(surface.steps.size(), 10U);  // 5 edges from both ends; the seam is one edge
  const auto steps = surface.steps_from(SurfaceVertexId(0));
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_EQ(steps[0].to, SurfaceVertexId(1));
  EXPECT_EQ(steps[0].length, 1.0);
  EXPECT_EQ(steps[1].to, SurfaceVertexId(2));
  EXPECT_EQ(steps[1].length, std::sqrt(2.0));
}

TEST(Surface, LengthsComeFromFloatsInDouble) {
  const Surface surface = build_surface(make_model({{0, 0, 0}, {0.1F, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
  // The float nearest to 0.1 is 0.100000001490116...; its length must not be rounded again.
  EXPECT_EQ(surface.steps_from(SurfaceVertexId(0))[0].length, static_cast<double>(0.1F));
}

TEST(Surface, NonManifoldEdge_IsOneEdge) {
  const Surface surface = build_surface(
      make_model({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));
  EXPECT_EQ(surface.part_count(), 1U);
  EXPECT_EQ(surface.steps.size(), 14U);  // 0-1 and two edges to each of 2, 3, 4
}

TEST(Surface, Parts_AreNumberedByTheirLowestVertex_UnusedVerticesLast) {
  // Vertex 0 and 7 have no triangle; 1, 3, 5 and 2, 4, 6 are two parts.
  Model model = make_model({{9, 9, 9}, {0, 0, 0}, {5, 0, 0}, {1, 0, 0}, {6, 0, 0}, {0, 1, 0}, {5, 1, 0}, {8, 8, 8}},
                           {{2, 4, 6}, {1, 3, 5}});
  const Surface surface = build_surface(model);
  EXPECT_THAT(surface.part_of,
              ElementsAre(PartId(2), PartId(0), PartId(1), PartId(0), PartId(1), PartId(0), PartId(1), PartId(2)));
  const auto members = surface.members_of(PartId(1));
  EXPECT_THAT(std::vector(members.begin(), members.end()),
              ElementsAre(SurfaceVertexId(2), SurfaceVertexId(4), SurfaceVertexId(6)));
  EXPECT_TRUE(surface.steps_from(SurfaceVertexId(0)).empty());
}

TEST(Surface, TriangleWithAVertexTwice_JoinsNothing) {
  Model model = make_model({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}},
                           {{0, 1, 2}, {2, 2, 3}, {2, 3, 3}, {3, 4, 5}});  // a strip jumping from 2 to 3
  EXPECT_EQ(build_surface(model).part_count(), 2U);
}

}  // namespace
}  // namespace semblante
