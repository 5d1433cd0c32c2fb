#include "core/propose/face_surface.h"

#include <utility>

#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace semblante {
namespace {

/// Two grids of 4 by 4 cells: the front one faces forward, the one behind it at z = -0.5 faces backwards.
class DoubleWall : public ::testing::Test {
 protected:
  DoubleWall() : front_(testing::make_grid(4, 4)), model_(front_) {
    Model back = testing::shifted(front_, {0.0F, 0.0F, -0.5F});
    for (Triangle& t : back.triangles) std::swap(t[1], t[2]);
    testing::append(model_, back, "back");
    surface_ = build_surface(model_);
    parts_.resize(surface_.part_count());
    for (Part& part : parts_) part.role = PartRole::skin;
  }

  Model front_, model_;
  Surface surface_;
  std::vector<Part> parts_;
};

TEST_F(DoubleWall, FacesForwardInFrontOnly) {
  const FaceSurface face(surface_, parts_, Similarity{}, model_.triangles);
  for (std::uint32_t v = 0; v < surface_.vertex_count(); ++v)
    EXPECT_EQ(face.faces_forward_at(v), face.at(v).z == 0.0) << v;
  const FaceSurface without_triangles(surface_, parts_, Similarity{});
  EXPECT_TRUE(without_triangles.faces_forward_at(static_cast<std::uint32_t>(surface_.vertex_count()) - 1));
}

TEST_F(DoubleWall, HasAPlaceBetweenVertices_InFrontIfAskedFor) {
  const FaceSurface face(surface_, parts_, Similarity{}, model_.triangles);
  const glm::dvec3 nearer_to_the_back(1.3, 1.3, -0.4);
  const auto nearest = face.nearest_between(PartRole::skin, nearer_to_the_back, false);
  ASSERT_TRUE(nearest);
  EXPECT_EQ(nearest->z, -0.5);
  const auto forward = face.nearest_between(PartRole::skin, nearer_to_the_back, true);
  ASSERT_TRUE(forward);
  EXPECT_EQ(forward->z, 0.0);
}

}  // namespace
}  // namespace semblante
