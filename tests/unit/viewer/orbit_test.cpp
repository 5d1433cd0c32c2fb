#include "clients/native/viewer/orbit.h"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <gtest/gtest.h>

namespace semblante::testing {
namespace {

const render::Box subject{{-1, -1, -0.5F}, {1, 2, 0.5F}};
const render::Box scene{{-2, -4, -1}, {2, 2, 1}};

render::Camera camera_of(const viewer::Orbit& orbit) { return orbit.camera(subject, scene, 1.5F); }

TEST(Orbit, Start_IsTheFrontViewOfPictures) {
  const auto camera = camera_of({});
  const auto front = render::frame_box(subject, scene, render::View::front, 1.5F);
  EXPECT_EQ(camera.eye, front.eye);
  EXPECT_EQ(camera.near_plane, front.near_plane);
  EXPECT_EQ(camera.far_plane, front.far_plane);
}

TEST(Orbit, AQuarterTurn_LooksFromTheLeftSideAtTheSameDistance) {
  viewer::Orbit orbit;
  orbit.turn(1.5707964F, 0);
  const auto camera = camera_of(orbit);
  const glm::vec3 away = camera.eye - camera.target;
  const auto front = camera_of({});
  EXPECT_NEAR(glm::length(away), glm::length(front.eye - front.target), 1e-4F);
  EXPECT_NEAR(away.x, glm::length(away), 1e-4F);
}

TEST(Orbit, AnyDirectionAndDistance_KeepsTheSceneBetweenThePlanes) {
  for (const float zoom : {0.1F, 1.0F, 100.0F}) {
    for (const float yaw : {-3.0F, 0.3F, 2.0F}) {
      for (const float pitch : {-9.0F, 0.2F, 9.0F}) {
        viewer::Orbit orbit;
        orbit.turn(yaw, pitch);
        orbit.zoom(zoom);
        const auto camera = camera_of(orbit);
        EXPECT_GT(camera.near_plane, 0);
        EXPECT_LT(std::abs(camera.eye.y - camera.target.y), glm::length(camera.eye - camera.target))
            << "never from above";
        for (const glm::vec3 corner : {scene.min, scene.max, glm::vec3(scene.min.x, scene.max.y, scene.min.z)}) {
          const float depth = -(camera.view() * glm::vec4(corner, 1)).z;
          EXPECT_LT(depth, camera.far_plane);
          if (zoom >= 1) {
            EXPECT_GT(depth, camera.near_plane);
          }
        }
      }
    }
  }
}

TEST(Orbit, Reset_IsTheFrontAgain) {
  viewer::Orbit orbit;
  orbit.turn(1, 1);
  orbit.zoom(0.5F);
  EXPECT_NE(camera_of(orbit).eye, camera_of({}).eye);
  orbit.reset();
  EXPECT_EQ(camera_of(orbit).eye, camera_of({}).eye);
}

}  // namespace
}  // namespace semblante::testing
