#include "server/streams/player.h"

#include <atomic>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

#include "protocol/cpp/json_codec.h"
#include "server/streams/stream_hub.h"
#include "tests/support/wait.h"
#include "tests/unit/streams/fake_socket.h"

namespace semblante::streams {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

/// FAP 3 has the level of the millisecond, FAP 5 that of the time played.
class Ramp : public FrameSource {
 public:
  explicit Ramp(double duration) : duration_(duration) {}
  [[nodiscard]] std::string_view kind() const override { return "ramp"; }
  [[nodiscard]] std::string name() const override { return "Ramp"; }
  [[nodiscard]] double duration() const override { return duration_; }
  [[nodiscard]] FaceFrame frame_at(double ms, double played_ms) const override {
    FaceFrame frame;
    frame.level[3] = static_cast<std::int16_t>(ms);
    frame.level[5] = static_cast<std::int16_t>(played_ms);
    return frame;
  }
  [[nodiscard]] std::size_t bytes() const override { return 1000; }

 private:
  double duration_;
};

class PlayerTest : public ::testing::Test {
 protected:
  PlayerTest() : stream_(std::make_shared<Stream>(unbatched_stream(), StreamLimits{})) {
    subscriber_ = connect(StreamRole::subscribe);
    take_frames();
  }
  std::shared_ptr<FakeClient> connect(StreamRole role) { return std::make_shared<FakeClient>(stream_, role); }
  std::vector<Frames> take_frames() {
    std::vector<Frames> frames;
    for (const auto& message : subscriber_->take_all())
      if (std::holds_alternative<Frames>(message)) frames.push_back(std::get<Frames>(message));
    return frames;
  }
  Player player(double duration, PlayOptions options) {
    const auto ticket = stream_->begin_playing(options.rate, options.take_over);
    EXPECT_TRUE(ticket);
    return {"1", stream_, ticket ? *ticket : 0, std::make_shared<Ramp>(duration), options, begin_};
  }
  Player::Clock::time_point at(double ms) const {
    return begin_ + microseconds(static_cast<std::int64_t>(ms * 1000.0));
  }

  std::shared_ptr<Stream> stream_;
  std::shared_ptr<FakeClient> subscriber_;
  const Player::Clock::time_point begin_ = Player::Clock::now() + std::chrono::seconds(5);
};

TEST_F(PlayerTest, Jitter_OfTheThread_IsNotInTheFrames) {
  PlayOptions options;
  options.rate = 30.0;
  auto playing = player(1000.0, options);
  double late = 0.0;
  while (!playing.finished()) {
    late = late > 20.0 ? 0.0 : late + 7.0;
    playing.play(playing.next() + microseconds(static_cast<std::int64_t>(late * 1000.0)));
  }
  const auto messages = take_frames();
  ASSERT_EQ(messages.size(), 31U) << "30 a second and the end itself";
  for (std::size_t k = 0; k < messages.size(); ++k) {
    const double expected = k == 30 ? 1000.0 : static_cast<double>(k) * 1000.0 / 30.0;
    EXPECT_NEAR(static_cast<double>(messages[k].media_time - messages[0].media_time), expected, 1.01);
    EXPECT_EQ(messages[k].frames[0].state.level[3], static_cast<std::int16_t>(expected));
  }
}

TEST_F(PlayerTest, Late_PlaysWhatIsDueAndNotWhatWas) {
  auto playing = player(1000.0, {});
  playing.play(at(0.0));
  playing.play(at(333.0));
  EXPECT_EQ(playing.next(), at(360.0));
  const auto messages = take_frames();
  ASSERT_EQ(messages.size(), 2U);
  EXPECT_EQ(messages[1].frames[0].state.level[3], 320);
  playing.play(at(5000.0));
  EXPECT_TRUE(playing.finished());
  EXPECT_EQ(take_frames().at(0).frames[0].state.level[3], 1000) << "the end, however late";
}

TEST_F(PlayerTest, Loop_BeginsAgainAndTheTimePlayedRunsOn) {
  PlayOptions options;
  options.loop = true;
  options.from = 900.0;
  auto playing = player(1000.0, options);
  for (double t = 0.0; t <= 1200.0; t += 40.0) playing.play(at(t));
  const auto messages = take_frames();
  EXPECT_EQ(messages[0].frames[0].state.level[3], 900);
  EXPECT_EQ(messages[5].frames[0].state.level[3], 100);
  EXPECT_EQ(messages[5].frames[0].state.level[5], 1100);
  EXPECT_FALSE(playing.finished());
  EXPECT_DOUBLE_EQ(playing.status(at(1150.0)).position, 50.0);
}

TEST_F(PlayerTest, OneSourceAtATime) {
  auto playing = player(1000.0, {});
  EXPECT_FALSE(stream_->publish_request({TimedFrame{}}));
  EXPECT_FALSE(stream_->begin_playing(25.0, false));
  EXPECT_TRUE(connect(StreamRole::publish)->socket->closed()) << "no publisher beside it";
  playing.stop();
  EXPECT_EQ(take_frames().back().frames[0].state, FaceFrame{}) << "back to rest";
  EXPECT_TRUE(stream_->publish_request({TimedFrame{}}));
}

TEST_F(PlayerTest, TakeOver_TellsThePublisherAndStopsWhatPlayed) {
  const auto publisher = connect(StreamRole::publish);
  EXPECT_FALSE(stream_->begin_playing(25.0, false));
  PlayOptions options;
  options.take_over = true;
  auto first = player(1000.0, options);
  EXPECT_TRUE(publisher->socket->closed());
  auto second = player(1000.0, options);
  first.play(at(0.0));
  EXPECT_TRUE(first.finished());
  EXPECT_TRUE(take_frames().empty());
  second.play(at(0.0));
  EXPECT_EQ(take_frames().size(), 1U);
  publisher->connection->receive(encode_json(Frames{1, 0, {TimedFrame{}}}), false);
  EXPECT_TRUE(take_frames().empty()) << "what the old publisher still says is not heard";
}

TEST_F(PlayerTest, Header_TellsTheRate) {
  auto playing = player(1000.0, {});
  const auto late = connect(StreamRole::subscribe);
  EXPECT_EQ(std::get<Header>(late->take_all().at(0)).batch_interval, 40U);
}

TEST(HubPlaying, PlaysToTheEndByItself) {
  InProcessHub hub;
  auto info = unbatched_stream();
  info.id = "a";
  ASSERT_TRUE(hub.open(info));
  PlayOptions options;
  options.rate = 100.0;
  const auto playing = hub.play("a", std::make_shared<Ramp>(150.0), options);
  ASSERT_TRUE(playing);
  EXPECT_FALSE(hub.play("b", std::make_shared<Ramp>(150.0), options));
  EXPECT_FALSE(hub.stop("a", "999"));
  EXPECT_TRUE(testing::eventually([&] { return !hub.info("a")->playing; }));
  EXPECT_GE(hub.info("a")->sequence, 1U) << "at least its end, on however slow a machine";
  EXPECT_FALSE(hub.stop("a", playing->id));
  EXPECT_TRUE(hub.publish("a", {TimedFrame{}}));
}

TEST(HubPlaying, WhatPlaysTogether_FitsIntoTheMemoryItMayTake) {
  StreamLimits limits;
  limits.playing_bytes = 2500;
  InProcessHub hub(limits);
  auto info = unbatched_stream();
  for (const char* id : {"a", "b", "c"}) {
    info.id = id;
    ASSERT_TRUE(hub.open(info));
  }
  const auto source = std::make_shared<Ramp>(0.0);
  ASSERT_TRUE(hub.play("a", source, {}));
  const auto second = hub.play("b", source, {});
  ASSERT_TRUE(second);
  const auto third = hub.play("c", source, {});
  ASSERT_FALSE(third);
  EXPECT_EQ(third.error().code, ErrorCode::too_large);
  EXPECT_FALSE(hub.info("c")->playing);
  PlayOptions over;
  over.take_over = true;
  const auto instead = hub.play("b", source, over);
  ASSERT_TRUE(instead) << "what it takes the place of does not count";
  EXPECT_TRUE(hub.stop("b", instead->id));
  EXPECT_TRUE(testing::eventually([&] { return hub.play("c", source, {}).ok(); }))
      << "the hub's thread lets go of it in its own time";
}

TEST(HubPlaying, StoppedAndClosedStreamsPlayNoMore) {
  InProcessHub hub;
  auto info = unbatched_stream();
  info.id = "a";
  ASSERT_TRUE(hub.open(info));
  const auto playing = hub.play("a", std::make_shared<Ramp>(0.0), {});
  ASSERT_TRUE(playing);
  EXPECT_EQ(hub.info("a")->playing->id, playing->id);
  EXPECT_FALSE(hub.play("a", std::make_shared<Ramp>(0.0), {})) << "one at a time";
  EXPECT_FALSE(hub.stop("a", "999"));
  EXPECT_TRUE(hub.stop("a", playing->id));
  EXPECT_FALSE(hub.info("a")->playing);
  ASSERT_TRUE(hub.play("a", std::make_shared<Ramp>(0.0), {}));
  EXPECT_TRUE(hub.close("a", EndReason::deleted));
  EXPECT_TRUE(hub.open(info));
  EXPECT_FALSE(hub.info("a")->playing);
}

/// Fails at its third frame.
class Broken : public Ramp {
 public:
  Broken() : Ramp(60'000.0) {}
  [[nodiscard]] FaceFrame frame_at(double ms, double played_ms) const override {
    if (++asked_ > 2) throw std::runtime_error("a fault of ours");
    return Ramp::frame_at(ms, played_ms);
  }

 private:
  mutable std::atomic<int> asked_ = 0;
};

TEST(Hub, SourceThatThrows_PlaysNoMore_OthersGoOn) {
  InProcessHub hub{StreamLimits{}};
  for (const char* id : {"bad", "good"}) {
    StreamInfo info;
    info.id = id;
    info.source = "none";
    ASSERT_TRUE(hub.open(info));
  }
  const auto plays = [&](const char* id) { return hub.info(id)->playing.has_value(); };
  ASSERT_TRUE(hub.play("good", std::make_shared<Ramp>(600'000.0), {}));
  ASSERT_TRUE(hub.play("bad", std::make_shared<Broken>(), {}));
  while (plays("bad")) std::this_thread::sleep_for(milliseconds(5));
  EXPECT_TRUE(plays("good"));
  EXPECT_TRUE(hub.play("bad", std::make_shared<Ramp>(600'000.0), {})) << "the stream is free again";
  EXPECT_TRUE(plays("bad"));
}

}  // namespace
}  // namespace semblante::streams
