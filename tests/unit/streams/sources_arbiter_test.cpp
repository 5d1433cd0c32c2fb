// Who may feed a stream, and when its frames are: the state machine alone, in a time of the tests' own.

#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/streams/source_arbiter.h"
#include "tests/unit/streams/feeding.h"

namespace semblante::streams {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;

bool holds(Source source) { return source != Source::request && source != Source::demo; }

class Arbiter : public ::testing::Test {
 protected:
  using Clock = SourceArbiter::Clock;
  using Ticket = SourceArbiter::Ticket;

  /// One frame, or several `spacing` ms apart. Its media time, or nothing when it was refused.
  std::optional<std::uint64_t> send(Source source, Ticket ticket, std::uint64_t clock = 0, std::uint32_t spacing = 0,
                                    std::size_t count = 1) {
    if (source == Source::demo) return arbiter_.place_filling(now_, now_);
    if (holds(source) && source != Source::connection) return arbiter_.place_played(ticket, now_, now_);
    frames_.assign(count, TimedFrame{});
    for (std::size_t i = 0; i < count; ++i) frames_[i].time = static_cast<std::uint32_t>(i) * spacing;
    const auto placement = source == Source::request ? arbiter_.place_request(frames_, now_)
                                                     : arbiter_.place_published(ticket, clock, frames_, now_);
    if (const auto* refusal = std::get_if<SourceArbiter::Refusal>(&placement)) {
      refusal_ = *refusal;
      return std::nullopt;
    }
    return std::get<std::uint64_t>(placement);
  }
  Ticket claim(Source source, bool take_over = false) {
    const auto claim = arbiter_.claim(source, 50.0, take_over, now_);
    return claim ? claim->ticket : 0;
  }

  Clock::time_point began_ = Clock::time_point(hours(1));
  Clock::time_point now_ = began_;
  SourceArbiter arbiter_{true, FloodLimits{}, seconds(3), began_};
  std::vector<TimedFrame> frames_;  ///< the last that were sent, with the times they got
  SourceArbiter::Refusal refusal_;
};

class ArbiterPairs : public Arbiter, public ::testing::WithParamInterface<std::tuple<Source, Source, bool>> {};

TEST_P(ArbiterPairs, SecondIsRefusedOrTakesOver) {
  const auto [first, second, take_over] = GetParam();
  const auto first_ticket = holds(first) ? claim(first) : 0;
  ASSERT_TRUE(send(first, first_ticket, 90'000'000));
  EXPECT_EQ(arbiter_.active(now_), first);
  now_ += seconds(1);

  Ticket second_ticket = 0;
  if (holds(second)) {
    const auto claim = arbiter_.claim(second, 50.0, take_over, now_);
    ASSERT_EQ(claim.ok(), !holds(first) || take_over);
    if (claim) {
      second_ticket = claim->ticket;
      EXPECT_NE(second_ticket, first_ticket);
      EXPECT_EQ(claim->replaces_publisher, first == Source::connection);
    } else {
      EXPECT_EQ(claim.error().code, ErrorCode::mismatch);
    }
  }
  // Requests and the filling come in only while nobody holds the stream; the filling also waits for the silence of all
  // others, of which the first is one unless it is the filling itself.
  const bool enters = holds(second)            ? second_ticket != 0
                      : second == Source::demo ? first == Source::demo
                                               : !holds(first);
  EXPECT_EQ(send(second, second_ticket, 5).has_value(), enters);
  EXPECT_EQ(arbiter_.active(now_), enters ? second : first);

  const bool replaced = holds(first) && second_ticket != 0;
  if (holds(first)) {
    EXPECT_EQ(send(first, first_ticket, 90'000'040).has_value(), !replaced);
    EXPECT_EQ(arbiter_.release(first_ticket, now_), !replaced) << "who was replaced has nothing to give up";
  }
  EXPECT_EQ(arbiter_.is_held_by(second), second_ticket != 0 && holds(second));
}

INSTANTIATE_TEST_SUITE_P(Every, ArbiterPairs,
                         ::testing::Combine(::testing::ValuesIn(all_sources), ::testing::ValuesIn(all_sources),
                                            ::testing::Bool()));

TEST_F(Arbiter, RefusedRequest_IsToldWhoHoldsTheStream) {
  const auto publisher = claim(Source::connection);
  EXPECT_FALSE(send(Source::request, 0));
  EXPECT_EQ(refusal_.error.code, ErrorCode::mismatch);
  EXPECT_FALSE(refusal_.flood);
  EXPECT_THAT(refusal_.error.message, HasSubstr("a connection publishes"));
  arbiter_.release(publisher, now_);
  claim(Source::recording);
  EXPECT_FALSE(send(Source::request, 0));
  EXPECT_THAT(refusal_.error.message, HasSubstr("a recording plays"));
}

TEST_F(Arbiter, Tickets_OfEarlierHolds_NeverFitAgain) {
  const auto first = claim(Source::connection);
  EXPECT_TRUE(arbiter_.release(first, now_));
  EXPECT_FALSE(arbiter_.release(first, now_));
  const auto second = claim(Source::connection);
  EXPECT_FALSE(send(Source::connection, first, 5)) << "neither";
  EXPECT_FALSE(send(Source::connection, 0, 5)) << "nor without one";
  EXPECT_FALSE(send(Source::performance, first));
  EXPECT_TRUE(send(Source::connection, second, 5));
}

TEST_F(Arbiter, Filling_BeginsAtOnce_AndComesBackAfterThreeSecondsOfSilence) {
  EXPECT_TRUE(send(Source::demo, 0)) << "there was no other source yet";
  const auto comes_back_after = [&](milliseconds silence) {
    now_ += silence - milliseconds(1);
    if (send(Source::demo, 0)) return false;
    now_ += milliseconds(1);
    return send(Source::demo, 0).has_value();
  };
  ASSERT_TRUE(send(Source::request, 0));
  EXPECT_EQ(arbiter_.active(now_), Source::request);
  EXPECT_TRUE(comes_back_after(seconds(3)));
  EXPECT_EQ(arbiter_.active(now_), Source::demo);

  // A publisher's silence begins with its last frame, not with its end.
  auto ticket = claim(Source::connection);
  ASSERT_TRUE(send(Source::connection, ticket, 1));
  now_ += seconds(2);
  arbiter_.release(ticket, now_);
  EXPECT_TRUE(comes_back_after(seconds(1)));

  // What plays is heard until its end.
  ticket = claim(Source::fap);
  ASSERT_TRUE(send(Source::fap, ticket));
  now_ += seconds(20);
  EXPECT_FALSE(send(Source::demo, 0)) << "it holds the stream, however long it says nothing";
  arbiter_.release(ticket, now_);
  EXPECT_TRUE(comes_back_after(seconds(3)));
}

TEST_F(Arbiter, WithoutFilling_NobodyIsActiveInTheEnd) {
  SourceArbiter bare(false, FloodLimits{}, seconds(3), began_);
  EXPECT_FALSE(bare.active(now_));
  EXPECT_EQ(bare.rate(), 0.0);
  frames_.assign(1, TimedFrame{});
  ASSERT_TRUE(std::holds_alternative<std::uint64_t>(bare.place_request(frames_, now_)));
  EXPECT_EQ(bare.active(now_ + milliseconds(2999)), Source::request);
  EXPECT_FALSE(bare.active(now_ + seconds(3)));
}

TEST_F(Arbiter, Rate_IsThatOfWhatFeeds) {
  EXPECT_EQ(arbiter_.rate(), 25.0) << "the filling's";
  const auto ticket = claim(Source::performance);
  EXPECT_EQ(arbiter_.rate(), 50.0);
  arbiter_.release(ticket, now_);
  EXPECT_EQ(arbiter_.rate(), 25.0);
}

TEST_F(Arbiter, MediaTime_IsTheStreamsClock) {
  now_ += milliseconds(1500);
  EXPECT_EQ(send(Source::request, 0), 1500U);
  now_ += milliseconds(500);
  const auto ticket = claim(Source::connection);
  EXPECT_EQ(send(Source::connection, ticket, 777'000), 2000U) << "a publisher's clock begins now";
  now_ += milliseconds(10);
  EXPECT_EQ(send(Source::connection, ticket, 777'040), 2040U) << "and keeps its own spacing";
  arbiter_.release(ticket, now_);
  now_ += milliseconds(100);
  const auto other = claim(Source::connection);
  EXPECT_EQ(send(Source::connection, other, 777'500), 2110U) << "the next one has another clock, be it much alike";
  EXPECT_EQ(send(Source::connection, other, 0), 2110U) << "without a clock: now";
}

TEST_F(Arbiter, NewestFrameTime_IsThatOfFramesSentInAdvance) {
  const auto ticket = claim(Source::connection);
  ASSERT_TRUE(send(Source::connection, ticket, 1000, 1000, 10));
  EXPECT_EQ(arbiter_.newest_frame_time(), began_ + seconds(9));
  for (const auto source : {Source::performance, Source::connection, Source::recording}) {
    const auto next = claim(source, true);
    EXPECT_EQ(send(source, next, 77), 9000U) << "a new source's frames wait for it";
  }
}

TEST_F(Arbiter, RefusedFrames_ChangeNothing) {
  EXPECT_FALSE(send(Source::request, 0, 0, 10'001, 2));
  EXPECT_EQ(refusal_.error.code, ErrorCode::out_of_range);
  EXPECT_EQ(refusal_.error.where, "/frames/1/time");
  EXPECT_EQ(arbiter_.active(now_), Source::demo) << "it was not heard";
  EXPECT_EQ(arbiter_.newest_frame_time(), began_);
  ASSERT_TRUE(send(Source::request, 0, 0, 9000, 2));
  EXPECT_FALSE(send(Source::request, 0, 0, 2000, 2)) << "they would end 11 s ahead";
  EXPECT_EQ(refusal_.error.code, ErrorCode::too_large);
  EXPECT_FALSE(refusal_.flood) << "it is no flood";
  EXPECT_EQ(arbiter_.newest_frame_time(), began_ + seconds(9));
}

TEST_F(Arbiter, FloodOfAPublisher_IsSaidOnceASecond_ThenItIsDismissed) {
  arbiter_ = SourceArbiter(true, {.frames_per_second = 0, .frames_burst = 10, .flood = seconds(5)}, seconds(3), began_);
  const auto ticket = claim(Source::connection);
  ASSERT_TRUE(send(Source::connection, ticket, 1, 0, 10));
  int said = 0;
  while (!send(Source::connection, ticket, 1) && refusal_.flood != FloodGuard::Verdict::close) {
    ASSERT_LT(now_, began_ + seconds(10));
    ASSERT_TRUE(refusal_.flood);
    EXPECT_EQ(refusal_.error.message.empty(), refusal_.flood == FloodGuard::Verdict::drop);
    said += refusal_.flood == FloodGuard::Verdict::drop_and_say ? 1 : 0;
    now_ += milliseconds(100);
  }
  EXPECT_EQ(said, 5);
  EXPECT_EQ(now_, began_ + seconds(5));
  EXPECT_FALSE(arbiter_.is_held_by(Source::connection)) << "its place is free";
  EXPECT_FALSE(send(Source::connection, ticket, 1));
  EXPECT_EQ(refusal_.error.code, ErrorCode::mismatch);
  EXPECT_FALSE(send(Source::demo, 0)) << "it was heard until now, even if nothing was taken";
  const auto next = claim(Source::connection);
  EXPECT_TRUE(send(Source::connection, next, 1, 0, 10)) << "each publisher has a guard of its own";
}

TEST_F(Arbiter, Requests_ShareOneGuard_AndAreToldEveryTime) {
  arbiter_ = SourceArbiter(true, {.frames_per_second = 2, .frames_burst = 4, .flood = seconds(0)}, seconds(3), began_);
  ASSERT_TRUE(send(Source::request, 0, 0, 0, 4));
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(send(Source::request, 0));
    EXPECT_EQ(refusal_.error.code, ErrorCode::too_large);
    EXPECT_TRUE(refusal_.flood);
    EXPECT_THAT(refusal_.error.message, HasSubstr("more than 2 frames per second"));
  }
  now_ += seconds(1);
  EXPECT_TRUE(send(Source::request, 0, 0, 0, 2));
}

/// Any mix of sources that begin, take over, send and go, with clocks of any kind.
TEST_F(Arbiter, RandomEvents_MediaTimeNeverFalls_AndOneSourceFeeds) {
  std::size_t taken = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    const auto below = [&](std::uint64_t n) { return random() % n; };
    SourceArbiter fresh(true, {.frames_per_second = 1'000'000, .frames_burst = 1'000'000}, seconds(3), began_);
    arbiter_ = fresh;
    now_ = began_;
    std::vector<std::pair<Source, Ticket>> feeders;
    std::uint64_t newest = 0;
    Ticket holder = 0;
    for (int step = 0; step < 200; ++step) {
      now_ += milliseconds(below(5) == 0 ? below(4000) : below(50));
      if (feeders.empty() || below(5) == 0) {
        const auto source = all_sources[below(all_sources.size())];
        const auto ticket = holds(source) ? claim(source, below(2) == 0) : 0;
        if (ticket != 0) holder = ticket;
        feeders.emplace_back(source, ticket);
        continue;
      }
      const auto chosen = below(feeders.size());
      const auto [source, ticket] = feeders[chosen];
      if (below(10) == 0) {
        EXPECT_EQ(arbiter_.release(ticket, now_), ticket != 0 && ticket == holder);
        if (ticket == holder) holder = 0;
        continue;
      }
      const std::uint64_t clock = below(3) == 0 ? 0 : below(3) == 0 ? below(1ULL << 52U) : 1'000'000 + below(20'000);
      const auto at = send(source, ticket, clock, static_cast<std::uint32_t>(below(4) == 0 ? below(3000) : below(50)),
                           1 + below(4));
      if (!at) {
        if (below(2) == 0) feeders.erase(feeders.begin() + static_cast<std::ptrdiff_t>(chosen));
        continue;
      }
      ++taken;
      EXPECT_EQ(ticket, holder) << "only the holder feeds, or anyone without a ticket when there is none";
      EXPECT_GE(*at, newest);
      newest = *at;
      if (source == Source::connection || source == Source::request) {
        for (const auto& frame : frames_) {
          EXPECT_GE(*at + frame.time, newest);
          newest = *at + frame.time;
        }
      }
      EXPECT_EQ(arbiter_.newest_frame_time(), began_ + milliseconds(newest));
      EXPECT_LE(newest, media_time_at(began_, now_) + most_ahead);
      if (HasFailure()) FAIL() << "seed " << seed << " step " << step;
    }
  }
  EXPECT_GT(taken, 5000U);
}

}  // namespace
}  // namespace semblante::streams
