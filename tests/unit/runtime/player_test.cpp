#include <cmath>
#include <cstring>
#include <limits>
#include <memory>

#include <gmock/gmock.h>

#include "tests/unit/runtime/owned.h"
#include "tests/unit/runtime/scripted_server.h"
#include "tests/unit/runtime/small_package.h"

namespace semblante::testing {
namespace {

OwnedPlayer make_player(double delay, bool eased = false, std::uint32_t max_frames = 0) {
  semblante_player_options options{};
  options.size = sizeof(options);
  options.delay = delay;
  options.eased = eased ? 1 : 0;
  options.max_frames = max_frames;
  semblante_player* player = nullptr;
  EXPECT_EQ(semblante_player_create(&options, &player, nullptr), SEMBLANTE_OK);
  return OwnedPlayer(player);
}

OwnedHead make_head(const SmallPackage& small) {
  const semblante_package package = small.view();
  semblante_head* head = nullptr;
  EXPECT_EQ(semblante_head_create(&package, nullptr, &head, nullptr), SEMBLANTE_OK);
  return OwnedHead(head);
}

/// Height of vertex 0, which FAP 3 lowers by 0.01 a unit.
float chin_of(const OwnedHead& head) {
  std::array<float, 12> positions{};
  EXPECT_EQ(semblante_head_positions(head.get(), positions.data(), positions.size()), SEMBLANTE_OK);
  return positions[1];
}

semblante_player_statistics stats_of(const OwnedPlayer& player) {
  semblante_player_statistics stats{};
  stats.size = sizeof(stats);
  EXPECT_EQ(semblante_player_stats(player.get(), &stats), SEMBLANTE_OK);
  return stats;
}

TEST(Player, BetweenTwoFrames_ShowsTheShareOfBoth) {
  const SmallPackage small;
  const OwnedPlayer player = make_player(1000);  // so that it begins before the frames
  const OwnedHead head = make_head(small);
  EXPECT_EQ(semblante_player_advance(player.get(), 0, 16), 0U);
  EXPECT_EQ(semblante_player_show(player.get(), head.get()), 0U);
  EXPECT_TRUE(std::isnan(semblante_player_time(player.get())));
  const semblante_timed_frame frames[] = {jaw_at(0, 0), jaw_at(100, 100), jaw_at(200, 100)};
  ASSERT_EQ(semblante_player_push(player.get(), frames, 3, 1000), SEMBLANTE_OK);
  ASSERT_EQ(semblante_player_move_to(player.get(), 25), 1U);
  EXPECT_EQ(semblante_player_show(player.get(), head.get()), 1U);
  EXPECT_NEAR(chin_of(head), -0.25F, 1e-4);
  EXPECT_EQ(semblante_player_show(player.get(), head.get()), 0U) << "it has that pose";
  semblante_timed_frame from{};
  semblante_timed_frame to{};
  float t = 0;
  ASSERT_EQ(semblante_player_between(player.get(), &from, &to, &t), SEMBLANTE_OK);
  EXPECT_EQ(from.time, 0);
  EXPECT_EQ(to.time, 100);
  EXPECT_FLOAT_EQ(t, 0.25F);
  EXPECT_EQ(to.frame.fap[3], 100);
  semblante_moment moment{};
  EXPECT_EQ(semblante_player_moment(player.get(), &moment), SEMBLANTE_INVALID_ARGUMENT) << "no size";
  moment.size = sizeof(moment);
  ASSERT_EQ(semblante_player_moment(player.get(), &moment), SEMBLANTE_OK);
  EXPECT_EQ(moment.is_curve, 0U);
  EXPECT_EQ(moment.from_time, 0);
  EXPECT_EQ(moment.to_time, 100);
  EXPECT_FLOAT_EQ(moment.t, 0.25F);
  EXPECT_TRUE(std::isnan(moment.viseme_share));
  EXPECT_EQ(moment.frames[1].fap[3], 0);
  EXPECT_EQ(moment.frames[2].fap[3], 100);

  // A pose set in between is not the player's, so it is set again.
  const semblante_frame neutral{};
  ASSERT_EQ(semblante_head_set_frame(head.get(), &neutral), SEMBLANTE_OK);
  EXPECT_EQ(semblante_player_show(player.get(), head.get()), 1U);
  EXPECT_NEAR(chin_of(head), -0.25F, 1e-4);

  semblante_player_move_to(player.get(), 150);
  EXPECT_EQ(semblante_player_show(player.get(), head.get()), 1U);
  EXPECT_NEAR(chin_of(head), -1, 1e-4);
  semblante_player_move_to(player.get(), 1e6);
  EXPECT_EQ(semblante_player_time(player.get()), 200) << "no farther than the frames";
}

TEST(Player, AfterAnExternalClock_GoesOnWhereItWas) {
  const OwnedPlayer player = make_player(2000);
  std::vector<semblante_timed_frame> frames;
  for (int i = 0; i < 100; ++i) frames.push_back(jaw_at(40.0 * i, 0));
  ASSERT_EQ(semblante_player_push(player.get(), frames.data(), 100, 3960), SEMBLANTE_OK);
  double now = 3960;
  EXPECT_EQ(semblante_player_advance(player.get(), now, 16), 1U);
  for (; now < 4960; now += 16) semblante_player_move_to(player.get(), now - 2000);
  semblante_player_advance(player.get(), now, 16);
  EXPECT_NEAR(semblante_player_time(player.get()), now - 2000, 1) << "not by the time that was played already";
}

TEST(Player, DelayAdapts_AlsoWhileAnExternalClockMovesIt) {
  const OwnedPlayer player = make_player(0);
  for (int i = 0; i < 1000; ++i) {
    const double time = 40.0 * i;
    const semblante_timed_frame frame = jaw_at(time, 0);
    const double late = i < 100 ? 10 : i % 2 == 0 ? 300 : 280;
    ASSERT_EQ(semblante_player_push(player.get(), &frame, 1, time + late), SEMBLANTE_OK);
    semblante_player_move_to(player.get(), time - 700);  // a sound that is late itself
  }
  semblante_player_statistics stats{};
  stats.size = sizeof(stats);
  ASSERT_EQ(semblante_player_stats(player.get(), &stats), SEMBLANTE_OK);
  EXPECT_GT(stats.wanted_delay, 300);
  EXPECT_NEAR(stats.delay, stats.wanted_delay, 1) << "where the sound begins after its next pause";
}

TEST(Player, OneForSeveralHeads_AndOneHeadAfterAnother) {
  const SmallPackage small;
  const OwnedPlayer player = make_player(100);
  const OwnedHead first = make_head(small);
  const OwnedHead second = make_head(small);
  const semblante_timed_frame frames[] = {jaw_at(0, 0), jaw_at(100, 100)};
  ASSERT_EQ(semblante_player_push(player.get(), frames, 2, 1000), SEMBLANTE_OK);
  semblante_player_move_to(player.get(), 50);
  EXPECT_EQ(semblante_player_show(player.get(), first.get()), 1U);
  EXPECT_EQ(semblante_player_show(player.get(), second.get()), 1U);
  EXPECT_NEAR(chin_of(second), -0.5F, 1e-4);
  // Another player with other frames at the same times: nothing of the first may be left.
  const OwnedPlayer other = make_player(100);
  const semblante_timed_frame mirrored[] = {jaw_at(0, 100), jaw_at(100, 0)};
  ASSERT_EQ(semblante_player_push(other.get(), mirrored, 2, 1000), SEMBLANTE_OK);
  semblante_player_move_to(other.get(), 25);
  EXPECT_EQ(semblante_player_show(other.get(), first.get()), 1U);
  EXPECT_NEAR(chin_of(first), -0.75F, 1e-4);
}

TEST(Player, FollowsAStream_WithItsClockAndItsDelay) {
  const SmallPackage small;
  ScriptedServer server;
  const OwnedPlayer player = make_player(100);
  const OwnedHead head = make_head(small);
  ASSERT_EQ(semblante_player_follow(player.get(), server.stream), SEMBLANTE_OK);
  const semblante_timed_frame frame = jaw_at(0, 0);
  EXPECT_EQ(semblante_player_push(player.get(), &frame, 1, 0), SEMBLANTE_INVALID_ARGUMENT) << "it follows a stream";
  server.begin(1000, 5000);  // media time 5000 is now 1000, and hello was answered at once
  for (std::uint64_t i = 1; i <= 100; ++i) {
    const double now = 1000 + 40 * static_cast<double>(i);
    server.batch(5000 + 40 * i, {{0, face(static_cast<int>(i))}}, now);
    semblante_player_advance(player.get(), now, 40);
    semblante_player_show(player.get(), head.get());
  }
  semblante_clock clock{};
  clock.size = sizeof(clock);
  ASSERT_EQ(semblante_stream_clock(server.stream, 5000, &clock), SEMBLANTE_OK);
  EXPECT_NEAR(semblante_player_time(player.get()), clock.media_time - 100, 0.01);
  EXPECT_NEAR(stats_of(player).delay, 100, 1e-9);
  EXPECT_LE(stats_of(player).held, 5U);
  EXPECT_EQ(stats_of(player).starved, 0U);
  // FAP 3 is 4 units a level and 0.01 a unit; a level is 40 ms.
  EXPECT_NEAR(chin_of(head), -0.04F * (static_cast<float>(semblante_player_time(player.get())) - 5000) / 40, 1e-3);
}

TEST(Player, JoinsAFaceThatRests) {
  const SmallPackage small;
  ScriptedServer server;
  server.begin(1000, 5000);
  server.batch(5040, {{0, face(25)}}, 1040);
  const OwnedPlayer late = make_player(0);
  const OwnedHead head = make_head(small);
  ASSERT_EQ(semblante_player_follow(late.get(), server.stream), SEMBLANTE_OK);
  EXPECT_EQ(semblante_player_advance(late.get(), 9000, 16), 1U);
  semblante_player_show(late.get(), head.get());
  EXPECT_NEAR(chin_of(head), -1, 1e-4);
}

TEST(Player, SeveralOnOneStream_AndEitherMayEndFirst) {
  auto server = std::make_unique<ScriptedServer>();
  OwnedPlayer first = make_player(100);
  const OwnedPlayer second = make_player(100, true);
  ASSERT_EQ(semblante_player_follow(first.get(), server->stream), SEMBLANTE_OK);
  ASSERT_EQ(semblante_player_follow(second.get(), server->stream), SEMBLANTE_OK);
  server->begin(1000, 5000);
  server->batch(5040, {{0, face(1)}, {40, face(2)}}, 1090);
  EXPECT_EQ(stats_of(first).held, 3U);
  EXPECT_EQ(stats_of(second).held, 3U);
  first.reset();
  server->batch(5120, {{0, face(3)}}, 1130);
  EXPECT_EQ(stats_of(second).held, 4U);
  server.reset();
  EXPECT_EQ(semblante_player_advance(second.get(), 1300, 16), 1U) << "what it holds can still be shown";
  const semblante_timed_frame frame = jaw_at(9000, 1);
  EXPECT_EQ(semblante_player_push(second.get(), &frame, 1, 1300), SEMBLANTE_OK) << "it follows nobody now";
}

TEST(Player, VisemeShareOfTheStream_CountsWhileItFollows) {
  SmallPackage small;
  const FeaturePointId lip = *parse_feature_point("8.1");
  small.rig.visemes[1].displacements.push_back({lip, glm::vec3(0, -0.4F, 0)});
  small.seal();
  const OwnedHead head = make_head(small);
  FaceFrame both;
  both.viseme = {1, 0, 63};
  both.expression = {1, 63, 0, 0};
  for (const double share : {0.0, 1.0}) {
    ScriptedServer server;
    const OwnedPlayer player = make_player(100);
    ASSERT_EQ(semblante_player_follow(player.get(), server.stream), SEMBLANTE_OK);
    semblante_stream_start(server.stream, 0);
    server.open(0);
    Header header = ScriptedServer::header(1, 5000);
    header.viseme_share = share;
    server.greet(header, {1, 5000, both}, 0);
    semblante_player_advance(player.get(), 10, 10);
    semblante_player_show(player.get(), head.get());
    semblante_pose pose{};
    ASSERT_EQ(semblante_head_get_pose(head.get(), &pose), SEMBLANTE_OK);
    EXPECT_NEAR(pose.fp[3 * lip.value() + 1], share == 0 ? 0.4F : -0.4F, 1e-6);
    EXPECT_NEAR(semblante_head_rig(head.get())->viseme_share, 0.85F, 1e-6) << "the head keeps its own";
  }
}

TEST(Player, AnotherEpoch_IsAnotherTimeLine) {
  ScriptedServer server;
  const OwnedPlayer player = make_player(100);
  ASSERT_EQ(semblante_player_follow(player.get(), server.stream), SEMBLANTE_OK);
  server.begin(1000, 50'000);
  for (std::uint64_t i = 1; i < 20; ++i)
    server.batch(50'000 + 40 * i, {{0, face(1)}}, 1000 + 40.0 * static_cast<double>(i));
  semblante_player_advance(player.get(), 1700, 16);
  EXPECT_GT(semblante_player_time(player.get()), 50'000);
  semblante_stream_closed(server.stream, 0, 2000);
  semblante_stream_start(server.stream, 2000);
  server.open(2000);
  server.greet(ScriptedServer::header(8, 300), {3, 250, face(9)}, 2010);
  EXPECT_EQ(stats_of(player).held, 1U);
  semblante_player_advance(player.get(), 2010, 16);
  EXPECT_LE(semblante_player_time(player.get()), 250);
}

TEST(Player, NewHeader_KeepsTheMomentUntilTheNextStep) {
  ScriptedServer server;
  const OwnedPlayer player = make_player(100);
  ASSERT_EQ(semblante_player_follow(player.get(), server.stream), SEMBLANTE_OK);
  server.begin(1000, 50'000);
  for (std::uint64_t i = 1; i < 20; ++i)
    server.batch(50'000 + 40 * i, {{0, face(1)}}, 1000 + 40.0 * static_cast<double>(i));
  semblante_player_advance(player.get(), 1700, 16);
  semblante_moment shown{};
  shown.size = sizeof(shown);
  ASSERT_EQ(semblante_player_moment(player.get(), &shown), SEMBLANTE_OK);
  ASSERT_GT(shown.to_time, shown.from_time);
  semblante_stream_closed(server.stream, 0, 2000);
  semblante_stream_start(server.stream, 2000);
  server.open(2000);
  server.greet(ScriptedServer::header(7, 51'000), {40, 51'000, face(9)}, 2010);
  semblante_moment kept{};
  kept.size = sizeof(kept);
  ASSERT_EQ(semblante_player_moment(player.get(), &kept), SEMBLANTE_OK);
  EXPECT_EQ(kept.from_time, shown.from_time);
  EXPECT_EQ(kept.to_time, shown.to_time);
}

TEST(Player, SameEpoch_NeverGoesBackAndLeavesOutWhatItHas) {
  ScriptedServer server;
  const OwnedPlayer player = make_player(100);
  ASSERT_EQ(semblante_player_follow(player.get(), server.stream), SEMBLANTE_OK);
  server.begin(1000, 5000);
  server.batch(5040, {{0, face(1)}, {40, face(2)}}, 1080);
  semblante_stream_closed(server.stream, 0, 1100);
  semblante_stream_start(server.stream, 1100);
  server.open(1100);
  Header header = ScriptedServer::header(7, 5100);
  header.recovered = true;
  server.greet(header, {12, 5080, face(2)}, 1110);
  EXPECT_EQ(stats_of(player).held, 3U);
  server.batch(5120, {{0, face(3)}}, 1120);
  EXPECT_EQ(stats_of(player).held, 4U);
}

TEST(Player, NothingShown_KeepsTheNewestFramesOnly) {
  const OwnedPlayer player = make_player(100, false, 64);
  for (int i = 0; i < 10'000; ++i) {
    const semblante_timed_frame frame = jaw_at(40 * i, static_cast<float>(i % 100));
    ASSERT_EQ(semblante_player_push(player.get(), &frame, 1, 40 * i), SEMBLANTE_OK);
    ASSERT_LE(stats_of(player).held, 64U);
  }
  EXPECT_GE(stats_of(player).held, 32U);
}

TEST(Player, Eased_PassesThroughTheFramesWithoutCorners) {
  const SmallPackage small;
  const OwnedPlayer player = make_player(100, true);
  const OwnedHead head = make_head(small);
  std::vector<semblante_timed_frame> frames;
  for (int i = 0; i <= 8; ++i) {
    frames.push_back(jaw_at(100 * i, static_cast<float>(100 + 100 * std::sin(0.7 * i))));
  }
  ASSERT_EQ(semblante_player_push(player.get(), frames.data(), 9, 0), SEMBLANTE_OK);
  float before = 0;
  float speed_before = 0;
  for (int ms = 0; ms <= 600; ++ms) {
    semblante_player_move_to(player.get(), ms);
    semblante_player_show(player.get(), head.get());
    const float chin = chin_of(head);
    if (ms % 100 == 0) {
      EXPECT_NEAR(chin, -0.01F * frames[static_cast<std::size_t>(ms / 100)].frame.fap[3], 0.01F) << ms;
    }
    const float speed = chin - before;
    if (ms > 2) {
      EXPECT_LT(std::abs(speed - speed_before), 0.0012F) << "a corner at " << ms;
    }
    speed_before = speed;
    before = chin;
  }
}

TEST(Player, Pushed_IsKeptToAnEighthOfTheStandardSteps) {
  const OwnedPlayer player = make_player(100);
  const semblante_timed_frame frames[] = {jaw_at(0, 101.3F), jaw_at(100, 0)};
  ASSERT_EQ(semblante_player_push(player.get(), frames, 2, 0), SEMBLANTE_OK);
  semblante_player_move_to(player.get(), 0);
  semblante_timed_frame from{};
  semblante_timed_frame to{};
  float t = 0;
  ASSERT_EQ(semblante_player_between(player.get(), &from, &to, &t), SEMBLANTE_OK);
  EXPECT_NEAR(from.frame.fap[3], 101.3F, 0.25F);
}

TEST(Player, WrongArguments_AreRefusedOrIgnored) {
  semblante_player* made = nullptr;
  semblante_player_options options{};
  EXPECT_EQ(semblante_player_create(&options, &made, nullptr), SEMBLANTE_INVALID_ARGUMENT) << "no size";
  options.size = sizeof(options);
  options.delay = std::nan("");
  EXPECT_EQ(semblante_player_create(&options, &made, nullptr), SEMBLANTE_INVALID_ARGUMENT);
  const OwnedPlayer player = make_player(0);
  semblante_timed_frame frames[] = {jaw_at(10, 0), jaw_at(5, 0)};
  EXPECT_EQ(semblante_player_push(player.get(), frames, 2, 0), SEMBLANTE_INVALID_ARGUMENT) << "times fall";
  frames[1] = jaw_at(20, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(semblante_player_push(player.get(), frames, 2, 0), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(stats_of(player).held, 0U);
  EXPECT_EQ(semblante_player_advance(player.get(), std::nan(""), 16), 0U);
  EXPECT_EQ(semblante_player_show(nullptr, nullptr), 0U);
  semblante_moment moment{};
  moment.size = sizeof(moment);
  EXPECT_EQ(semblante_player_moment(player.get(), &moment), SEMBLANTE_UNAVAILABLE);
  EXPECT_EQ(semblante_player_moment(nullptr, &moment), SEMBLANTE_INVALID_ARGUMENT);
  semblante_player_destroy(nullptr);
}

}  // namespace
}  // namespace semblante::testing
