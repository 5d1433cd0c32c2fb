// Who may feed a stream when somebody else does, and what subscribers see of the change: README.md's table.

#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/streams/fake_socket.h"
#include "tests/unit/streams/feeding.h"

namespace semblante::streams {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

/// One source of any kind, as far as a stream can tell.
class Feeder {
 public:
  Feeder(std::shared_ptr<Stream> stream, Source source) : stream_(std::move(stream)), source_(source) {}

  /// False when the stream refuses it.
  bool begin(bool take_over) {
    if (source_ == Source::connection) {
      client_ = std::make_unique<FakeClient>(stream_);
      Hello hello;
      hello.role = StreamRole::publish;
      hello.take_over = take_over;
      client_->connection->receive(encode_json(hello), false);
      return !client_->socket->closed();
    }
    if (source_ == Source::request || source_ == Source::demo) return true;
    const auto ticket = stream_->begin_playing(25.0, take_over, source_);
    if (!ticket) {
      EXPECT_EQ(ticket.error().code, ErrorCode::mismatch);
      return false;
    }
    ticket_ = *ticket;
    return true;
  }

  /// Whether the frame entered the stream. `clock`: of a publisher; 0: it has none.
  bool send(std::int16_t level, std::uint64_t clock = 0, std::uint32_t spacing = 0, std::size_t count = 1) {
    std::vector<TimedFrame> frames(count);
    for (std::size_t i = 0; i < count; ++i) {
      frames[i].time = static_cast<std::uint32_t>(i) * spacing;
      frames[i].state.level[3] = level;
    }
    const auto before = stream_->info().sequence;
    switch (source_) {
      case Source::connection:
        client_->connection->receive(encode_json(Frames{0, clock, frames}), false);
        break;
      case Source::request:
        static_cast<void>(stream_->publish_request(frames).ok());
        break;
      case Source::demo:
        static_cast<void>(stream_->fill(Stream::Clock::now(), frames[0]).ok());
        break;
      default:
        static_cast<void>(stream_->publish_playing(ticket_, Stream::Clock::now(), frames[0]).ok());
    }
    return stream_->info().sequence > before;
  }
  [[nodiscard]] const FakeClient& client() const { return *client_; }

 private:
  std::shared_ptr<Stream> stream_;
  Source source_;
  std::uint64_t ticket_ = 0;
  std::unique_ptr<FakeClient> client_;
};

class Sources : public ::testing::Test {
 protected:
  Sources() {
    auto info = unbatched_stream();
    info.source = "demo";
    StreamLimits limits;
    limits.filling_patience = std::chrono::minutes(1);
    stream_ = std::make_shared<Stream>(info, limits);
    subscriber_ = std::make_unique<FakeClient>(stream_, StreamRole::subscribe);
    see();
  }
  /// What the subscriber got since: frames without a gap whose times never fall. The state of the last.
  FaceFrame see() {
    for (const auto& message : subscriber_->take_all()) {
      const auto* frames = std::get_if<Frames>(&message);
      if (frames == nullptr) continue;
      EXPECT_EQ(frames->sequence, sequence_ + 1);
      sequence_ += frames->frames.size();
      for (const auto& frame : frames->frames) {
        EXPECT_GE(frames->media_time + frame.time, newest_);
        newest_ = frames->media_time + frame.time;
        state_ = frame.state;
      }
    }
    return state_;
  }

  std::shared_ptr<Stream> stream_;
  std::unique_ptr<FakeClient> subscriber_;
  std::uint64_t sequence_ = 0, newest_ = 0;
  FaceFrame state_;
};

class Pairs : public Sources, public ::testing::WithParamInterface<std::tuple<Source, Source, bool>> {};

TEST_P(Pairs, SecondIsRefusedOrTakesOver) {
  const auto [first_source, second_source, take_over] = GetParam();
  const bool holds = first_source != Source::request && first_source != Source::demo;
  const bool claims = second_source != Source::request && second_source != Source::demo;
  Feeder first(stream_, first_source);
  Feeder second(stream_, second_source);
  ASSERT_TRUE(first.begin(false));
  ASSERT_TRUE(first.send(1, 90'000'000));
  EXPECT_EQ(see().level[3], 1);
  EXPECT_EQ(stream_->info().active_source, first_source);

  const bool may_begin = !(holds && claims) || take_over;
  EXPECT_EQ(second.begin(take_over), may_begin);
  EXPECT_EQ(see().level[3], 1) << "the face stays as it is until the new source says something";
  // Requests and the stream's own filling come between only while nobody holds the stream; the latter waits a while.
  const bool enters =
      claims ? may_begin : !holds && !(second_source == Source::demo && first_source == Source::request);
  EXPECT_EQ(second.send(2, 5), enters);
  EXPECT_EQ(see().level[3], enters ? 2 : 1);
  if (enters) {
    EXPECT_EQ(stream_->info().active_source, second_source);
  }

  const bool replaced = holds && claims && take_over;
  if (!replaced) {
    // Whoever was refused has changed nothing.
    if (holds) {
      EXPECT_TRUE(first.send(3, 90'000'040));
    }
  } else {
    EXPECT_FALSE(first.send(3, 90'000'040)) << "who was replaced is heard no more";
    EXPECT_EQ(see().level[3], 2);
  }
  if (first_source == Source::connection) {
    const auto last = first.client().take_all();
    ASSERT_FALSE(last.empty());
    const auto* end = std::get_if<End>(&last.back());
    EXPECT_EQ(end != nullptr, replaced);
    if (replaced) {
      EXPECT_EQ(end->reason, EndReason::replaced);
      EXPECT_EQ(first.client().socket->closed()->code, 1000);
      EXPECT_EQ(stream_->counts().closed_replaced, 1U);
    }
  }
  if (second_source == Source::connection && !may_begin) {
    const auto last = second.client().take_all();
    EXPECT_EQ(std::get<StreamError>(last.at(0)).code, StreamErrorCode::conflict);
    EXPECT_THAT(std::get<StreamError>(last.at(0)).message, HasSubstr("take_over"));
    EXPECT_EQ(second.client().socket->closed()->code, 1008);
  }
  see();
}

INSTANTIATE_TEST_SUITE_P(Every, Pairs,
                         ::testing::Combine(::testing::ValuesIn(all_sources), ::testing::ValuesIn(all_sources),
                                            ::testing::Bool()));

TEST_F(Sources, TakingOverFromAClockThatRunsAhead_TimeDoesNotGoBack) {
  Feeder ahead(stream_, Source::connection);
  ASSERT_TRUE(ahead.begin(false));
  ASSERT_TRUE(ahead.send(1, 1000, 1000, 10)) << "nine seconds in advance";
  see();
  const auto newest = newest_;
  for (const auto source : {Source::performance, Source::connection, Source::recording}) {
    Feeder next(stream_, source);
    ASSERT_TRUE(next.begin(true));
    ASSERT_TRUE(next.send(2, 77));
    EXPECT_EQ(see().level[3], 2);
    EXPECT_EQ(newest_, newest) << "its frames wait for the moment that has been reached already";
  }
}

/// Any mix of sources that begin, take over, send and go, with clocks of any kind: see() watches.
TEST_F(Sources, RandomSequences_NoGapAndNoWayBackInTime) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    std::mt19937 random(seed);
    const auto below = [&](std::uint64_t n) { return random() % n; };
    std::vector<std::unique_ptr<Feeder>> feeders;
    for (int step = 0; step < 60; ++step) {
      if (feeders.empty() || below(4) == 0) {
        auto feeder = std::make_unique<Feeder>(stream_, all_sources[below(all_sources.size())]);
        if (feeder->begin(below(2) == 0)) feeders.push_back(std::move(feeder));
      } else if (below(8) == 0) {
        feeders.erase(feeders.begin() + static_cast<std::ptrdiff_t>(below(feeders.size())));
      } else {
        const std::uint64_t clock = below(3) == 0 ? 0 : below(3) == 0 ? below(1ULL << 52U) : 1'000'000 + below(20'000);
        feeders[below(feeders.size())]->send(static_cast<std::int16_t>(1 + below(200)), clock,
                                             static_cast<std::uint32_t>(below(4) == 0 ? below(3000) : below(50)),
                                             1 + below(4));
      }
      see();
      if (HasFailure()) FAIL() << "seed " << seed << " step " << step;
    }
    EXPECT_EQ(sequence_, stream_->info().sequence);
  }
  EXPECT_GT(sequence_, 200U);
}

TEST(Floods, PublisherIsToldOnceASecondThenClosed) {
  StreamLimits limits;
  limits.publisher = {0, 20, milliseconds(0)};  // so that no time that passes here earns anything
  const auto stream = std::make_shared<Stream>(unbatched_stream(), limits);
  FakeClient publisher(stream, StreamRole::publish);
  publisher.take_all();
  const auto send = [&](std::size_t count) {
    publisher.connection->receive(encode_json(Frames{0, 0, std::vector<TimedFrame>(count)}), false);
  };
  send(20);
  EXPECT_TRUE(publisher.take_all().empty());
  send(20);  // no patience at all in this test
  const auto said = publisher.take_all();
  ASSERT_EQ(said.size(), 1U);
  const auto& error = std::get<StreamError>(said[0]);
  EXPECT_EQ(error.code, StreamErrorCode::throttled);
  EXPECT_THAT(error.message, HasSubstr("more than 0 frames per second, or 20 at once: 20 frames in 1 message"));
  ASSERT_TRUE(publisher.socket->closed());
  EXPECT_EQ(publisher.socket->closed()->code, 1008);
  EXPECT_EQ(stream->counts().throttled, 20U);
  EXPECT_EQ(stream->counts().closed_flooding, 1U);
  FakeClient next(stream, StreamRole::publish);
  EXPECT_FALSE(next.socket->closed()) << "its place is free";
}

TEST(Floods, ThousandsOfMessages_GetOneAnswer) {
  StreamLimits limits;
  limits.publisher = {1, 1, std::chrono::hours(1)};
  const auto stream = std::make_shared<Stream>(unbatched_stream(), limits);
  FakeClient publisher(stream, StreamRole::publish);
  publisher.take_all();
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 5000; ++i) publisher.connection->receive(encode_json(Frames{0, 0, {TimedFrame{}, {}}}), false);
  const auto seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_LE(static_cast<double>(publisher.take_all().size()), 2.0 + seconds);
  EXPECT_EQ(stream->counts().throttled, 10'000U);
  EXPECT_FALSE(publisher.socket->closed());
}

TEST(Floods, RequestsOfAStreamShareOneLimit) {
  StreamLimits limits;
  limits.publisher = {0, 5, milliseconds(0)};
  const auto stream = std::make_shared<Stream>(unbatched_stream(), limits);
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(stream->publish_request({TimedFrame{}}));
  const auto refused = stream->publish_request(std::vector<TimedFrame>(5));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::too_large);
  EXPECT_EQ(stream->info().sequence, 5U);
}

}  // namespace
}  // namespace semblante::streams
