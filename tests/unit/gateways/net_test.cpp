#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "clients/gateways/net/media_timeline.h"
#include "clients/gateways/net/pacer.h"
#include "clients/gateways/net/rate_limit.h"
#include "clients/gateways/net/udp_socket.h"
#include "tests/support/wait.h"

namespace semblante::gateways {
namespace {

TEST(RateLimit, ALongFlood_IsHeldToTheRateAndAPauseEarnsNoMoreThanABurst) {
  RateLimit limit(100.0);
  int admitted = 0;
  for (int i = 0; i < 10'000; ++i) admitted += limit.admits(i * 0.001) ? 1 : 0;
  EXPECT_NEAR(admitted, 1000 + 25, 2);
  admitted = 0;
  for (int i = 0; i < 1000; ++i) admitted += limit.admits(1000.0) ? 1 : 0;
  EXPECT_EQ(admitted, 25);
}

TEST(MediaTimeline, FramesThatArriveWithJitter_KeepTheSpacingOfTheSendersClock) {
  MediaTimeline timeline;
  double last = 0.0;
  for (int i = 0; i < 300; ++i) {
    const double jitter = 0.030 * ((i * 7919) % 100) / 100.0;
    const auto at = static_cast<double>(timeline.place(5000.0 + i / 60.0, 10.0 + i / 60.0 + jitter));
    if (i > 0) {
      EXPECT_NEAR(at - last, 1000.0 / 60.0, 1.1);
    }
    last = at;
  }
}

TEST(MediaTimeline, WithoutAClock_FramesAreWhereTheyArrive) {
  MediaTimeline timeline;
  EXPECT_EQ(timeline.place(std::nullopt, 7.0), 1U);
  EXPECT_EQ(timeline.place(std::nullopt, 7.25), 251U);
  EXPECT_EQ(timeline.place(3.0, 7.5), 501U);
  EXPECT_EQ(timeline.place(3.0, 7.75), 751U) << "a clock that stands is none";
  EXPECT_EQ(timeline.place(NAN, 8.0), 1001U);
}

TEST(MediaTimeline, ASenderThatStartsAgainOrSleeps_IsPlacedAnewAndTimeNeverFalls) {
  MediaTimeline timeline;
  EXPECT_EQ(timeline.place(86'399.0, 1.0), 1U);
  EXPECT_NEAR(static_cast<double>(timeline.place(86'399.5, 1.5)), 501.0, 1.0);
  EXPECT_NEAR(static_cast<double>(timeline.place(0.1, 1.6)), 601.0, 1.0) << "midnight";
  EXPECT_NEAR(static_cast<double>(timeline.place(0.2, 61.7)), 60'701.0, 1.0) << "a pause of a minute";
  EXPECT_GE(timeline.place(0.1, 61.7), 60'700U) << "packets that overtook each other";
}

TEST(MediaTimeline, AClockThatRunsFast_IsFollowedWithoutJumps) {
  MediaTimeline timeline;
  std::uint64_t last = 0;
  for (int i = 0; i < 60 * 3600; ++i) {
    const double arrival = i / 60.0;
    const std::uint64_t at = timeline.place(arrival * 1.0005, arrival);  // 1.8 s in an hour
    if (i > 0) {
      ASSERT_LE(at - last, 18U);
    }
    last = at;
  }
  EXPECT_NEAR(static_cast<double>(last), 3'600'000.0, 20.0);
}

TEST(Pacer, FramesOfBatches_LeaveAsEvenlyAsTheyWereMade) {
  Pacer pacer;
  // Batches of 100 ms, of frames 40 and 20 ms apart, some up to 30 ms late.
  double last = -1.0;
  for (int b = 0; b < 200; ++b) {
    const double first = b * 100.0;
    const double arrival = first + 100.0 + (b * 7919 % 31);
    pacer.arrived(first, arrival);
    for (const double in : {0.0, 40.0, 60.0}) {
      const double due = pacer.due(first + in);
      EXPECT_GE(due, last);
      if (in == 0.0) {
        EXPECT_GE(due, arrival) << "no frame is late";
      }
      EXPECT_LE(due - first - in, 135.0);
      last = due;
    }
  }
  pacer.arrived(1e6, 40'000.0);
  EXPECT_EQ(pacer.due(1e6), 40'000.0) << "another clock";
}

TEST(Endpoint, TextOfEveryForm_IsTakenApart) {
  const auto parts = [](const char* text) {
    const auto endpoint = parse_endpoint(text, "39539");
    return endpoint ? endpoint->host + " " + endpoint->port : "refused";
  };
  EXPECT_EQ(parts("127.0.0.1"), "127.0.0.1 39539");
  EXPECT_EQ(parts("127.0.0.1:5"), "127.0.0.1 5");
  EXPECT_EQ(parts("[::1]:5"), "::1 5");
  EXPECT_EQ(parts("[::1]"), "::1 39539");
  EXPECT_EQ(parts("::1"), "::1 39539");
  for (const char* bad : {"", ":5", "host:", "host:65536", "host:-1", "host:5x", "host: 5"}) {
    EXPECT_EQ(parts(bad), "refused") << bad;
  }
}

TEST(UdpSocket, APacketSentOnLoopback_Arrives) {
  auto in = UdpSocket::listen({"127.0.0.1", "0"});
  ASSERT_TRUE(in) << in.error().message;
  ASSERT_NE(in->port(), 0);
  EXPECT_FALSE(in->receive());
  auto out = UdpSocket::send_to({"127.0.0.1", std::to_string(in->port())}, false);
  ASSERT_TRUE(out) << out.error().message;
  const std::vector<std::uint8_t> packet = {1, 2, 3};
  ASSERT_TRUE(out->send(packet));
  ASSERT_TRUE(in->wait(testing::patience));
  const auto received = in->receive();
  ASSERT_TRUE(received);
  EXPECT_TRUE(std::equal(received->begin(), received->end(), packet.begin(), packet.end()));
  EXPECT_FALSE(UdpSocket::listen({"127.0.0.1", std::to_string(in->port())})) << "the port is taken";
}

TEST(UdpSocket, OtherMachines_AreSentToOnlyWhenThatIsSaid) {
  for (const char* host : {"192.0.2.1", "0.0.0.0", "255.255.255.255", "2001:db8::1"}) {
    const auto refused = UdpSocket::send_to({host, "9"}, false);
    ASSERT_FALSE(refused) << host;
    EXPECT_EQ(refused.error().code, ErrorCode::invalid_argument) << host;
  }
  EXPECT_TRUE(UdpSocket::send_to({"127.8.9.1", "9"}, false));
  EXPECT_FALSE(UdpSocket::listen({"no.address", "9"}));
}

}  // namespace
}  // namespace semblante::gateways
