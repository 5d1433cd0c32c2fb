#include "server/api/key_locks.h"

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace semblante::api {
namespace {

using std::chrono::milliseconds;
constexpr milliseconds long_enough = std::chrono::minutes(5);

TEST(KeyLocks, HeldKey_IsNobodyElses_AndOtherKeysAreFree) {
  KeyLocks locks;
  {
    const auto held = locks.acquire("a", long_enough);
    ASSERT_TRUE(held);
    EXPECT_FALSE(locks.acquire("a", milliseconds(1)));
    EXPECT_TRUE(locks.acquire("b", milliseconds(0)));
    EXPECT_EQ(locks.size(), 1U);
  }
  EXPECT_EQ(locks.size(), 0U) << "a key that nobody uses takes no memory";
  EXPECT_TRUE(locks.acquire("a", milliseconds(0)));
}

TEST(KeyLocks, HolderThatThrows_PassesItOn) {
  KeyLocks locks;
  const auto fail = [&] {
    const auto held = locks.acquire("a", long_enough);
    throw std::runtime_error("the creation failed");
  };
  EXPECT_THROW(fail(), std::runtime_error);
  EXPECT_TRUE(locks.acquire("a", milliseconds(0)));
}

TEST(KeyLocks, ManyThreads_HoldItOneAtATime) {
  KeyLocks locks;
  std::atomic<int> inside{0}, most{0};
  int passed = 0;  // guarded by the key
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i)
    threads.emplace_back([&] {
      for (int round = 0; round < 500; ++round) {
        auto held = locks.acquire("a", long_enough);
        const auto moved = std::move(held);
        if (const int now = ++inside; now > most) most = now;
        ++passed;
        --inside;
      }
    });
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(most, 1);
  EXPECT_EQ(passed, 4000);
  EXPECT_EQ(locks.size(), 0U);
}

}  // namespace
}  // namespace semblante::api
