#include "tests/unit/runtime/playout_simulation.h"

#include <cmath>
#include <iostream>

#include <gtest/gtest.h>

namespace semblante::testing {
namespace {

/// How much of the time frames may be missing when the delay is the client's own choice, and the greatest mean delay
/// beyond the batch interval that buys this.
struct Bounds {
  double held = 0, delay = 0;
};

struct Scenario {
  NetworkModel network;
  Bounds bounds;
};

std::vector<Scenario> scenarios() {
  std::vector<Scenario> all;
  const auto add = [&](const char* name, Bounds bounds) -> NetworkModel& {
    all.push_back({{}, bounds});
    all.back().network.name = name;
    return all.back().network;
  };
  add("constant", {0.001, 130});
  add("jitter", {0.004, 200}).jitter = 80;
  NetworkModel& bursts = add("bursts", {0.01, 300});
  bursts.jitter = 40;
  bursts.burst_every = 25;
  NetworkModel& stalls = add("stalls", {0.01, 460});
  stalls.jitter = 10;
  stalls.stalls = 0.02;
  NetworkModel& losses = add("losses", {0.02, 300});
  losses.jitter = 20;
  losses.loss_every = 45;
  NetworkModel& drift = add("drift", {0.004, 200});
  drift.jitter = 40;
  drift.drift = 200e-6;
  return all;
}

void report(const NetworkModel& network, const SimulationOptions& options, const SimulationResult& result) {
  std::cout << network.name << ", batches of " << options.batch_interval << " ms"
            << (options.delay ? ", fixed delay" : "") << ": skew p50 " << result.skew_at(0.5) << " p99 "
            << result.skew_at(0.99) << " ms, worst " << result.skew.back() << "; clock off by "
            << result.worst_clock_error << "; delay " << result.mean_delay << ", held " << 100 * result.held_share
            << " %, starved " << result.starved << ", snaps " << result.snaps << ", losses " << result.losses
            << ", speed " << result.slowest << " to " << result.fastest << '\n';
}

class PlayoutSimulation : public ::testing::TestWithParam<std::tuple<std::size_t, double>> {};

TEST_P(PlayoutSimulation, AdaptiveDelay_ShowsTheStreamsClockLessTheDelay) {
  const Scenario scenario = scenarios()[std::get<0>(GetParam())];
  SimulationOptions options;
  options.batch_interval = std::get<1>(GetParam());
  options.minutes = 120;
  options.seed = std::get<0>(GetParam()) * 1000 + static_cast<std::uint64_t>(options.batch_interval);
  const SimulationResult result = simulate(scenario.network, options);
  report(scenario.network, options, result);
  EXPECT_LT(result.skew_at(0.99), 20);
  EXPECT_EQ(result.backwards, 0U);
  EXPECT_GE(result.slowest, 0.95 - 1e-9);
  EXPECT_LE(result.fastest, 1.05 + 1e-9);
  EXPECT_LT(result.held_share, scenario.bounds.held);
  EXPECT_LT(result.mean_delay, scenario.bounds.delay + options.batch_interval);
  EXPECT_GT(result.skew.size(), 350'000U * (scenario.network.loss_every > 0 ? 0.8 : 1.0));
}

TEST_P(PlayoutSimulation, SameFixedDelayOnUnlikeNetworks_ShowTheSameMoment) {
  const Scenario scenario = scenarios()[std::get<0>(GetParam())];
  SimulationOptions options;
  options.batch_interval = std::get<1>(GetParam());
  options.minutes = 60;
  options.delay = options.batch_interval + 450;  // beyond what these networks do to a message
  const SimulationResult here = simulate(scenario.network, options);
  report(scenario.network, options, here);
  EXPECT_LT(here.skew_at(0.99), 20);
  EXPECT_EQ(here.backwards, 0U);
  NetworkModel good = scenarios()[0].network;
  good.base = 5;
  good.drift = scenario.network.drift;
  const SimulationResult there = simulate(good, options);
  std::vector<double> apart;
  for (std::size_t i = 0; i < std::min(here.shown.size(), there.shown.size()); ++i) {
    if (!std::isnan(here.shown[i])) {
      apart.push_back(std::abs(here.shown[i] - there.shown[i]));
    }
  }
  ASSERT_GT(apart.size(), 150'000U);
  std::sort(apart.begin(), apart.end());
  EXPECT_LT(apart[apart.size() * 99 / 100], 20);
}

INSTANTIATE_TEST_SUITE_P(Networks, PlayoutSimulation,
                         ::testing::Combine(::testing::Range<std::size_t>(0, 6), ::testing::Values(40.0, 100.0, 200.0)),
                         [](const auto& info) {
                           return std::string(scenarios()[std::get<0>(info.param)].network.name) + "_" +
                                  std::to_string(static_cast<int>(std::get<1>(info.param)));
                         });

}  // namespace
}  // namespace semblante::testing
