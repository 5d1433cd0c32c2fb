#include "server/streams/timeline.h"

#include <random>

#include <gtest/gtest.h>

namespace semblante::streams {
namespace {

std::vector<TimedFrame> frames_at(std::initializer_list<std::uint32_t> times) {
  std::vector<TimedFrame> frames;
  for (const auto time : times) frames.push_back({time, {}});
  return frames;
}

TEST(Timeline, Publisher_KeepsItsSpacingWhenItsMessagesAreLateOrEarly) {
  Timeline timeline;
  std::mt19937 random(7);
  std::uint64_t begin = 0;
  for (std::uint64_t k = 0; k < 200; ++k) {
    auto frames = frames_at({0, 20});
    const auto now = 1000 + 40 * k + random() % 30;
    const auto at = timeline.place_published(now, 500'000 + 40 * k, frames);
    ASSERT_TRUE(at);
    if (k == 0) begin = *at;
    EXPECT_EQ(*at, begin + 40 * k);
    EXPECT_EQ(frames[1].time, 20U);
  }
}

TEST(Timeline, PublisherAheadThenAnother_TimeHoldsUntilItHasBeenReached) {
  Timeline timeline;
  auto ahead = frames_at({0, 5000});
  ASSERT_EQ(*timeline.place_published(1000, 77, ahead), 1000U);
  EXPECT_EQ(timeline.newest(), 6000U);
  timeline.forget_publisher();
  auto next = frames_at({0, 40});
  EXPECT_EQ(*timeline.place_published(2000, 9, next), 6000U) << "not back to 2000, where subscribers have been";
  EXPECT_EQ(next[1].time, 0U);
  auto later = frames_at({0, 40});
  EXPECT_EQ(*timeline.place_published(6500, 4509, later), 6500U) << "and from there on in its own time";
  EXPECT_EQ(later[1].time, 40U);
}

TEST(Timeline, FramesWithoutTime_FollowThoseThatAreAhead) {
  Timeline timeline;
  EXPECT_EQ(*timeline.place_now(1000, frames_at({0, 4000})), 1000U);
  EXPECT_EQ(*timeline.place_now(1500, frames_at({0, 4000})), 5000U) << "with their spacing";
  const auto full = timeline.place_now(1600, frames_at({0, 4000}));
  ASSERT_FALSE(full);
  EXPECT_EQ(full.error().code, ErrorCode::too_large) << "9000 + 4000 is more than 10 s after 1600";
  EXPECT_EQ(timeline.newest(), 9000U) << "nothing of it was taken";
  EXPECT_EQ(*timeline.place_now(3000, frames_at({0, 4000})), 9000U) << "a little later there is room";
}

TEST(Timeline, MessageThatIsTooLong_NamesItsFrame) {
  Timeline timeline;
  auto frames = frames_at({0, 10'000, 10'001});
  EXPECT_EQ(timeline.place_now(0, frames).error().where, "/frames/2/time");
  EXPECT_EQ(timeline.place_published(0, 1, frames).error().where, "/frames/2/time");
  EXPECT_EQ(timeline.newest(), 0U);
}

TEST(Timeline, ClockThatJumps_IsSetAnew_ForwardsOnly) {
  Timeline timeline;
  auto frame = frames_at({0});
  EXPECT_EQ(*timeline.place_published(1000, 50'000, frame), 1000U);
  EXPECT_EQ(*timeline.place_published(1040, 900'000, frame), 1040U) << "far ahead: it begins now";
  EXPECT_EQ(*timeline.place_published(1080, 900'040, frame), 1080U);
  EXPECT_EQ(*timeline.place_published(1120, 3, frame), 1120U) << "far behind: likewise";
  EXPECT_EQ(*timeline.place_published(1160, UINT64_MAX, frame), 1160U);
  EXPECT_EQ(*timeline.place_published(1170, 0, frame), 1170U);
}

/// Whatever sources and clocks there are: time never falls, is never more than most_ahead from now, and frames within a
/// message never fall either.
TEST(Timeline, AnySources_AnyClocks_NeverFalls) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    const auto below = [&](std::uint64_t n) { return random() % n; };
    Timeline timeline;
    std::uint64_t now = 0;
    std::uint64_t before = 0;
    std::uint64_t clock = below(1'000'000);
    for (int step = 0; step < 500; ++step) {
      now += below(10) == 0 ? below(20'000) : below(60);
      std::vector<TimedFrame> frames(1 + below(5));
      std::uint32_t time = 0;
      for (auto& frame : frames)
        frame.time = time += static_cast<std::uint32_t>(below(4) == 0 ? below(6000) : below(50));
      const auto count = frames.size();
      std::uint64_t at = 0;
      bool taken = true;
      switch (below(5)) {
        case 0: {
          const auto placed = timeline.place_now(now, frames);
          taken = placed.ok();
          if (taken) at = *placed;
          break;
        }
        case 1:
          frames.resize(1);
          frames[0].time = 0;
          at = timeline.place_due(now - std::min<std::uint64_t>(now, below(3000)));
          break;
        case 2:
          timeline.forget_publisher();
          clock = below(3) == 0 ? below(UINT64_MAX) : below(1'000'000);
          [[fallthrough]];
        default: {
          clock += below(3000);
          const auto placed = timeline.place_published(now, clock, frames);
          taken = placed.ok();
          if (taken) at = *placed;
        }
      }
      if (!taken) {
        EXPECT_EQ(timeline.newest(), before);
        continue;
      }
      EXPECT_LE(frames.size(), count);
      for (const auto& frame : frames) {
        EXPECT_GE(at + frame.time, before) << "seed " << seed << " step " << step;
        before = at + frame.time;
      }
      EXPECT_EQ(timeline.newest(), before);
      EXPECT_LE(before, now + most_ahead) << "seed " << seed << " step " << step;
      if (::testing::Test::HasFailure()) return;
    }
  }
}

}  // namespace
}  // namespace semblante::streams
