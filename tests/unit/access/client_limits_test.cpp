#include "server/access/client_limits.h"

#include <gtest/gtest.h>

namespace semblante::access {
namespace {

using namespace std::chrono_literals;

TEST(ClientRates, Burst_ThenTheRate_ForEachClient) {
  ClientRates rates({10.0, 5.0, 30.0, 120.0});
  const auto now = ClientRates::Clock::now() + 1s;
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(rates.take_request("a", now));
  EXPECT_FALSE(rates.take_request("a", now));
  EXPECT_TRUE(rates.take_request("b", now));
  EXPECT_TRUE(rates.take_request("a", now + 101ms));
  EXPECT_FALSE(rates.take_request("a", now + 102ms));
}

TEST(ClientRates, NoLimit_CountsNothing) {
  ClientRates rates({0.0, 0.0, 30.0, 0.0});
  for (int i = 0; i < 10'000; ++i) EXPECT_TRUE(rates.take_request("a") && rates.take_creation("a"));
  EXPECT_EQ(rates.size(), 0U);
}

TEST(ClientRates, FailedTokens_StopAnAddressForAWhile) {
  ClientRates rates({10.0, 5.0, 30.0, 120.0});
  const auto now = ClientRates::Clock::now() + 1s;
  for (int i = 0; i < 30; ++i) {
    EXPECT_TRUE(rates.may_try("a", now));
    rates.count_failure("a", now);
  }
  EXPECT_FALSE(rates.may_try("a", now));
  EXPECT_TRUE(rates.may_try("b", now));
  EXPECT_TRUE(rates.may_try("a", now + 3s));
}

TEST(ClientRates, Creations_HaveARateOfTheirOwn) {
  ClientRates rates({0.0, 0.0, 30.0, 60.0});
  const auto now = ClientRates::Clock::now() + 1s;
  for (int i = 0; i < 60; ++i) EXPECT_TRUE(rates.take_creation("a", now));
  EXPECT_FALSE(rates.take_creation("a", now));
  EXPECT_TRUE(rates.take_creation("b", now));
  EXPECT_TRUE(rates.take_creation("a", now + 1001ms));
  EXPECT_FALSE(rates.take_creation("a", now + 1002ms));
}

TEST(ClientRates, ManyClients_AreForgottenWhenIdle) {
  ClientRates rates({10.0, 5.0, 30.0, 120.0});
  auto now = ClientRates::Clock::now();
  for (int i = 0; i < 100'000; ++i) {
    now += 1ms;
    rates.take_request(std::to_string(i), now);
  }
  EXPECT_LT(rates.size(), 3'000U);
}

}  // namespace
}  // namespace semblante::access
