#include "clients/native/render/camera.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/vec4.hpp>
#include <gtest/gtest.h>

namespace semblante::testing {
namespace {

using render::Box;
using render::View;

constexpr std::array all_views = {View::front, View::left,  View::right, View::three_quarter, View::three_quarter_right,
                                  View::below, View::above, View::back};

glm::vec3 on_screen(const render::Camera& camera, float aspect, glm::vec3 point) {
  const glm::vec4 clip = camera.projection(aspect) * camera.view() * glm::vec4(point, 1.0F);
  return glm::vec3(clip) / clip.w;
}

TEST(Camera, FromEveryView_SeesTheWholeSubjectAndFillsThePicture) {
  const Box subject{{-2, 5, 1}, {3, 9, 4}};
  const Box scene{{-10, -3, -6}, {10, 12, 8}};
  for (const View view : all_views) {
    for (const float aspect : {0.6F, 1.0F, 1.9F}) {
      const render::Camera camera = frame_box(subject, scene, view, aspect);
      float reach = 0;
      for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p((corner & 1) != 0 ? 3 : -2, (corner & 2) != 0 ? 9 : 5, (corner & 4) != 0 ? 4 : 1);
        const glm::vec3 seen = on_screen(camera, aspect, p);
        EXPECT_GE(seen.z, -1.0F);
        EXPECT_LE(seen.z, 1.0F);
        reach = std::max({reach, std::abs(seen.x), std::abs(seen.y)});
      }
      EXPECT_LE(reach, 1.0F);
      EXPECT_GT(reach, 0.9F);
    }
  }
}

TEST(Camera, LeftView_ShowsTheFacesOwnLeft) {
  const Box head{{-1, -1, -1}, {1, 1, 1}};
  const render::Camera camera = frame_box(head, head, View::left, 1.0F);
  EXPECT_GT(camera.eye.x, 1.0F) << "+X is the face's left";
  EXPECT_LT(on_screen(camera, 1.0F, {1, 0, 1}).x, 0.0F) << "the nose (+Z) is on the picture's left";
}

TEST(Subjects, FromFeaturePoints_SurroundThem) {
  FeaturePointSet points;
  const auto mark = [&](const char* id, glm::vec3 at) { points.push_back({*parse_feature_point(id), {}, at}); };
  mark("2.2", {0, -3, 8});
  mark("2.4", {2, -3, 7});
  mark("2.5", {-2, -3, 7});
  mark("3.7", {4, 2, 6});
  mark("3.12", {-4, 2, 6});
  const Box all{{-8, -12, -9}, {8, 12, 9}};
  const render::Subjects subjects = find_subjects(all, points, std::nullopt);
  EXPECT_LT(subjects.mouth.min.x, -2.0F);
  EXPECT_GT(subjects.mouth.max.x, 2.0F);
  EXPECT_LT(subjects.mouth.max.y, 2.0F);
  EXPECT_GT(subjects.eyes.min.y, -3.0F);
  EXPECT_LT(subjects.face.min.y, -3.0F);
  EXPECT_GT(subjects.face.max.y, 2.0F);
  EXPECT_EQ(subjects.all.max, all.max);
}

TEST(Names, OfViewsAndSubjects_AreReadOrRefused) {
  EXPECT_EQ(render::parse_view("three-quarter"), View::three_quarter);
  EXPECT_EQ(render::parse_view("sideways"), std::nullopt);
  EXPECT_EQ(render::parse_subject("mouth"), render::Subject::mouth);
  EXPECT_EQ(render::parse_subject(""), std::nullopt);
}

}  // namespace
}  // namespace semblante::testing
