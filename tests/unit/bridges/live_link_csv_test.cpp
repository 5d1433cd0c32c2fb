#include "core/bridges/live_link_csv.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/tables/mpeg4.h"

namespace semblante {
namespace {

// As the app writes it, cut short. JawRight stands before JawLeft.
const std::string small_take =
    "Timecode,BlendShapeCount,EyeBlinkLeft,JawRight,JawLeft,JawOpen,HeadYaw,HeadPitch,LeftEyeYaw,RightEyeRoll\r\n"
    "00:32:09:58.500,61,0.0491091609,0.1000000000,0.2000000000,0.0897284821,0.25,-0.5,-0.0278781932,0.0056871092\r\n"
    "00:32:10:00.500,61,0.1,0,0,1,0,0,0,0\r\n";

TEST(LiveLinkCsv, ATake_IsReadByTheNamesOfItsColumns) {
  const auto take = read_live_link_csv(small_take);
  ASSERT_TRUE(take) << take.error().message;
  ASSERT_EQ(take->rows.size(), 2U);
  const LiveLinkRow& row = take->rows[0];
  EXPECT_EQ(row.seconds, 0.0);
  EXPECT_FLOAT_EQ(row.coefficients[find_arkit("eyeBlinkLeft").value()], 0.0491091609F);
  EXPECT_FLOAT_EQ(row.coefficients[find_arkit("jawLeft").value()], 0.2F);
  EXPECT_FLOAT_EQ(row.coefficients[find_arkit("jawRight").value()], 0.1F);
  EXPECT_FLOAT_EQ(row.coefficients[find_arkit("jawOpen").value()], 0.0897284821F);
  EXPECT_FLOAT_EQ(row.head.yaw, 0.25F);
  EXPECT_FLOAT_EQ(row.head.pitch, -0.5F);
  EXPECT_FLOAT_EQ(row.left_eye.yaw, -0.0278781932F);
  // 58.5 to 60.5 sixtieths of a second.
  EXPECT_NEAR(take->rows[1].seconds, 2.0 / 60.0, 1e-9);
  ASSERT_EQ(take->warnings.size(), 1U);  // 48 columns are not there
}

TEST(LiveLinkCsv, WrittenAndReadBack_IsTheSame) {
  std::vector<LiveLinkRow> rows(3);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    rows[r].seconds = 3599.0 + 0.7 * static_cast<double>(r) - (r == 0 ? 0.0 : 0.05);
    for (std::size_t s = 0; s < arkit_count; ++s) rows[r].coefficients[s] = 0.01F * static_cast<float>(s + r);
    rows[r].head = {0.1F, -0.2F, 0.3F};
    rows[r].left_eye = {-0.05F, 0.15F};
    rows[r].right_eye = {0.05F, 0.16F};
  }
  const std::string text = write_live_link_csv(rows);
  EXPECT_TRUE(text.starts_with("Timecode,BlendShapeCount,EyeBlinkLeft,EyeLookDownLeft,"));
  EXPECT_NE(text.find(",JawForward,JawRight,JawLeft,JawOpen,"), std::string::npos);
  EXPECT_NE(text.find(",MouthPucker,MouthRight,MouthLeft,MouthSmileLeft,"), std::string::npos);
  EXPECT_NE(text.find(",TongueOut,HeadYaw,HeadPitch,HeadRoll,LeftEyeYaw,"), std::string::npos);
  EXPECT_NE(text.find("\n00:59:59:00.000,61,"), std::string::npos);
  const auto take = read_live_link_csv(text);
  ASSERT_TRUE(take) << take.error().message;
  EXPECT_TRUE(take->warnings.empty());
  ASSERT_EQ(take->rows.size(), rows.size());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    EXPECT_NEAR(take->rows[r].seconds, rows[r].seconds - rows[0].seconds, 1e-4);
    for (std::size_t s = 0; s < arkit_count; ++s) {
      EXPECT_NEAR(take->rows[r].coefficients[s], rows[r].coefficients[s], 1e-7F);
    }
    EXPECT_NEAR(take->rows[r].head.roll, 0.3F, 1e-7F);
    EXPECT_NEAR(take->rows[r].right_eye.pitch, 0.16F, 1e-7F);
  }
}

TEST(LiveLinkCsv, PastMidnight_TimeGoesOn) {
  const auto take = read_live_link_csv("Timecode,JawOpen\n23:59:59:59,0\n00:00:00:01,0\n");
  ASSERT_TRUE(take);
  EXPECT_NEAR(take->rows[1].seconds, 2.0 / 60.0, 1e-9);
}

TEST(LiveLinkCsv, NoFaceInSight_RepeatsTheRowBefore) {
  const auto take = read_live_link_csv("Timecode,BlendShapeCount,JawOpen\n00:00:00:01,61,0.5\n00:00:00:02,0\n");
  ASSERT_TRUE(take) << take.error().message;
  EXPECT_EQ(take->rows[1].coefficients, take->rows[0].coefficients);
}

TEST(LiveLinkCsv, Malformed_IsRefusedWithItsLine) {
  struct Case {
    const char* text;
    const char* where;
    ErrorCode code;
  };
  const std::vector<Case> cases = {
      {"", "line 1", ErrorCode::malformed},
      {"JawOpen\n0\n", "line 1", ErrorCode::malformed},
      {"Timecode,Speed\n00:00:00:00,1\n", "line 1", ErrorCode::malformed},
      {"Timecode,JawOpen,JawOpen\n00:00:00:00,1,1\n", "line 1", ErrorCode::malformed},
      {"Timecode,JawOpen\n", "", ErrorCode::empty},
      {"Timecode,JawOpen\n00:00:00:00\n", "line 2", ErrorCode::truncated},
      {"Timecode,JawOpen\n00:00:00:00,1,2\n", "line 2", ErrorCode::malformed},
      {"Timecode,JawOpen\n00:00:00:00,1\n\n00:00:00:01,much\n", "line 4", ErrorCode::malformed},
      {"Timecode,JawOpen\n00:00:00:00,\n", "line 2", ErrorCode::malformed},
      {"Timecode,JawOpen\n00:00:00:00,nan\n", "line 2", ErrorCode::not_finite},
      {"Timecode,JawOpen\n00:00:00:00,inf\n", "line 2", ErrorCode::not_finite},
      {"Timecode,JawOpen\n00:00:00,1\n", "line 2", ErrorCode::malformed},
      {"Timecode,JawOpen\n00:00:00:60,1\n", "line 2", ErrorCode::malformed},
      {"Timecode,JawOpen\n00:61:00:00,1\n", "line 2", ErrorCode::malformed},
      {"Timecode,JawOpen\n-1:00:00:00,1\n", "line 2", ErrorCode::malformed},
      {"Timecode,JawOpen\n00:00:00:nan,1\n", "line 2", ErrorCode::malformed},
      {"Timecode,JawOpen\n00:00:01:00,1\n00:00:00:59,1\n", "line 3", ErrorCode::out_of_range},
  };
  for (const Case& c : cases) {
    const auto refused = read_live_link_csv(c.text);
    ASSERT_FALSE(refused) << c.text;
    EXPECT_EQ(refused.error().where, c.where) << c.text;
    EXPECT_EQ(refused.error().code, c.code) << c.text << refused.error().message;
  }
  EXPECT_EQ(read_live_link_csv("Timecode" + std::string(300, ',')).error().code, ErrorCode::too_large);
}

TEST(LiveLinkCsv, EveryPrefix_IsReadOrRefused) {
  for (std::size_t length = 0; length < small_take.size(); ++length) {
    const auto take = read_live_link_csv(small_take.substr(0, length));
    EXPECT_TRUE(!take || take->rows.size() <= 2U) << length;
  }
}

// FAP 49 turns to the face's left, 48 down, 50 towards the right shoulder.
TEST(HeadTurn, SetsTheFapsOfTheHeadAndReadsThemBack) {
  semblante_frame frame{};
  turn_head(frame, {0.5F, 0.25F, -0.125F});
  EXPECT_NEAR(frame.fap[49], -50000.0F, 0.01F);
  EXPECT_NEAR(frame.fap[48], 25000.0F, 0.01F);
  EXPECT_NEAR(frame.fap[50], -12500.0F, 0.01F);
  EXPECT_NEAR(head_turn_of(frame).yaw, 0.5F, 1e-6F);
  EXPECT_NEAR(head_turn_of(frame).roll, -0.125F, 1e-6F);
  turn_head(frame, {100.0F, 0.0F, 0.0F});
  EXPECT_EQ(frame.fap[49], static_cast<float>(mpeg4::fap(49).min()));
}

// In takes of the app an eye's angles are 0.611 rad times (look down - look up), and so for yaw: right is positive.
TEST(EyeTurn, IsWhatTheLookCoefficientsSay) {
  ArkitCoefficients c{};
  c[find_arkit("eyeLookDownLeft").value()] = 0.2114743F;
  c[find_arkit("eyeLookInLeft").value()] = 0.1F;
  const semblante_frame frame = frame_from_arkit(c)->frame;
  EXPECT_NEAR(left_eye_turn_of(frame).pitch, 0.1291916F, 1e-4F);
  EXPECT_NEAR(left_eye_turn_of(frame).yaw, 0.0611F, 1e-4F);
}

}  // namespace
}  // namespace semblante
