#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "protocol/cpp/json_codec.h"
#include "protocol/cpp/quantizers.h"
#include "server/streams/batch_listener.h"
#include "server/streams/fap_source.h"
#include "server/streams/performance_source.h"
#include "server/streams/stream_hub.h"
#include "tests/unit/streams/fake_socket.h"
#include "tests/unit/streams/feeding.h"

namespace semblante::streams {
namespace {

using std::chrono::milliseconds;

/// A stream and one connection in JSON, without a socket.
class StreamTest : public ::testing::Test {
 protected:
  explicit StreamTest() {
    limits_.pending_messages = 4;
    limits_.stalled = milliseconds(0);
    limits_.filling_patience = std::chrono::minutes(1);
    stream_ = std::make_shared<Stream>(unbatched_stream(), limits_);
  }
  std::shared_ptr<FakeClient> connect(StreamRole role) { return std::make_shared<FakeClient>(stream_, role); }
  void publish(std::int16_t level) { ASSERT_TRUE(stream_->publish_request({frame_with(level)})); }

  StreamLimits limits_;
  std::shared_ptr<Stream> stream_;
};

TEST_F(StreamTest, Behind_NewestStateReplacesWhatWaits) {
  const auto client = connect(StreamRole::subscribe);
  client->take_all();
  client->socket->stop_reading();
  for (std::int16_t level = 1; level <= 10; ++level) {
    publish(level);
    EXPECT_LE(client->socket->waiting(), limits_.pending_messages);
  }
  client->socket->read_again(*client->connection);
  const auto messages = client->take_all();
  ASSERT_EQ(messages.size(), 1U) << "one keyframe instead of ten batches";
  const auto& keyframe = std::get<Keyframe>(messages[0]);
  EXPECT_EQ(keyframe.sequence, 10U);
  EXPECT_EQ(keyframe.state.level[3], 10);
  publish(11);
  const auto after = client->take_all();
  ASSERT_EQ(after.size(), 1U);
  EXPECT_EQ(std::get<Frames>(after[0]).sequence, 11U) << "and from there on without a gap";
  EXPECT_EQ(stream_->counts().messages_replaced, 10U);
}

TEST_F(StreamTest, Behind_AtTheEnd_GetsTheNewestStateBeforeIt) {
  const auto client = connect(StreamRole::subscribe);
  client->take_all();
  client->socket->stop_reading();
  for (std::int16_t level = 1; level <= 10; ++level) publish(level);
  ASSERT_EQ(stream_->counts().messages_replaced, 10U);
  stream_->end(EndReason::shutdown);
  client->socket->read_again(*client->connection);
  const auto messages = client->take_all();
  ASSERT_EQ(messages.size(), 2U);
  ASSERT_TRUE(std::holds_alternative<Keyframe>(messages[0])) << "the face stays as it was long before";
  EXPECT_EQ(std::get<Keyframe>(messages[0]).state.level[3], 10);
  EXPECT_EQ(std::get<End>(messages[1]).reason, EndReason::shutdown);
}

/// What a recorder would see.
struct Heard : BatchListener {
  void taken(std::string_view stream, std::uint64_t epoch, const Frames& batch) override {
    EXPECT_EQ(stream, "s");
    EXPECT_EQ(epoch, 7U);
    batches.push_back(batch);
  }
  void ended(std::string_view stream) override {
    EXPECT_EQ(stream, "s");
    ++ends;
  }
  std::vector<Frames> batches;
  int ends = 0;
};

TEST_F(StreamTest, Listener_HearsEveryBatchAndTheEnd) {
  const auto heard = std::make_shared<Heard>();
  publish(1);
  stream_->set_listener(heard);
  publish(2);
  publish(3);
  stream_->set_listener(nullptr);
  publish(4);
  stream_->set_listener(heard);
  publish(5000);
  stream_->end(EndReason::deleted);
  ASSERT_EQ(heard->batches.size(), 3U);
  EXPECT_EQ(heard->batches[0].sequence, 2U);
  EXPECT_EQ(heard->batches[1].sequence, 3U);
  EXPECT_EQ(heard->batches[1].frames.at(0).state.level[3], 3);
  EXPECT_EQ(heard->batches[2].frames.at(0).state.level[3], 1080) << "as subscribers get it: clamped";
  EXPECT_EQ(heard->ends, 1);
}

TEST_F(StreamTest, HeaderOfRecordings_SaysAllThatSubscribersAreToldOfTheStream) {
  auto info = unbatched_stream();
  info.settings = {"Talk", "head", 0.25, 0, 0.5};
  stream_ = std::make_shared<Stream>(info, limits_);
  publish(1);
  const auto subscriber = connect(StreamRole::subscribe);
  auto told = std::get<Header>(subscriber->take_all().at(0));
  auto recorded = stream_->header();
  EXPECT_EQ(recorded.sound, stream_sound) << "a recording has it, whoever listens";
  recorded.sound.reset();
  EXPECT_EQ(recorded.title, "Talk");
  EXPECT_EQ(recorded.model, "head");
  EXPECT_EQ(recorded.viseme_share, 0.25);
  EXPECT_EQ(recorded.quantizers.size(), 66U);
  EXPECT_EQ(recorded.sequence, 1U);
  // What is about the connection, or the moment.
  told.media_time = recorded.media_time;
  told.server_time = recorded.server_time;
  EXPECT_EQ(told, recorded);
}

TEST_F(StreamTest, Stalled_IsClosedAsSlow) {
  const auto stalled = connect(StreamRole::subscribe);
  const auto quick = connect(StreamRole::subscribe);
  stalled->take_all();
  stalled->socket->stop_reading();
  for (std::int16_t level = 1; level <= 3; ++level) publish(level);
  stream_->look_after_connections();
  ASSERT_TRUE(stalled->socket->closed());
  EXPECT_EQ(stalled->socket->closed()->code, 1013);
  EXPECT_FALSE(quick->socket->closed());
  EXPECT_EQ(stream_->info().subscribers, 1U);
  EXPECT_EQ(stream_->counts().closed_slow, 1U);
  stalled->socket->read_again(*stalled->connection);
  const auto last = stalled->take_all();
  ASSERT_EQ(last.size(), 1U) << "what waited is dropped";
  EXPECT_EQ(std::get<End>(last[0]).reason, EndReason::slow);
}

TEST_F(StreamTest, PublisherLeaves_AnotherMayFollow) {
  const auto first = connect(StreamRole::publish);
  EXPECT_FALSE(first->socket->closed());
  const auto second = connect(StreamRole::publish);
  EXPECT_EQ(second->socket->closed()->code, 1008);
  EXPECT_FALSE(stream_->publish_request({frame_with(1)}));
  first->leave();
  EXPECT_FALSE(connect(StreamRole::publish)->socket->closed());
}

TEST_F(StreamTest, PublisherHasFinished_AnotherNeedNotWaitForItsSocket) {
  const auto first = connect(StreamRole::publish);
  first->connection->receive(encode_json(End{EndReason::finished}), false);
  EXPECT_EQ(first->socket->closed()->code, 1000);
  EXPECT_FALSE(connect(StreamRole::publish)->socket->closed());
}

TEST_F(StreamTest, NoRoomForTheJoinPoint_IsClosedAsSlow_AndGetsNoBatches) {
  // Before its hello it has made many answers, and read none.
  const auto client = std::make_shared<FakeClient>(stream_);
  client->socket->stop_reading();
  for (std::size_t i = 0; i < client->connection->outbox_limits().answers; ++i) client->connection->receive("{", false);
  client->hello(StreamRole::subscribe);
  ASSERT_TRUE(client->socket->closed());
  EXPECT_EQ(client->socket->closed()->code, 1013);
  EXPECT_EQ(stream_->info().subscribers, 0U);
}

TEST_F(StreamTest, OwnFilling_GivesWay) {
  ASSERT_TRUE(stream_->fill(Stream::Clock::now(), frame_with(1)));
  EXPECT_EQ(stream_->info().sequence, 1U);
  publish(2);
  ASSERT_TRUE(stream_->fill(Stream::Clock::now(), frame_with(3)));
  EXPECT_EQ(stream_->info().sequence, 2U);
}

TEST_F(StreamTest, PublishersClock_KeepsItsSpacing) {
  const auto subscriber = connect(StreamRole::subscribe);
  const auto publisher = connect(StreamRole::publish);
  subscriber->take_all();
  const auto send = [&](std::uint64_t media_time) {
    publisher->connection->receive(encode_json(Frames{1, media_time, {frame_with(1)}}), false);
    const auto messages = subscriber->take_all();
    return messages.size() == 1 ? std::get<Frames>(messages[0]).media_time : 0;
  };
  const auto begin = send(5000);
  EXPECT_EQ(send(5040), begin + 40);
  EXPECT_EQ(send(5080), begin + 80);
  EXPECT_LT(send(900'000), begin + 500'000) << "a clock that jumps is set anew";
}

TEST_F(StreamTest, Rate_IsLimited) {
  limits_.publisher.frames_burst = 3;
  limits_.publisher.frames_per_second = 0;
  stream_ = std::make_shared<Stream>(unbatched_stream(), limits_);
  const auto publisher = connect(StreamRole::publish);
  publisher->take_all();
  publisher->connection->receive(encode_json(Frames{1, 0, {frame_with(1), frame_with(2)}}), false);
  EXPECT_TRUE(publisher->take_all().empty());
  publisher->connection->receive(encode_json(Frames{3, 0, {frame_with(1), frame_with(2)}}), false);
  EXPECT_EQ(std::get<StreamError>(publisher->take_all().at(0)).code, StreamErrorCode::throttled);
  EXPECT_EQ(stream_->info().sequence, 2U);
}

TEST_F(StreamTest, MessagesWithoutFrames_HaveARate_AndFramesOfAPublisherAreNotAmongThem) {
  constexpr int burst = static_cast<int>(StreamConnection::messages_burst);
  const auto ping = encode_json(Ping{1, 1.0});
  const std::string garbage = "{";
  FakeClient good(stream_, StreamRole::publish);
  for (const auto& message : {ping, garbage}) {
    FakeClient bad(stream_, StreamRole::subscribe);
    // In far less time than the rate gives back as many.
    for (int i = 0; i < 20 * burst && !bad.socket->closed(); ++i) bad.connection->receive(message, false);
    ASSERT_TRUE(bad.socket->closed());
    EXPECT_EQ(bad.socket->closed()->code, 1008);
    const auto heard = bad.take_all();
    EXPECT_GE(heard.size(), static_cast<std::size_t>(burst));
    EXPECT_EQ(std::get<StreamError>(heard.back()).code, StreamErrorCode::throttled);
  }
  for (int i = 0; i < burst - 1; ++i) good.connection->receive(ping, false);
  EXPECT_FALSE(good.socket->closed());
}

TEST_F(StreamTest, Ended_TakesNobody) {
  const auto subscriber = connect(StreamRole::subscribe);
  stream_->end(EndReason::deleted);
  EXPECT_EQ(subscriber->socket->closed()->code, 1000);
  EXPECT_FALSE(stream_->admit(std::make_shared<StreamConnection>(stream_, true, true)));
  EXPECT_FALSE(stream_->publish_request({frame_with(1)}));
}

TEST_F(StreamTest, ValuesBeyondTheirRange_AreClampedAndCounted_WhateverTheSource) {
  const auto subscriber = connect(StreamRole::subscribe);
  subscriber->take_all();
  // FAP 3 is unidirectional: 0..1080 by the table, -1080..1080 taken. FAP 4 is not: -600..600. FAP 26: -900..900.
  TimedFrame frame = frame_with(-1080);
  frame.state.level[4] = 601;
  frame.state.level[26] = -32767;
  const auto receipt = stream_->publish_request({frame, frame_with(1081), frame_with(1080)});
  ASSERT_TRUE(receipt);
  EXPECT_EQ(receipt->clamped, 3U);
  const auto publisher = connect(StreamRole::publish);
  publisher->connection->receive(encode_json(Frames{0, 0, {frame_with(-2000)}}), false);
  publisher->leave();
  const auto ticket = stream_->begin_playing(25, false);
  ASSERT_TRUE(ticket);
  EXPECT_TRUE(stream_->publish_playing(*ticket, Stream::Clock::now(), frame_with(3000)).ok());
  EXPECT_EQ(stream_->info().clamped_values, 5U);
  EXPECT_EQ(stream_->counts().clamped_values, 5U);

  const auto messages = subscriber->take_all();
  ASSERT_EQ(messages.size(), 3U);
  const auto& batch = std::get<Frames>(messages[0]).frames;
  EXPECT_EQ(batch[0].state.level[3], -1080);
  EXPECT_EQ(batch[0].state.level[4], 600);
  EXPECT_EQ(batch[0].state.level[26], -900);
  EXPECT_EQ(batch[1].state.level[3], 1080);
  EXPECT_EQ(std::get<Frames>(messages[1]).frames[0].state.level[3], -1080);
  EXPECT_EQ(std::get<Frames>(messages[2]).frames[0].state.level[3], 1080);
}

TEST(FapSource, GivesTheFramesOfTheFile_AndValuesBetweenThem) {
  std::vector<TimedValues> frames(3);
  for (std::uint32_t i = 0; i < 3; ++i) {
    frames[i].time = i == 0 ? 0 : 33 + 34 * (i - 1);  // 30 a second, in whole milliseconds: 0, 33, 67
    frames[i].state.fap[14] = 100 * (i + 1);
  }
  frames[1].state.viseme = {10, 0, 63};
  const auto source = make_fap_source(frames, 30, "walk");
  EXPECT_EQ(source->kind(), "fap");
  EXPECT_EQ(source->name(), "walk");
  EXPECT_NEAR(source->duration(), 100.33, 0.01);
  for (int k = 0; k < 3; ++k) {
    const double ms = k * 1000.0 / 30;
    EXPECT_EQ(source->frame_at(ms, ms).level[14], 100 * (k + 1)) << k;
    EXPECT_EQ(source->frame_at(ms, ms).viseme.select1, k == 1 ? 10 : 0);
  }
  EXPECT_EQ(source->frame_at(50, 50).level[14], 250);
  EXPECT_EQ(source->frame_at(100, 100).level[14], 300);
}

TEST(Hub, Streams_OpenOnceAndEndOnce) {
  InProcessHub hub;
  auto info = unbatched_stream();
  info.id = "a";
  EXPECT_TRUE(hub.open(info));
  EXPECT_FALSE(hub.open(info));
  const auto epoch = hub.info("a")->epoch;
  EXPECT_TRUE(hub.publish("a", {frame_with(1)}));
  EXPECT_FALSE(hub.publish("b", {frame_with(1)}));
  EXPECT_EQ(std::get<Refusal>(hub.connect("b", "", {})), Refusal::no_such_stream);
  const auto peer = std::get<std::shared_ptr<http::WebSocketPeer>>(hub.connect("a", "", {}));
  EXPECT_TRUE(hub.close("a", EndReason::deleted));
  EXPECT_FALSE(hub.close("a", EndReason::deleted));
  EXPECT_EQ(hub.counts().frames, 1U) << "what was counted stays counted";
  EXPECT_EQ(hub.counts().closed_ended, 1U) << "the end itself is counted too";
  EXPECT_TRUE(hub.open(info));
  EXPECT_GT(hub.info("a")->epoch, epoch) << "a new life has a new epoch";
  peer->disconnected();
}

TEST(Demo, Minute_TalksBlinksFeelsAndStaysInRange) {
  const auto demo = demo_source();
  ASSERT_EQ(demo->duration(), 60'000.0);
  std::array<int, 15> visemes{};
  std::array<int, 7> expressions{};
  int blinks = 0;
  int before = 0;
  double longest_turn = 0.0;
  FaceFrame last = demo->frame_at(0.0, 0.0);
  for (double t = 0.0; t <= 60'000.0; t += 40.0) {
    const auto frame = demo->frame_at(std::fmod(t, 60'000.0), t);
    ++visemes[frame.viseme.select1];
    ++expressions[frame.expression.select1];
    const int shut = frame.level[19] * standard_quantizers()[19] > 500 ? 1 : 0;
    blinks += shut > before ? 1 : 0;
    before = shut;
    for (const int fap : {48, 49, 50}) {
      const double step = standard_quantizers()[static_cast<std::size_t>(fap)];
      longest_turn = std::max(
          longest_turn,
          std::abs(frame.level[static_cast<std::size_t>(fap)] - last.level[static_cast<std::size_t>(fap)]) * step);
    }
    last = frame;
  }
  for (std::size_t i = 0; i < visemes.size(); ++i) EXPECT_GT(visemes[i], 0) << "viseme " << i;
  for (std::size_t i = 0; i < expressions.size(); ++i) EXPECT_GT(expressions[i], 0) << "expression " << i;
  EXPECT_GE(blinks, 11);
  EXPECT_LE(blinks, 20);
  EXPECT_LT(longest_turn, 1500.0) << "the head turns less than 0.9 degrees a frame, over the seam of the loop too";
}

}  // namespace
}  // namespace semblante::streams
