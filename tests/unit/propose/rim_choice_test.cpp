#include "core/propose/rim_choice.h"

#include <gtest/gtest.h>

#include "core/anatomy/part_roles.h"
#include "tests/support/meshes.h"

namespace semblante {
namespace {

using testing::fp;

/// A mouth whose lips are pressed past each other: the upper rim lies under the lower one.
class RimChoiceOfAMouth : public ::testing::Test {
 protected:
  RimChoiceOfAMouth() {
    upper_ = mouth_.at(1, 0, true);
    lower_ = mouth_.at(1, 0, false);
    for (const std::string_view name : {"8.1", "8.2", "2.4", "2.5"}) {
      const std::uint32_t vertex = name == "8.1"   ? mouth_.at(0, 1)
                                   : name == "8.2" ? mouth_.at(0, -1)
                                   : name == "2.4" ? mouth_.at(2, 0)
                                                   : mouth_.at(-2, 0);
      points_.push_back({fp(name), vertex});
    }
    mouth_.model.positions[upper_].y = -0.1F;
    build();
  }
  void build() {
    surface_ = build_surface(mouth_.model);
    parts_.assign(surface_.part_count(), Part{});
  }
  /// For a point expected at `place`.
  RimVertex choose(std::string_view id, const glm::dvec3& place, bool with_anchors = true) {
    std::vector<SurfacePoint> anchors;
    for (const auto& [name, vertex] : points_) {
      const SurfaceVertexId at = surface_.surface_of[vertex];
      if (with_anchors) anchors.push_back({name, at, surface_.positions[at.value()]});
    }
    const FaceSurface face(surface_, parts_, Similarity{});
    RimVertex chosen = *RimChoice(face, anchors).nearest(rim_of_point(fp(id)), PartRole::skin, place, 0.05, nullptr);
    chosen.vertex = surface_.file_vertex_of[chosen.vertex].value();
    return chosen;
  }

  testing::ClosedMouth mouth_ = testing::make_closed_mouth();
  std::uint32_t upper_, lower_;
  std::vector<std::pair<FeaturePointId, std::uint32_t>> points_;
  Surface surface_;
  std::vector<Part> parts_;
};

TEST_F(RimChoiceOfAMouth, TakesTheOwnLipThoughTheOtherIsNearer) {
  const RimVertex upper = choose("2.6", {1.0, 0.0, 0.0});
  EXPECT_EQ(upper.vertex, upper_);
  EXPECT_EQ(upper.doubt, "");
  const RimVertex lower = choose("2.8", {1.0, -0.1, 0.0});
  EXPECT_EQ(lower.vertex, lower_);
  EXPECT_EQ(lower.doubt, "");
}

TEST_F(RimChoiceOfAMouth, WithoutPointsThatTellTheSidesTakesTheNearestAndDoubts) {
  const RimVertex upper = choose("2.6", {1.0, 0.0, 0.0}, /*with_anchors=*/false);
  EXPECT_EQ(upper.vertex, lower_);
  EXPECT_NE(upper.doubt.find("too few points"), std::string::npos) << upper.doubt;
  EXPECT_NE(upper.doubt.find("upper lip from the lower lip"), std::string::npos) << upper.doubt;
}

TEST_F(RimChoiceOfAMouth, OnWeldedLipsDoubts) {
  for (Triangle& t : mouth_.model.triangles) {
    for (std::uint32_t& corner : t) {
      for (const int column : {-1, 0, 1}) {
        if (corner == mouth_.at(column, 0, true)) corner = mouth_.at(column, 0, false);
      }
      if (corner == upper_) corner = lower_;
    }
  }
  build();
  EXPECT_NE(choose("2.6", {1.0, 0.0, 0.0}).doubt, "");
  EXPECT_NE(choose("2.8", {1.0, 0.0, 0.0}).doubt, "");
}

TEST_F(RimChoiceOfAMouth, OnAPieceWithoutPointsDoubts) {
  const std::uint32_t piece =
      testing::append(mouth_.model, testing::shifted(testing::make_grid(1, 1), {1.0F, 0.0F, 1.0F}), "");
  build();
  const RimVertex there = choose("2.6", {1.0, 0.0, 1.0});
  EXPECT_EQ(there.vertex, piece);
  EXPECT_NE(there.doubt, "");
}

}  // namespace
}  // namespace semblante
