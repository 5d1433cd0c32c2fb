#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "clients/gateways/osc/packet.h"
#include "clients/gateways/vmc/receiver.h"
#include "clients/gateways/vmc/sender.h"
#include "clients/gateways/vmc/turn.h"
#include "clients/gateways/vmc/values.h"
#include "core/tables/mpeg4.h"

namespace semblante::vmc {
namespace {

constexpr double degree = 3.14159265358979323846 / 180.0;

float preset(const Values& values, const char* name) { return values.presets[find_vrm_preset(name).value()]; }

semblante_frame frame_of(const Values& values) {
  std::size_t clamped = 0;
  return face_from_values(values, clamped);
}

TEST(VmcTurn, RotationsOfEveryTurn_AreTakenApartAgain) {
  for (double yaw = -170; yaw <= 170; yaw += 34) {
    for (double pitch = -80; pitch <= 80; pitch += 20) {
      for (double roll = -170; roll <= 170; roll += 34) {
        const Turn turn = to_turn(to_rotation({yaw * degree, pitch * degree, roll * degree}));
        EXPECT_NEAR(turn.yaw / degree, yaw, 1e-9);
        EXPECT_NEAR(turn.pitch / degree, pitch, 1e-9);
        EXPECT_NEAR(turn.roll / degree, roll, 1e-9);
      }
    }
  }
}

TEST(VmcTurn, OurAxes_AreThoseOfTheKernel) {
  const glm::dvec3 out(0, 0, 1);
  const glm::dvec3 up(0, 1, 0);
  EXPECT_GT((to_rotation({0.3, 0, 0}) * out).x, 0.2) << "yaw: to the face's left";
  EXPECT_LT((to_rotation({0, 0.3, 0}) * out).y, -0.2) << "pitch: down";
  EXPECT_LT((to_rotation({0, 0, 0.3}) * up).x, -0.2) << "roll: the crown goes to the face's right";
}

TEST(VmcTurn, UnitysAxes_AreOursInAMirror) {
  // A vector turned in Unity and then mirrored is the mirrored vector, turned by the mirrored rotation.
  const glm::dquat unity = glm::normalize(glm::dquat(0.8, 0.1, -0.4, 0.3));
  const auto mirrored = [](const glm::dvec3& v) { return glm::dvec3(-v.x, v.y, v.z); };
  const glm::dvec3 v(0.3, -0.5, 0.7);
  // The formula that turns a vector by a quaternion is the same in left- and right-handed axes.
  const glm::dvec3 one = mirrored(unity * v);
  const glm::dvec3 other = mirror_x(unity) * mirrored(v);
  EXPECT_NEAR(glm::length(one - other), 0.0, 1e-12);
}

TEST(VmcValues, FaceOfBothSides_ComesBackAsItsMirror) {
  for (std::size_t shape = 0; shape < arkit_count; ++shape) {
    Values left;
    Values right;
    left.perfect_sync[shape] = 0.8F;
    right.perfect_sync[arkit_mirror(shape)] = 0.8F;
    left.has_perfect_sync = right.has_perfect_sync = true;
    const semblante_frame a = frame_of(left);
    const semblante_frame b = frame_of(right);
    for (const mpeg4::Fap& fap : mpeg4::faps) {
      if (fap.number < 3) continue;
      EXPECT_NEAR(b.fap[fap.mirror], fap.mirror_sign * a.fap[fap.number], 1e-2F) << arkit_name(shape) << fap.number;
    }
  }
}

TEST(VmcValues, PresetsOfLeftAndRight_AreTheFacesOwn) {
  Values values;
  values.presets[find_vrm_preset("Blink_L").value()] = 1.0F;
  values.presets[find_vrm_preset("LookRight").value()] = 1.0F;
  const semblante_frame frame = frame_of(values);
  EXPECT_GT(frame.fap[19], 500.0F) << "the left upper lid comes down";
  EXPECT_EQ(frame.fap[20], 0.0F);
  EXPECT_LT(frame.fap[23], -50000.0F) << "both eyes to the right: FAPs 23 and 24 are positive to the left";
  EXPECT_LT(frame.fap[24], -50000.0F);
}

TEST(VmcValues, ManyExpressions_TheTwoStrongestAreShown) {
  Values values;
  values.presets[find_vrm_preset("Joy").value()] = 0.2F;
  values.presets[find_vrm_preset("Fun").value()] = 1.0F;  // half joy: 0.7 in all
  values.presets[find_vrm_preset("Angry").value()] = 0.3F;
  values.presets[find_vrm_preset("Sorrow").value()] = 0.9F;
  const semblante_frame frame = frame_of(values);
  EXPECT_EQ(frame.expression1, 2);
  EXPECT_EQ(frame.intensity1, 57);  // 56.7
  EXPECT_EQ(frame.expression2, 1);
  EXPECT_EQ(frame.intensity2, 44);  // 44.1
}

TEST(VmcValues, EyesByBonesAlone_LeaveTheLidsToTheFace) {
  Values values;
  values.eyes[0] = values.eyes[1] = to_rotation({0.0, 20 * degree, 0.0});
  values.eye_bones = true;
  const semblante_frame frame = frame_of(values);
  EXPECT_NEAR(frame.fap[25], 20 * degree * 1e5, 0.1);
  EXPECT_EQ(frame.fap[19], 0.0F) << "the face's own lids follow its gaze";
  EXPECT_EQ(frame.fap[20], 0.0F);
}

TEST(VmcValues, OfAFace_SayExpressionsByPresetsAloneAndTheRestByPerfectSync) {
  semblante_frame frame{};
  frame.expression1 = 1;
  frame.intensity1 = 63;
  frame.expression2 = 4;  // fear has no preset
  frame.intensity2 = 63;
  frame.viseme1 = 10;
  frame.viseme_blend = 63;
  const Values said = values_from_face(frame, true, true);
  EXPECT_EQ(preset(said, "Joy"), 1.0F);
  EXPECT_EQ(preset(said, "Fun"), 0.0F);
  EXPECT_GT(preset(said, "A"), 0.9F);
  const auto smile = find_arkit("mouthSmileLeft").value();
  semblante_frame without = frame;
  without.intensity1 = 0;
  EXPECT_EQ(said.perfect_sync, arkit_from_frame(without));
  EXPECT_LT(said.perfect_sync[smile], 0.3F) << "the smile is said by Joy";
  const Values alone = values_from_face(frame, false, true);
  EXPECT_EQ(alone.perfect_sync, arkit_from_frame(frame));
  EXPECT_EQ(preset(alone, "Joy"), 0.0F);
}

/// Faces as streams have them: low-level FAPs within what faces do, visemes, expressions, head and eyes.
semblante_frame any_face(std::mt19937& random) {
  const auto share = [&random] { return std::uniform_real_distribution<float>(0.0F, 1.0F)(random); };
  ArkitCoefficients coefficients{};
  for (float& c : coefficients) c = share() < 0.7F ? 0.0F : share();
  semblante_frame frame = frame_from_arkit(coefficients)->frame;
  frame.expression1 = static_cast<std::uint8_t>(1 + random() % 6);
  frame.intensity1 = static_cast<std::uint8_t>(random() % 64);
  for (const std::size_t n : {23U, 24U, 25U, 26U, 48U, 49U, 50U}) frame.fap[n] = (share() - 0.5F) * 60000.0F;
  return frame;
}

TEST(VmcSenderAndReceiver, FacesSentAndReceived_AreThoseOfTheValuesSaid) {
  std::mt19937 random(7);
  Receiver receiver;
  for (int i = 0; i < 50; ++i) {
    const semblante_frame frame = any_face(random);
    const auto packets = packets_of(frame, 0.25 * i, {});
    ASSERT_GE(packets.size(), 2U);
    std::optional<ReceivedFace> face;
    for (std::size_t p = 0; p < packets.size(); ++p) {
      ASSERT_LE(packets[p].size(), max_sent_bytes);
      const auto taken = receiver.take(packets[p], 0.04 * i);
      ASSERT_TRUE(taken) << taken.error().message;
      ASSERT_EQ(taken->has_value(), p + 1 == packets.size()) << "one face a frame, by its last packet";
      face = *taken;
    }
    EXPECT_EQ(face->time, 0.25 * i);
    EXPECT_EQ(face->clamped, 0U);
    EXPECT_EQ(receiver.skipped(), 0U);
    // What is lost is what the reading of a face in ARKit's terms loses; VMC itself loses nothing.
    const semblante_frame expected = frame_of(values_from_face(frame, true, true));
    for (std::size_t n = 3; n <= SEMBLANTE_FAP_COUNT; ++n) {
      EXPECT_NEAR(face->frame.fap[n], expected.fap[n], 0.1F) << n;
    }
    for (const std::size_t n : {23U, 24U, 25U, 26U, 48U, 49U, 50U}) {
      EXPECT_NEAR(face->frame.fap[n], frame.fap[n], 0.1F) << n;
    }
    EXPECT_EQ(face->frame.viseme1, expected.viseme1);
    EXPECT_NEAR(face->frame.viseme_blend, expected.viseme_blend, 1);
    const bool has_preset = frame.expression1 <= 3 || frame.expression1 == 6;
    EXPECT_EQ(face->frame.intensity1, has_preset ? frame.intensity1 : 0);
    if (has_preset && frame.intensity1 > 0) {
      EXPECT_EQ(face->frame.expression1, frame.expression1);
    }
  }
}

TEST(VmcSender, Options_ChooseWhatIsSaid) {
  semblante_frame frame{};
  frame.fap[49] = 20000.0F;
  const auto names = [&frame](const SenderOptions& options) {
    std::vector<std::string> said;
    for (const auto& bytes : packets_of(frame, 1.0, options)) {
      const auto packet = osc::read_packet(bytes);
      EXPECT_TRUE(packet);
      for (const auto& message : packet->messages) {
        said.emplace_back(message.address);
        if (!message.arguments.empty() && std::holds_alternative<std::string_view>(message.arguments[0])) {
          said.back().append(1, ' ').append(std::get<std::string_view>(message.arguments[0]));
        }
      }
    }
    return said;
  };
  const auto all = names({true, true, true, true});
  EXPECT_EQ(all.size(), 2 + 4 + 52 + 2 * vrm_presets().size() + 1);
  EXPECT_EQ(all.front(), "/VMC/Ext/OK");
  EXPECT_EQ(all[1], "/VMC/Ext/T");
  EXPECT_EQ(all.back(), "/VMC/Ext/Blend/Apply");
  EXPECT_EQ(names({false, true, false, false}).size(), 2 + vrm_presets().size() + 1);
  const auto few = names({false, false, true, true});
  EXPECT_NE(std::find(few.begin(), few.end(), "/VMC/Ext/Blend/Val blinkLeft"), few.end());
  EXPECT_EQ(std::find(few.begin(), few.end(), "/VMC/Ext/Blend/Val Blink_L"), few.end());
  EXPECT_NE(std::find(few.begin(), few.end(), "/VMC/Ext/Bone/Pos LeftEye"), few.end());
}

}  // namespace
}  // namespace semblante::vmc
