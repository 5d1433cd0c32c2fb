#include "server/streams/flood_guard.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace semblante::streams {
namespace {

using std::chrono::milliseconds;
using Verdict = FloodGuard::Verdict;
using ::testing::HasSubstr;

const FloodGuard::Clock::time_point begin{};

TEST(FloodGuard, Burst_ThenTheRate) {
  FloodGuard guard({100, 200, milliseconds(5000)}, begin);
  for (int i = 0; i < 200; ++i) EXPECT_EQ(guard.offer(1, begin), Verdict::take);
  EXPECT_EQ(guard.offer(1, begin), Verdict::drop_and_say);
  EXPECT_EQ(guard.offer(1, begin + milliseconds(10)), Verdict::take) << "a hundredth of a second has room for one";
  EXPECT_EQ(guard.offer(1, begin + milliseconds(10)), Verdict::drop);
}

TEST(FloodGuard, TenThousandMessagesASecond_AreAnsweredOnceASecondAndClosedInTheEnd) {
  FloodGuard guard({500, 2000, milliseconds(10'000)}, begin);
  int said = 0;
  int taken = 0;
  int closed_at = -1;
  for (int i = 0; closed_at < 0 && i < 200'000; ++i) {  // ten a millisecond
    const auto verdict = guard.offer(1, begin + milliseconds(i / 10));
    if (verdict == Verdict::take) ++taken;
    if (verdict == Verdict::drop_and_say) {
      ++said;
      const auto words = guard.words();
      EXPECT_THAT(words, HasSubstr("more than 500 frames per second, or 2000 at once"));
      if (said > 1) {
        EXPECT_THAT(words, HasSubstr(": 9"));  // of 10,000, about 500 had room
      }
    }
    if (verdict == Verdict::close) closed_at = i / 10;
  }
  EXPECT_GE(said, 9);
  EXPECT_LE(said, 11);
  EXPECT_NEAR(closed_at, 10'210, 30) << "the burst has room for the first 2000";
  EXPECT_NEAR(taken, 2000 + 500 * 10.2, 20);
}

TEST(FloodGuard, Pause_EndsAFlood) {
  FloodGuard guard({10, 10, milliseconds(3000)}, begin);
  for (int second = 0; second < 20; ++second) {
    // Too much at once, every three seconds: left out each time, but never closed.
    const auto now = begin + milliseconds(3000 * second);
    EXPECT_EQ(guard.offer(10, now), Verdict::take) << second;
    EXPECT_EQ(guard.offer(10, now), Verdict::drop_and_say) << second;
    EXPECT_EQ(guard.offer(10, now + milliseconds(500)), Verdict::drop) << second;
  }
}

}  // namespace
}  // namespace semblante::streams
