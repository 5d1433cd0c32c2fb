#include "core/anatomy/mirror_plane.h"

#include <array>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace semblante {
namespace {

TEST(MirrorPlane, HalvesPairsAndHoldsTheMiddle) {
  // A plane turned about y by 0.2 and off the origin: pairs are made by it, so it must come back.
  const MirrorPlane made{glm::dvec3(std::cos(0.2), 0.0, std::sin(0.2)), 0.3};
  std::vector<MirrorPair> pairs;
  for (const glm::dvec3& p : {glm::dvec3(1.2, 0, 0), glm::dvec3(1.1, 1, 0.5), glm::dvec3(1.3, -1, 0.2)}) {
    pairs.push_back({p, made.image(p)});
  }
  const MirrorPlane found = fit_mirror_plane(pairs, {});
  EXPECT_GT(glm::dot(found.normal, made.normal), 1.0 - 1e-4);
  for (const MirrorPair& pair : pairs) EXPECT_LT(glm::distance(found.image(pair.left), pair.right), 0.02);
}

TEST(MirrorPlane, OfMiddlePointsAloneStandsUpright) {
  const std::array<glm::dvec3, 3> middle = {glm::dvec3{0.5, 0, 0}, {0.5, -1, 0.2}, {0.5, -2, 0}};
  const MirrorPlane found = fit_mirror_plane({}, middle);
  EXPECT_NEAR(found.normal.x, 1.0, 1e-9);
  EXPECT_NEAR(found.offset, 0.5, 1e-9);
}

TEST(MirrorPlane, WithoutPointsIsTheMiddle) { EXPECT_EQ(fit_mirror_plane({}, {}).distance({0.25, 3.0, 1.0}), 0.25); }

/// Half an ellipsoid about x = 0.1, each place with its mirror image.
std::vector<glm::dvec3> symmetric_surface() {
  std::vector<glm::dvec3> places;
  for (int i = 0; i < 40; ++i) {
    for (int j = 0; j < 20; ++j) {
      const double u = 0.15 * j / 2.0;
      const double v = -1.4 + 0.07 * i;
      const glm::dvec3 half(std::cos(v) * std::sin(u), 1.5 * std::sin(v), 0.9 * std::cos(v) * std::cos(u));
      places.emplace_back(0.1 + half.x, half.y, half.z);
      places.emplace_back(0.1 - half.x, half.y, half.z);
    }
  }
  return places;
}

TEST(MirrorPlane, IsCorrectedByTheSurface) {
  const std::vector<glm::dvec3> surface = symmetric_surface();
  const std::array<glm::dvec3, 2> marked_off = {glm::dvec3{0.13, 0.5, 0.9}, {0.12, -0.5, 0.8}};
  const MirrorPlane start = fit_mirror_plane({}, marked_off);
  const MirrorPlane refined = refine_mirror_plane(start, {}, marked_off, surface, surface);
  const auto off = [](const MirrorPlane& plane) { return std::abs(plane.distance({0.1, 0.0, 0.5})); };
  EXPECT_LT(off(refined), 0.7 * off(start));
}

TEST(MirrorPlane, StaysWhereTheSurfaceSaysNothing) {
  const std::array<glm::dvec3, 2> middle = {glm::dvec3{0.13, 0.5, 0.9}, {0.13, -0.5, 0.8}};
  const MirrorPlane start = fit_mirror_plane({}, middle);
  const std::vector<glm::dvec3> one_side(200, glm::dvec3(3.0, 0.0, 0.0));
  EXPECT_EQ(refine_mirror_plane(start, {}, middle, one_side, one_side).offset, start.offset);
  EXPECT_EQ(refine_mirror_plane(start, {}, middle, {}, {}).offset, start.offset);
}

}  // namespace
}  // namespace semblante
