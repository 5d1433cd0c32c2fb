// A real server, a bad network, a client that plays: what it shows beside the stream's true clock.

#include <iostream>

#include <gtest/gtest.h>

#include "tests/integration/client/sample_server.h"
#include "tests/support/skew_meter.h"

namespace semblante::testing {
namespace {

TEST(Playout, RealServerBehindABadNetwork_ShowsTheStreamsClockLessItsDelay) {
  const SampleServer server;
  SkewOptions options;
  options.server = *client::parse_url(server.url());
  options.network.delay = 30;
  options.network.jitter = 60;
  options.network.stalls = 0.01;
  options.network.seed = 7;
  options.cut_half_way = true;
  const auto skew = measure_skew(options);
  ASSERT_TRUE(skew) << "the stream cannot be had";
  std::cout << "skew p50 " << skew->at(0.5) << ", p99 " << skew->at(0.99) << ", worst " << skew->at(1) << " ms of "
            << skew->sorted.size() << " display frames; delay " << skew->stats.delay << ", starved "
            << skew->stats.starved << ", uncertainty " << skew->uncertainty << "; of the machine: " << skew->disturbed
            << " late display frames, worst " << skew->worst_late << " ms, proxy " << skew->worst_proxy
            << " ms, true clock within " << skew->truth << " ms\n";
  EXPECT_EQ(skew->backwards, 0U);
  EXPECT_EQ(skew->connections, 2U);
  if (skew->sorted.size() < 200 || skew->truth > 10) {
    GTEST_SKIP() << "this machine is too busy to be a clock";
  }
  // A machine that was late itself makes the tail of the distribution; the middle still tells.
  EXPECT_LT(skew->at(0.99), skew->calm() ? 20 : 60);
  EXPECT_LT(skew->at(0.5), 20);
}

}  // namespace
}  // namespace semblante::testing
