// A prepared face gives what semblante_deform gives, bit for bit, by every kind of register.
#include "tests/support/prepared_face.h"

#include <cstring>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/unit/kernel/random_face.h"

namespace {

using semblante::testing::Prepared;
using semblante::testing::RandomFace;

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST(KernelPrepared_Variants, GiveTheBitsOfTheRows) {
  std::uint32_t count = 0;
  const semblante_deform_variant* const variants = semblante_deform_variants(&count);
  ASSERT_GE(count, 1U);
  for (const std::uint32_t vertices : {1U, 7U, 8U, 9U, 15U, 16U, 17U, 64U, 1000U, 5003U}) {
    const RandomFace face(vertices, vertices);
    const Prepared prepared(face.view());
    for (unsigned kind = 0; kind < RandomFace::pose_kinds; ++kind) {
      const semblante_pose pose = face.pose(kind);
      std::vector<float> rows(vertices * 3U);
      semblante_deform(&face.view(), &pose, rows.data());
      for (std::uint32_t v = 0; v < count; ++v) {
        const Prepared own(face.view(), variants[v].group_size);
        std::vector<float> found(vertices * 3U + 1, -7.0F);
        semblante_deform_by(&variants[v], own.face, &pose, found.data());
        EXPECT_EQ(found.back(), -7.0F) << "wrote behind the last vertex";
        found.pop_back();
        EXPECT_TRUE(same_bits(found, rows)) << variants[v].name << ", " << vertices << " vertices, pose " << kind;
      }
      std::vector<float> found(vertices * 3U);
      semblante_deform_prepared(prepared.face, &pose, found.data());
      EXPECT_TRUE(same_bits(found, rows)) << vertices << " vertices, pose " << kind;
    }
  }
}

/// The rig of whose eyes a pose is.
semblante_rig rig_of(const semblante_pose& pose) {
  semblante_rig rig{};
  std::memcpy(rig.eye_pivot, pose.eye_pivot, sizeof(rig.eye_pivot));
  std::memcpy(rig.lids, pose.lids, sizeof(rig.lids));
  return rig;
}

TEST(KernelPrepared_Rig, GivesTheBitsOfTheRows_AlsoOfOtherEyes) {
  const RandomFace face(5003, 5003);
  std::uint32_t count = 0;
  const semblante_deform_variant* const variants = semblante_deform_variants(&count);
  const auto pose_of = [&face](unsigned kind) {
    semblante_pose pose = face.pose(kind);
    for (semblante_lids& lids : pose.lids) {  // no spheres, so that the gaze counts
      for (unsigned k = 0; k < SEMBLANTE_BALL_PLACES; ++k) lids.ball[k] = 0.5F - 0.01F * static_cast<float>(k);
    }
    return pose;
  };
  const semblante_rig rig = rig_of(pose_of(RandomFace::neutral));
  for (unsigned kind = 0; kind < RandomFace::pose_kinds; ++kind) {
    semblante_pose other_ball = pose_of(kind);
    for (float& radius : other_ball.lids[1].ball) radius = 0.5F;
    semblante_pose other_gaze = pose_of(kind);
    other_gaze.lids[0].gaze[1] = 0.6F;
    other_gaze.lids[0].gaze[2] = 0.8F;
    semblante_pose other_pivot = pose_of(kind);
    other_pivot.eye_pivot[0][2] = 0.25F;
    for (const semblante_pose& pose : {pose_of(kind), other_ball, other_gaze, other_pivot}) {
      std::vector<float> rows(face.view().vertex_count * 3U);
      semblante_deform(&face.view(), &pose, rows.data());
      for (std::uint32_t v = 0; v < count; ++v) {
        const Prepared prepared(face.view(), variants[v].group_size, &rig);
        std::vector<float> found(rows.size());
        semblante_deform_by(&variants[v], prepared.face, &pose, found.data());
        EXPECT_TRUE(same_bits(found, rows)) << variants[v].name << ", pose " << kind;
      }
    }
  }
}

TEST(KernelPrepared_Changed, BringsAnyPoseToAnyOther) {
  const RandomFace face(3001, 5);
  std::uint32_t count = 0;
  const semblante_deform_variant* const variants = semblante_deform_variants(&count);
  for (std::uint32_t v = 0; v < count; ++v) {
    const semblante_rig rig = rig_of(face.pose(RandomFace::neutral));
    const Prepared prepared(face.view(), variants[v].group_size, &rig);  // of each size, the fastest variant is tested
    for (unsigned from = 0; from < RandomFace::pose_kinds; ++from) {
      for (unsigned to = 0; to < RandomFace::pose_kinds; ++to) {
        const semblante_pose before = face.pose(from);
        const semblante_pose now = face.pose(to);
        std::vector<float> found(face.view().vertex_count * 3U);
        std::vector<float> all(found.size());
        semblante_deform_prepared(prepared.face, &before, found.data());
        semblante_deform_changed(prepared.face, &before, &now, found.data());
        semblante_deform_prepared(prepared.face, &now, all.data());
        EXPECT_TRUE(same_bits(found, all)) << from << " to " << to << ", groups of " << variants[v].group_size;
      }
    }
  }
}

TEST(KernelPrepared_Changed, LeavesAloneWhatCannotHaveChanged) {
  const RandomFace face(4000, 6);
  const Prepared prepared(face.view());
  const semblante_pose before = face.pose(RandomFace::everything);
  std::vector<float> positions(face.view().vertex_count * 3U);
  semblante_deform_prepared(prepared.face, &before, positions.data());
  EXPECT_EQ(semblante_deform_changed(prepared.face, &before, &before, positions.data()), 0U);

  semblante_pose now = before;
  now.fp[3 * 40] += 0.25F;  // one point
  std::uint32_t influenced = 0;
  for (std::uint32_t v = 0; v < face.view().vertex_count; ++v) influenced += face.influences(v, 40);
  const std::uint32_t written = semblante_deform_changed(prepared.face, &before, &now, positions.data());
  EXPECT_GE(written, influenced);
  EXPECT_LT(written, face.view().vertex_count / 2);

  now = before;
  now.head_rotation[0] = 0.6F;
  now.head_rotation[3] = 0.8F;
  const std::uint32_t turned = semblante_deform_changed(prepared.face, &before, &now, positions.data());
  EXPECT_GE(turned, face.turning());
  EXPECT_LT(turned, face.view().vertex_count) << "vertices of the body stay";
}

TEST(KernelPrepared_Size, IsZero_WhenTheRowsDoNotRise) {
  RandomFace face(100, 9);
  ASSERT_GT(semblante_prepared_size(&face.view()), 0U);
  face.swap_two_points_of_a_row();
  EXPECT_EQ(semblante_prepared_size(&face.view()), 0U);
}

TEST(KernelPrepared_Size, HoldsAFaceWithoutVerticesRowsOrParts) {
  RandomFace face(24, 3);
  semblante_face bare = face.view();
  bare.rigid = nullptr;
  const std::vector<std::uint32_t> offsets(25, 0);
  bare.row_offsets = offsets.data();
  const Prepared prepared(bare);
  const semblante_pose pose = face.pose(RandomFace::everything);
  std::vector<float> rows(72);
  std::vector<float> found(72);
  semblante_deform(&bare, &pose, rows.data());
  semblante_deform_prepared(prepared.face, &pose, found.data());
  EXPECT_TRUE(same_bits(found, rows));

  // Minus zero plus a displacement of zero is zero, also where no sum is made.
  const std::vector<float> minus_zero(72, -0.0F);
  bare.rest = minus_zero.data();
  const Prepared at_zero(bare);
  const semblante_pose still = face.pose(RandomFace::neutral);
  semblante_deform(&bare, &still, rows.data());
  semblante_deform_prepared(at_zero.face, &still, found.data());
  EXPECT_TRUE(same_bits(found, rows));

  bare.vertex_count = 0;
  const Prepared none(bare);
  semblante_deform_prepared(none.face, &pose, nullptr);
}

}  // namespace
