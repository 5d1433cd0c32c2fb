#include "server/log/log.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <sched.h>
#include <stdexcept>
#include <thread>
#include <unistd.h>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <sys/syscall.h>

#include "server/log/periodic.h"
#include "server/log/thread_rank.h"

namespace semblante::log {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::Not;

class LogTest : public ::testing::Test {
 protected:
  ~LogTest() override {
    set_format(Format::text);
    set_level(Level::info);
  }
  template <class Work>
  static std::string lines_of(Work work) {
    ::testing::internal::CaptureStderr();
    work();
    return ::testing::internal::GetCapturedStderr();
  }
};

TEST_F(LogTest, Text_HasTimeLevelAndMessage_AndWhatItIsAbout) {
  EXPECT_THAT(lines_of([] { info("hello"); }), MatchesRegex("20..-..-..T..:..:..Z info hello\n"));
  EXPECT_EQ(lines_of([] { debug("hello"); }), "");
  EXPECT_THAT(lines_of([] {
                const Scope request({.request = "r1"});
                const Scope job({.job = "j1"});
                error("hello");
              }),
              EndsWith(" error hello [request r1] [job j1]\n"));
}

TEST_F(LogTest, Scope_EndsWithItsObject_AndIsOfItsThread) {
  const auto lines = lines_of([] {
    {
      const Scope outer({.request = "outer"});
      {
        const Scope inner({.request = "inner"});
        info("one");
        std::thread([] { info("elsewhere"); }).join();
      }
      info("two");
    }
    info("three");
  });
  EXPECT_THAT(lines, HasSubstr("one [request inner]\n"));
  EXPECT_THAT(lines, HasSubstr("elsewhere\n"));
  EXPECT_THAT(lines, HasSubstr("two [request outer]\n"));
  EXPECT_THAT(lines, EndsWith("three\n"));
}

TEST_F(LogTest, Json_IsOneObjectPerLine_WhateverTheMessage) {
  set_format(Format::json);
  const std::string hostile = "a \"quote\", a \\, a\nline, \x1b[31m, \xff\xfe and é";
  const auto line = lines_of([&] {
    const Scope scope({.request = "r1", .job = "j1"});
    warning(hostile);
  });
  EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1);
  const auto json = nlohmann::json::parse(line);
  EXPECT_THAT(std::string(json["time"]), MatchesRegex("20..-..-..T..:..:..Z"));
  EXPECT_EQ(json["level"], "warning");
  EXPECT_THAT(std::string(json["message"]), HasSubstr("a \"quote\", a \\, a?line, ?[31m"));
  EXPECT_THAT(std::string(json["message"]), HasSubstr("é"));
  EXPECT_EQ(json["request"], "r1");
  EXPECT_EQ(json["job"], "j1");
  EXPECT_THAT(lines_of([] { info("plain"); }), Not(HasSubstr("request")));
}

TEST_F(LogTest, Names_AreThoseOfTheOptions) {
  EXPECT_EQ(parse_level("warning"), Level::warning);
  EXPECT_EQ(parse_level("loud"), std::nullopt);
  EXPECT_EQ(parse_format("json"), Format::json);
  EXPECT_EQ(parse_format("xml"), std::nullopt);
}

TEST(ThreadRank, IsOfTheThread_AndRelativeToTheProcess) {
  const auto own = [] { return ::getpriority(PRIO_PROCESS, static_cast<id_t>(::gettid())); };
  const int before = own();
  for (const auto& [rank, behind] : {std::pair{ThreadRank::live, 0},
                                     {ThreadRank::requests, 10},
                                     {ThreadRank::jobs, 15},
                                     {ThreadRank::handshakes, 19}})
    std::thread([rank = rank, behind = behind, before, own] {
      set_thread_rank(rank);
      EXPECT_EQ(own(), std::min(before + behind, 19));
      EXPECT_EQ(::sched_getscheduler(0), SCHED_BATCH);
    }).join();
  EXPECT_EQ(own(), before);
}

TEST(ThreadRank, HandshakesHaveShortTurns_WhereLinuxHasThem) {
  struct {
    std::uint32_t size = 48, policy = 0;
    std::uint64_t flags = 0;
    std::int32_t nice = 0;
    std::uint32_t priority = 0;
    std::uint64_t runtime = 0, deadline = 0, period = 0;
  } attributes;
  std::thread([&attributes] {
    set_thread_rank(ThreadRank::handshakes);
    ASSERT_EQ(::syscall(SYS_sched_getattr, 0, &attributes, sizeof attributes, 0U), 0);
  }).join();
  if (attributes.runtime == 0) GTEST_SKIP() << "this Linux gives all threads turns of the same length";
  EXPECT_EQ(attributes.runtime, 100'000U);
}

TEST(Periodic, WorksOncePerInterval_AFaultEndsOneTurn_AndItsEndIsPrompt) {
  std::atomic<int> turns = 0;
  const auto lines = [&] {
    ::testing::internal::CaptureStderr();
    const Periodic often("counting", std::chrono::milliseconds(1), [&](const std::stop_token&) {
      if (++turns == 2) throw std::runtime_error("a fault");
    });
    while (turns < 5) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return ::testing::internal::GetCapturedStderr();
  }();
  EXPECT_THAT(lines, HasSubstr("counting: a fault"));
  const auto begin = std::chrono::steady_clock::now();
  {
    std::atomic<int> first = 0;
    const Periodic rare(
        "once", std::chrono::hours(1), [&](const std::stop_token&) { ++first; }, Periodic::First::at_once);
    const Periodic later("never", std::chrono::hours(1), [&](const std::stop_token&) { turns = -1; });
    while (first == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_GT(turns, 0);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::minutes(1));
}

}  // namespace
}  // namespace semblante::log
