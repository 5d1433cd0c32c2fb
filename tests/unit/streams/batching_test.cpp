// Frames become batches, and batches reach those who listen.

#include <array>
#include <atomic>
#include <thread>

#include <gtest/gtest.h>

#include "protocol/cpp/frame_codec.h"
#include "server/streams/batch_sender.h"
#include "tests/support/frame_encoder.h"
#include "tests/support/wait.h"
#include "tests/unit/streams/fake_socket.h"
#include "tests/unit/streams/feeding.h"

namespace semblante::streams {
namespace {

using Clock = Stream::Clock;
using std::chrono::milliseconds;

/// A stream that gathers for a minute, unless the test says that it is over.
class BatchingTest : public ::testing::Test {
 protected:
  std::shared_ptr<Stream> make_stream(std::uint32_t interval, const std::shared_ptr<BatchSender>& sender = nullptr) {
    auto info = unbatched_stream();
    info.settings.batch_interval = interval;
    return std::make_shared<Stream>(info, limits_, sender);
  }
  void publish(std::int16_t level) { ASSERT_TRUE(stream_->publish_request({frame_with(level)})); }
  /// As the sender does when the time has come.
  void minute_is_over() const {
    const auto later = Clock::now() + std::chrono::minutes(2);
    while (stream_->advance(later) <= later) {
    }
  }

  static constexpr std::uint32_t minute = 60'000;
  StreamLimits limits_;
  std::shared_ptr<Stream> stream_ = make_stream(minute);
};

TEST_F(BatchingTest, FramesOfAnInterval_AreOneMessage) {
  const FakeClient client(stream_, StreamRole::subscribe);
  client.socket->take_all();
  for (std::int16_t level = 1; level <= 5; ++level) publish(level);
  EXPECT_TRUE(client.take_all().empty()) << "not yet";
  EXPECT_EQ(stream_->info().sequence, 5U) << "taken they are";
  minute_is_over();
  const auto messages = client.take_all();
  ASSERT_EQ(messages.size(), 1U);
  const auto& batch = std::get<Frames>(messages[0]);
  EXPECT_EQ(batch.sequence, 1U);
  ASSERT_EQ(batch.frames.size(), 5U);
  for (std::int16_t i = 0; i < 5; ++i) EXPECT_EQ(batch.frames[static_cast<std::size_t>(i)].state.level[3], i + 1);
  minute_is_over();
  EXPECT_TRUE(client.take_all().empty()) << "an interval without frames has no message";
  EXPECT_EQ(stream_->counts().batches, 1U);
}

TEST_F(BatchingTest, Times_OfWhatIsGathered_AreKept) {
  const FakeClient client(stream_, StreamRole::subscribe);
  const FakeClient publisher(stream_, StreamRole::publish);
  client.take_all();
  const auto send = [&](std::uint64_t media_time, std::vector<TimedFrame> frames) {
    publisher.connection->receive(encode_json(Frames{0, media_time, std::move(frames)}), false);
  };
  auto late = frame_with(2);
  late.time = 40;
  send(5000, {frame_with(1), late});
  send(5080, {frame_with(3)});
  send(5120, {frame_with(4)});
  minute_is_over();
  const auto messages = client.take_all();
  ASSERT_EQ(messages.size(), 1U);
  std::vector<std::uint32_t> times;
  for (const auto& frame : std::get<Frames>(messages[0]).frames) times.push_back(frame.time);
  EXPECT_EQ(times, (std::vector<std::uint32_t>{0, 40, 80, 120}));
}

TEST_F(BatchingTest, TooManyForOneMessage_AreTwo) {
  const FakeClient client(stream_, StreamRole::subscribe);
  client.take_all();
  std::vector<TimedFrame> many(max_frames_per_message);
  ASSERT_TRUE(stream_->publish_request(many));
  EXPECT_TRUE(client.take_all().empty());
  publish(1);
  EXPECT_EQ(client.take_all().size(), 1U) << "the first goes when the next does not fit";
  minute_is_over();
  const auto rest = client.take_all();
  ASSERT_EQ(rest.size(), 1U);
  EXPECT_EQ(std::get<Frames>(rest[0]).sequence, max_frames_per_message + 1);
}

TEST_F(BatchingTest, Joined_WhileFramesGather_ThatBatchIsTheFirst) {
  publish(1);
  minute_is_over();
  publish(2);
  const FakeClient client(stream_, StreamRole::subscribe);
  const auto begin = client.take_all();
  ASSERT_EQ(begin.size(), 2U);
  EXPECT_EQ(std::get<Header>(begin[0]).sequence, 1U);
  EXPECT_EQ(std::get<Header>(begin[0]).batch_interval, minute);
  EXPECT_EQ(std::get<Keyframe>(begin[1]).sequence, 1U) << "as of the last batch";
  EXPECT_EQ(std::get<Keyframe>(begin[1]).state.level[3], 1);
  publish(3);
  minute_is_over();
  const auto messages = client.take_all();
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_EQ(std::get<Frames>(messages[0]).sequence, 2U) << "none is missing, none comes twice";
  EXPECT_EQ(std::get<Frames>(messages[0]).frames.size(), 2U);
}

TEST_F(BatchingTest, EndOfTheStream_SendsWhatWasGathered) {
  const FakeClient client(stream_, StreamRole::subscribe);
  client.take_all();
  publish(1);
  stream_->end(EndReason::deleted);
  const auto messages = client.take_all();
  ASSERT_EQ(messages.size(), 2U);
  EXPECT_EQ(std::get<Frames>(messages[0]).sequence, 1U);
  EXPECT_EQ(std::get<End>(messages[1]).reason, EndReason::deleted);
}

TEST_F(BatchingTest, Subscribers_ShareTheBytes) {
  stream_ = make_stream(0);
  const FakeClient one(stream_, StreamRole::subscribe);
  const FakeClient other(stream_, StreamRole::subscribe);
  EXPECT_EQ(one.socket->last_wire(), other.socket->last_wire()) << "of the join point";
  publish(1);
  EXPECT_EQ(one.socket->last_wire(), other.socket->last_wire()) << "and of a batch";
}

TEST_F(BatchingTest, Resume_BringsTheGapInOneGo_OrSaysThatItIsTooLong) {
  limits_.resumed_frames = 5;
  stream_ = make_stream(0);
  for (std::int16_t level = 1; level <= 6; ++level) publish(level);
  const auto resume = [&](std::uint64_t sequence) {
    const FakeClient client(stream_);
    Hello hello;
    hello.resume = ResumePoint{7, sequence};
    client.connection->receive(encode_json(hello), false);
    return client.take_all();
  };
  const auto whole = resume(1);
  ASSERT_EQ(whole.size(), 7U) << "header, the keyframe there, five frames";
  EXPECT_TRUE(std::get<Header>(whole[0]).recovered);
  EXPECT_EQ(std::get<Keyframe>(whole[1]).sequence, 1U);
  EXPECT_EQ(std::get<Keyframe>(whole[1]).state.level[3], 1);
  for (std::size_t i = 2; i < 7; ++i) EXPECT_EQ(std::get<Frames>(whole[i]).sequence, i);
  const auto none = resume(6);
  ASSERT_EQ(none.size(), 2U);
  EXPECT_TRUE(std::get<Header>(none[0]).recovered);
  const auto lost = resume(0);
  ASSERT_EQ(lost.size(), 2U);
  EXPECT_FALSE(std::get<Header>(lost[0]).recovered);
  EXPECT_EQ(std::get<Keyframe>(lost[1]).sequence, 6U);
  EXPECT_EQ(resume(7).size(), 2U) << "a future it cannot have seen";
}

TEST_F(BatchingTest, BinarySubscribers_ShareTheBytesOfABatch) {
  stream_ = make_stream(0);
  publish(1);
  const auto join = [&](std::uint64_t resume) {
    auto client = std::make_unique<FakeClient>(stream_, true);
    Hello hello;
    if (resume != 0) hello.resume = ResumePoint{7, resume};
    const auto bytes = FrameEncoder().encode(hello);
    client->connection->receive({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, true);
    return client;
  };
  const auto one = join(0);
  const auto other = join(0);
  publish(2);
  EXPECT_EQ(one->socket->last_wire(), other->socket->last_wire());
  publish(3);
  const auto back = join(2);
  for (const auto* client : {&one, &other, &back}) {
    const auto payloads = (*client)->socket->take_payloads();
    const bool resumed = client == &back;
    ASSERT_EQ(payloads.size(), resumed ? 3U : 4U);
    FrameDecoder decoder;
    std::vector<Message> messages;
    for (const auto& payload : payloads) {
      auto message = decoder.decode({reinterpret_cast<const std::uint8_t*>(payload.data()), payload.size()});
      ASSERT_TRUE(message) << message.error().message;
      messages.push_back(*message);
    }
    EXPECT_EQ(std::get<Header>(messages[0]).recovered, resumed);
    EXPECT_EQ(std::get<Keyframe>(messages[1]).state.level[3], resumed ? 2 : 1);
    EXPECT_EQ(std::get<Frames>(messages.back()).frames.at(0).state.level[3], 3);
  }
}

/// What one client saw, as a reader would take it: a keyframe, then batches without gap.
void expect_unbroken(const std::vector<std::string>& payloads) {
  FrameDecoder decoder;
  for (const auto& payload : payloads) {
    const auto message = decoder.decode({reinterpret_cast<const std::uint8_t*>(payload.data()), payload.size()});
    ASSERT_TRUE(message) << message.error().message << " at " << message.error().where;
    if (const auto* frames = std::get_if<Frames>(&*message)) {
      // Each frame holds its own number: the state is that of the sequence.
      for (std::size_t i = 0; i < frames->frames.size(); ++i)
        ASSERT_EQ(frames->frames[i].state.level[48], static_cast<std::int16_t>((frames->sequence + i) % 1000));
    }
    if (const auto* key = std::get_if<Keyframe>(&*message)) {
      ASSERT_EQ(key->state.level[48], static_cast<std::int16_t>(key->sequence % 1000));
    }
  }
}

TEST_F(BatchingTest, FaultWhileSending_IsRetried_AndNobodyMissesABatch) {
  const auto sender = std::make_shared<BatchSender>();
  stream_ = make_stream(0, sender);
  std::array<std::unique_ptr<FakeClient>, 3> clients;
  for (auto& client : clients) {
    client = std::make_unique<FakeClient>(stream_, StreamRole::subscribe);
    client->take_all();
  }
  clients[1]->socket->throw_once();
  std::array<std::vector<Message>, 3> rows;
  // Whether each client has the state after this many frames, either from a batch or as a keyframe.
  const auto all_have = [&](std::uint64_t sequence) {
    return testing::eventually([&] {
      bool all = true;
      for (std::size_t i = 0; i < clients.size(); ++i) {
        for (auto& message : clients[i]->take_all()) rows[i].push_back(std::move(message));
        std::uint64_t seen = 0;
        for (const auto& message : rows[i]) {
          if (const auto* frames = std::get_if<Frames>(&message)) seen = frames->sequence;
          if (const auto* key = std::get_if<Keyframe>(&message)) seen = key->sequence;
        }
        all = all && seen == sequence;
      }
      return all;
    });
  };
  publish(1);
  EXPECT_TRUE(all_have(1)) << "the slice with the fault is finished";
  publish(2);
  EXPECT_TRUE(all_have(2)) << "the stream is sent again after a fault";
  for (const auto& row : rows) {
    ASSERT_EQ(row.size(), 2U);
    EXPECT_TRUE(std::holds_alternative<Frames>(row[1]));
  }
  EXPECT_TRUE(std::holds_alternative<Frames>(rows[0][0])) << "sent before the fault";
  EXPECT_TRUE(std::holds_alternative<Keyframe>(rows[2][0])) << "not reached: gets the newest state";
  sender->stop();
}

TEST_F(BatchingTest, ComingGoingAndFallingBehind_WhileTheSenderSends_BreaksNobodysRow) {
  const auto sender = std::make_shared<BatchSender>();
  limits_.pending_messages = 3;
  limits_.stalled = std::chrono::hours(1);
  stream_ = make_stream(1, sender);
  std::atomic<bool> stop{false};
  std::thread source([&] {
    for (std::uint64_t sequence = 1; !stop; ++sequence) {
      TimedFrame frame;
      frame.state.level[48] = static_cast<std::int16_t>(sequence % 1000);
      ASSERT_TRUE(stream_->publish_request({frame}));
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
  });
  const auto come = [&] {
    auto client = std::make_unique<FakeClient>(stream_, true);
    const auto hello = FrameEncoder().encode(Hello());
    client->connection->receive({reinterpret_cast<const char*>(hello.data()), hello.size()}, true);
    return client;
  };
  std::vector<std::unique_ptr<FakeClient>> stay;
  for (int i = 0; i < 600; ++i) stay.push_back(come());
  for (int round = 0; round < 300; ++round) {
    const auto client = come();
    auto& slow = *stay[static_cast<std::size_t>(round) % stay.size()];
    slow.socket->stop_reading();
    std::this_thread::sleep_for(std::chrono::microseconds(300));
    client->leave();
    if (round % 2 == 0) slow.socket->read_again(*slow.connection);
    expect_unbroken(client->socket->take_payloads());
  }
  EXPECT_TRUE(testing::eventually([&] { return stream_->counts().messages_replaced > 0; })) << "nobody falls behind";
  stop = true;
  source.join();
  for (const auto& client : stay) client->socket->read_again(*client->connection);
  stream_->end(EndReason::deleted);
  sender->stop();
  const auto last = stream_->info().sequence;
  EXPECT_GT(last, 0U);
  for (const auto& client : stay) {
    const auto payloads = client->socket->take_payloads();
    ASSERT_FALSE(payloads.empty());
    expect_unbroken(payloads);
  }
  EXPECT_GT(stream_->counts().lateness.count(), 0U);
}

TEST(BatchSender, ManyTurnsThatComeWhileItWaits_MoveNothingItLooksAt) {
  // AddressSanitizer sees it when the place of the turn that is waited for is read again after it has moved.
  BatchSender sender;
  const auto far = Clock::now() + std::chrono::hours(1);
  sender.wake({}, far);
  std::this_thread::sleep_for(milliseconds(20));
  for (int i = 1; i <= 1000; ++i) sender.wake({}, far + milliseconds(i));
  sender.wake({}, Clock::now());
  std::this_thread::sleep_for(milliseconds(20));
}

TEST(BatchSender, ServesManyStreamsAndForgetsThoseThatAreGone) {
  const auto sender = std::make_shared<BatchSender>();
  std::vector<std::shared_ptr<Stream>> streams;
  std::vector<std::unique_ptr<FakeClient>> clients;
  for (int i = 0; i < 20; ++i) {
    StreamInfo info;
    info.id = std::to_string(i);
    info.settings.batch_interval = i % 2 == 0 ? 0 : 5;
    streams.push_back(std::make_shared<Stream>(info, StreamLimits{}, sender));
    clients.push_back(std::make_unique<FakeClient>(streams.back(), StreamRole::subscribe));
    clients.back()->take_all();
  }
  for (const auto& stream : streams) ASSERT_TRUE(stream->publish_request({frame_with(1)}));
  {
    StreamInfo info;
    info.settings.batch_interval = 20;
    const auto gone = std::make_shared<Stream>(info, StreamLimits{}, sender);
    ASSERT_TRUE(gone->publish_request({frame_with(1)}));
  }
  for (const auto& client : clients) {
    std::size_t got = 0;
    testing::eventually([&] { return (got += client->take_all().size()) > 0; });
    EXPECT_EQ(got, 1U);
  }
  sender->stop();
}

}  // namespace
}  // namespace semblante::streams
