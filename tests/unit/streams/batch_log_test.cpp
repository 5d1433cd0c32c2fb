// Frames become batches, and readers begin somewhere in them: the log alone, in a time of the tests' own.

#include "server/streams/batch_log.h"

#include <random>

#include <gtest/gtest.h>

#include "protocol/cpp/frame_codec.h"
#include "protocol/cpp/json_codec.h"
#include "tests/unit/streams/unframed.h"

namespace semblante::streams {
namespace {

using Clock = BatchLog::Clock;
using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::array codings = {Coding::packed, Coding::json};
const Clock::time_point began{hours(1)};

/// The frame whose sequence number a reader can tell from its face.
TimedFrame numbered(std::uint64_t sequence, std::uint32_t time = 0) {
  TimedFrame frame;
  frame.time = time;
  frame.state.level[3] = static_cast<std::int16_t>(sequence % 1000);
  frame.state.level[48] = static_cast<std::int16_t>(sequence * 7 % 500);
  return frame;
}

/// What a reader gets: the number of the last frame of each message, after a look at every face.
class Reader {
 public:
  explicit Reader(Coding coding) : coding_(coding) {}

  void read(const http::WireMessage& wire) {
    for (const auto& payload : unframed(wire.bytes)) {
      auto message = coding_ == Coding::json
                         ? decode_json(payload)
                         : decoder_.decode({reinterpret_cast<const std::uint8_t*>(payload.data()), payload.size()});
      ASSERT_TRUE(message) << message.error().message << " at " << message.error().where;
      if (const auto* key = std::get_if<Keyframe>(&*message)) {
        EXPECT_EQ(key->state, numbered(key->sequence).state);
        sequence = key->sequence;
        media_time = key->media_time;
        ++keyframes;
        continue;
      }
      const auto& frames = std::get<Frames>(*message);
      EXPECT_EQ(frames.sequence, sequence + 1) << "no gap";
      for (const auto& frame : frames.frames) {
        EXPECT_EQ(frame.state, numbered(++sequence).state);
        EXPECT_GE(frames.media_time + frame.time, media_time);
        media_time = frames.media_time + frame.time;
      }
      ++batches;
    }
  }

  std::uint64_t sequence = 0, media_time = 0;
  std::size_t keyframes = 0, batches = 0;

 private:
  Coding coding_;
  FrameDecoder decoder_;
};

class BatchLogTest : public ::testing::Test {
 protected:
  /// Adds `count` frames with the next numbers, 10 ms apart, at now_.
  std::shared_ptr<Batch> add(BatchLog& log, std::size_t count = 1) {
    std::vector<TimedFrame> frames;
    for (std::size_t i = 0; i < count; ++i)
      frames.push_back(numbered(log.taken() + 1 + i, static_cast<std::uint32_t>(10 * i)));
    const auto media_time = media_time_;
    media_time_ += 10 * count;
    return log.add(media_time, frames, now_);
  }
  std::shared_ptr<Batch> add_batch(BatchLog& log, std::size_t frames = 1) {
    EXPECT_EQ(add(log, frames), nullptr);
    return log.close(log.due(), now_);
  }
  static BatchLogOptions options(milliseconds interval, StreamLimits limits = {}) {
    BatchLogOptions options;
    options.epoch = 7;
    options.interval = interval;
    options.limits = limits;
    options.began = began;
    return options;
  }

  Clock::time_point now_ = began;
  std::uint64_t media_time_ = 0;
};

TEST_F(BatchLogTest, Batches_AreDueAtMultiplesOfTheInterval) {
  BatchLog log(options(milliseconds(100)));
  EXPECT_EQ(log.due(), Clock::time_point::max()) << "nothing gathers";
  now_ = began + milliseconds(730);
  add(log);
  EXPECT_EQ(log.due(), began + milliseconds(800));
  now_ = began + milliseconds(799);
  add(log);
  EXPECT_EQ(log.due(), began + milliseconds(800)) << "the first frame decides";
  const auto batch = log.close(log.due(), began + milliseconds(805));
  EXPECT_EQ(batch->number, 1U);
  EXPECT_EQ(batch->due, began + milliseconds(800));
  EXPECT_EQ(batch->message.frames.size(), 2U);
  EXPECT_EQ(log.due(), Clock::time_point::max());
  now_ = began + milliseconds(900);
  add(log);
  EXPECT_EQ(log.due(), began + milliseconds(1000)) << "at a multiple, the next one";
}

TEST_F(BatchLogTest, WithoutInterval_ABatchIsDueAtOnce) {
  BatchLog log(options(milliseconds(0)));
  now_ += milliseconds(123);
  add(log);
  EXPECT_EQ(log.due(), now_);
}

TEST_F(BatchLogTest, Sequence_IsTakenAtOnce_AndToldWhenTheBatchIsClosed) {
  BatchLog log(options(seconds(1)));
  add(log, 3);
  EXPECT_EQ(log.taken(), 3U);
  EXPECT_EQ(log.sequence(), 0U);
  EXPECT_EQ(log.batches(), 0U);
  EXPECT_EQ(log.close(log.due(), now_)->message.sequence, 1U);
  EXPECT_EQ(log.sequence(), 3U);
  EXPECT_EQ(log.batches(), 1U);
}

TEST_F(BatchLogTest, MediaTimes_OfWhatIsGathered_AreKept) {
  BatchLog log(options(seconds(1)));
  log.add(5000, {numbered(1), numbered(2, 40)}, now_);
  log.add(5040, {numbered(3), numbered(4, 15)}, now_);
  const auto batch = log.close(log.due(), now_);
  EXPECT_EQ(batch->message.media_time, 5000U);
  std::vector<std::uint32_t> times;
  for (const auto& frame : batch->message.frames) times.push_back(frame.time);
  EXPECT_EQ(times, (std::vector<std::uint32_t>{0, 40, 40, 55}));
}

TEST_F(BatchLogTest, FramesThatDoNotFit_CloseTheBatchBefore) {
  BatchLog log(options(seconds(1)));
  std::vector<TimedFrame> many;
  for (std::size_t i = 0; i < max_frames_per_message; ++i) many.push_back(numbered(i + 1));
  EXPECT_EQ(log.add(0, many, now_), nullptr);
  now_ += milliseconds(5);
  const auto full = log.add(0, {numbered(many.size() + 1)}, now_);
  ASSERT_TRUE(full) << "too many for one message";
  EXPECT_EQ(full->message.frames.size(), many.size());
  EXPECT_EQ(full->due, now_) << "its time came early";
  EXPECT_EQ(log.add(max_frame_time, {numbered(many.size() + 2)}, now_), nullptr);
  const auto too_long = log.add(max_frame_time + 1, {numbered(many.size() + 3)}, now_);
  ASSERT_TRUE(too_long) << "too long a time for one message";
  EXPECT_EQ(too_long->message.sequence, many.size() + 1);
  EXPECT_EQ(log.close(log.due(), now_)->message.sequence, many.size() + 3);
}

TEST_F(BatchLogTest, Wires_AreEncodedOnce_AndCarryWhenTheyWereDue) {
  auto with_lateness = options(milliseconds(100));
  with_lateness.lateness = std::make_shared<metrics::LatenessHistogram>(metrics::lateness_bounds);
  BatchLog log(with_lateness);
  const auto batch = add_batch(log);
  for (const auto coding : codings) {
    const auto first = log.wire(*batch, coding);
    const auto spent = log.encode_seconds();
    EXPECT_EQ(log.wire(*batch, coding), first);
    EXPECT_EQ(log.encode_seconds(), spent);
    EXPECT_EQ(first->due, batch->due);
    EXPECT_EQ(first->lateness, with_lateness.lateness);
  }
  EXPECT_GT(log.encode_seconds(), 0.0);
  EXPECT_EQ(log.join_point(Coding::json)->lateness, nullptr) << "a join point is not late";
}

TEST_F(BatchLogTest, JoinPoint_IsTheStateAfterTheNewestBatch_InEachCoding) {
  for (const auto coding : codings) {
    BatchLog log(options(seconds(1)));
    Reader neutral(coding);
    EXPECT_EQ(unframed(log.join_point(coding)->bytes).size(), 1U) << "also before the first frame";
    add_batch(log, 3);
    add(log);
    const auto join_point = log.join_point(coding);
    EXPECT_EQ(log.join_point(coding), join_point) << "shared by all who join here";
    Reader reader(coding);
    reader.read(*join_point);
    EXPECT_EQ(reader.sequence, 3U) << "what gathers comes with its batch";
    reader.read(*log.wire(*log.close(log.due(), now_), coding));
    EXPECT_EQ(reader.sequence, 4U);
    EXPECT_NE(log.join_point(coding), join_point);
    EXPECT_EQ(reader.keyframes, 1U);
  }
}

TEST_F(BatchLogTest, Resume_AtTheEndOfAnyHeldBatch_BringsWhatFollowed_InEachCoding) {
  for (const auto coding : codings) {
    BatchLog log(options(seconds(1)));
    for (std::size_t i = 1; i <= 6; ++i) add_batch(log, i);  // they end at 1, 3, 6, 10, 15, 21
    const auto last = log.sequence();
    std::uint64_t end = 0;
    for (std::size_t i = 0; i <= 6; ++i) {
      end += i;
      const auto begin = log.begin(coding, ResumePoint{7, end});
      EXPECT_TRUE(begin.recovered) << end;
      Reader reader(coding);
      reader.read(*begin.wire);
      EXPECT_EQ(reader.sequence, last);
      EXPECT_EQ(reader.batches, 6 - i);
      EXPECT_EQ(reader.keyframes, 1U);
      EXPECT_EQ(begin.wire == log.join_point(coding), i == 6) << "who missed nothing joins like anyone";
    }
  }
}

TEST_F(BatchLogTest, Resume_WhereNoBatchEnded_OrInAnotherLife_BringsTheJoinPoint) {
  BatchLog log(options(seconds(1)));
  add_batch(log, 3);
  add_batch(log, 3);
  add(log, 2);
  for (const auto& [point, why] : {std::pair{ResumePoint{7, 2}, "in the middle of a batch"},
                                   {ResumePoint{7, 7}, "still gathering"},
                                   {ResumePoint{7, 900}, "a future it cannot have seen"},
                                   {ResumePoint{6, 3}, "another epoch"},
                                   {ResumePoint{8, 6}, "another epoch's newest"}}) {
    const auto begin = log.begin(Coding::packed, point);
    EXPECT_FALSE(begin.recovered) << why;
    EXPECT_EQ(begin.wire, log.join_point(Coding::packed)) << why;
  }
  EXPECT_FALSE(log.begin(Coding::packed, std::nullopt).recovered);
}

TEST_F(BatchLogTest, Hold_ExpiresByCount) {
  StreamLimits limits;
  limits.held_batches = 3;
  BatchLog log(options(seconds(1), limits));
  for (int i = 0; i < 5; ++i) add_batch(log);
  EXPECT_FALSE(log.begin(Coding::json, ResumePoint{7, 1}).recovered) << "the batch after it is forgotten";
  for (const std::uint64_t sequence : {2, 3, 4, 5})
    EXPECT_TRUE(log.begin(Coding::json, ResumePoint{7, sequence}).recovered) << sequence;
}

TEST_F(BatchLogTest, Hold_ExpiresByTime) {
  StreamLimits limits;
  limits.held_time = seconds(30);
  BatchLog log(options(seconds(1), limits));
  add_batch(log);
  now_ += seconds(1);
  add_batch(log);
  now_ += seconds(29);
  add_batch(log);
  EXPECT_TRUE(log.begin(Coding::json, ResumePoint{7, 0}).recovered) << "30 s ago";
  now_ += milliseconds(1);
  add_batch(log);
  EXPECT_FALSE(log.begin(Coding::json, ResumePoint{7, 0}).recovered) << "longer ago";
  EXPECT_TRUE(log.begin(Coding::json, ResumePoint{7, 1}).recovered);
}

TEST_F(BatchLogTest, Gap_OfTooManyFrames_IsNotSent) {
  StreamLimits limits;
  limits.resumed_frames = 5;
  BatchLog log(options(seconds(1), limits));
  for (int i = 0; i < 4; ++i) add_batch(log, 2);
  EXPECT_FALSE(log.begin(Coding::json, ResumePoint{7, 2}).recovered) << "six frames";
  EXPECT_TRUE(log.begin(Coding::json, ResumePoint{7, 4}).recovered) << "four";
}

TEST_F(BatchLogTest, Gap_OfTooManyBytes_IsNotSent) {
  BatchLog unlimited(options(seconds(1)));
  for (int i = 0; i < 3; ++i) add_batch(unlimited);
  const auto size = unlimited.begin(Coding::json, ResumePoint{7, 1}).wire->bytes.size();
  for (const std::size_t most : {size, size - 1}) {
    StreamLimits limits;
    limits.resumed_bytes = most;
    BatchLog log(options(seconds(1), limits));
    media_time_ = 0;
    for (int i = 0; i < 3; ++i) add_batch(log);
    EXPECT_EQ(log.begin(Coding::json, ResumePoint{7, 1}).recovered, most == size);
  }
}

/// Readers of every coding that come at any time, go and come back: each sees every frame since its keyframe once.
TEST_F(BatchLogTest, RandomReaders_SeeAnUnbrokenRow) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    const auto below = [&](std::uint64_t n) { return random() % n; };
    StreamLimits limits;
    limits.held_batches = 20;
    limits.resumed_frames = 60;
    BatchLog log(options(milliseconds(50), limits));
    struct Listener {
      Reader reader;
      Coding coding;
      bool listens = true;
    };
    std::vector<Listener> listeners;
    std::size_t recovered = 0, lost = 0;
    const auto send = [&](const std::shared_ptr<Batch>& batch) {
      for (auto& listener : listeners)
        if (listener.listens) listener.reader.read(*log.wire(*batch, listener.coding));
    };
    add_batch(log);
    for (int step = 0; step < 200; ++step) {
      now_ += milliseconds(below(40));
      if (const auto full = add(log, 1 + below(6))) send(full);
      if (now_ >= log.due()) send(log.close(log.due(), now_));
      if (listeners.empty() || below(10) == 0) {
        const auto coding = codings[below(codings.size())];
        listeners.push_back({Reader(coding), coding});
        listeners.back().reader.read(*log.begin(coding, std::nullopt).wire);
      }
      auto& listener = listeners[below(listeners.size())];
      if (!listener.listens) {
        const auto begin = log.begin(listener.coding, ResumePoint{7, listener.reader.sequence});
        ++(begin.recovered ? recovered : lost);
        const auto seen = listener.reader.sequence;
        Reader back(listener.coding);
        back.read(*begin.wire);
        EXPECT_TRUE(!begin.recovered || back.sequence >= seen);
        EXPECT_EQ(back.sequence, log.sequence());
        listener.reader = std::move(back);
        listener.listens = true;
      } else if (below(3) == 0) {
        listener.listens = false;
      }
      if (HasFailure()) FAIL() << "seed " << seed << " step " << step;
    }
    for (const auto& listener : listeners) {
      EXPECT_TRUE(!listener.listens || listener.reader.sequence == log.sequence());
    }
    EXPECT_GT(recovered, 0U);
    EXPECT_GT(lost, 0U);
  }
}

}  // namespace
}  // namespace semblante::streams
