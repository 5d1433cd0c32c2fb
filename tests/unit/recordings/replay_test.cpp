// What was recorded is played again frame by frame: the same faces at the same distances.
#include <gtest/gtest.h>

#include "protocol/cpp/face_values.h"
#include "server/recordings/recording_source.h"
#include "server/recordings/recording_writer.h"
#include "server/streams/batch_listener.h"
#include "server/streams/player.h"
#include "tests/unit/recordings/recorded_frames.h"

namespace semblante::recordings {
namespace {

using streams::Player;
using streams::PlayOptions;

/// Keeps what a stream has.
class Listener : public streams::BatchListener {
 public:
  void taken(std::string_view /*stream*/, std::uint64_t /*epoch*/, const Frames& batch) override {
    for (std::size_t i = 0; i < batch.frames.size(); ++i)
      frames.push_back({batch.sequence + i, batch.media_time + batch.frames[i].time, batch.frames[i].state});
  }
  void ended(std::string_view /*stream*/) override {}
  std::vector<RecordingFrame> frames;
};

/// Frames with the first at time 0, numbered from 0: what two recordings must have in common.
std::vector<RecordingFrame> relative(std::vector<RecordingFrame> frames) {
  for (std::size_t i = frames.size(); i-- > 0;) {
    frames[i].media_time -= frames[0].media_time;
    frames[i].sequence = i;
  }
  return frames;
}

class Replay : public ::testing::Test {
 protected:
  Replay() { stream_->set_listener(listener_); }

  static std::vector<std::uint8_t> recording_of(const std::vector<RecordingFrame>& frames,
                                                const Header& header = stream_header()) {
    auto bytes = encode_beginning(header);
    for (std::size_t i = 0; i < frames.size(); i += 50) {
      const auto chunk = encode_chunk(std::span(frames).subspan(i, std::min<std::size_t>(50, frames.size() - i)), 0);
      bytes.insert(bytes.end(), chunk.begin(), chunk.end());
    }
    return bytes;
  }
  static std::shared_ptr<const streams::FrameSource> source_of(const std::vector<RecordingFrame>& frames) {
    auto source = make_recording_source(bytes_in_memory(recording_of(frames)), "talk");
    EXPECT_TRUE(source);
    return *source;
  }
  Player player(const std::shared_ptr<const streams::FrameSource>& source, const PlayOptions& options = {}) {
    const auto ticket = stream_->begin_playing(options.rate, false);
    EXPECT_TRUE(ticket);
    return {"1", stream_, ticket ? *ticket : 0, source, options, begin_};
  }
  Player::Clock::time_point at(double ms) const {
    return begin_ + std::chrono::microseconds(static_cast<std::int64_t>(ms * 1000.0));
  }
  /// Plays to the end with a thread that is now and then late by up to `late` ms.
  void play_out(Player& playing, double late) {
    std::mt19937 random(3);
    auto now = begin_;
    playing.play(now);
    while (!playing.finished()) {  // a finished player has no next time
      now =
          std::max(now, playing.next()) + std::chrono::microseconds(static_cast<std::int64_t>(random() % 1000 * late));
      playing.play(now);
    }
  }

  std::shared_ptr<Listener> listener_ = std::make_shared<Listener>();
  std::shared_ptr<streams::Stream> stream_ = [] {
    streams::StreamInfo info;
    info.id = "s";
    info.epoch = 9;
    info.settings.batch_interval = 0;
    return std::make_shared<streams::Stream>(info, streams::StreamLimits{});
  }();
  Player::Clock::time_point begin_ = Player::Clock::now() + std::chrono::milliseconds(5'123);
};

TEST_F(Replay, EveryFrame_AtItsTime_HoweverLateTheThread) {
  const auto frames = random_frames(3000, 1);
  for (const double late : {0.0, 30.0, 4000.0}) {
    listener_->frames.clear();
    begin_ = std::max(begin_, stream_->newest_frame_time());  // no frame falls behind those of the round before
    auto playing = player(source_of(frames));
    play_out(playing, late);
    EXPECT_TRUE(relative(listener_->frames) == relative(frames)) << late;
  }
}

TEST_F(Replay, RecordedAgain_IsTheSameRecording) {
  const Folder folder;
  const auto frames = random_frames(2000, 2);
  auto playing = player(source_of(frames));
  play_out(playing, 200.0);
  auto writer = RecordingWriter::create(folder.file("again.srec"), stream_header());
  ASSERT_TRUE(writer);
  for (const auto& batch : in_batches(listener_->frames, 5)) ASSERT_TRUE((*writer)->add(batch));
  ASSERT_TRUE((*writer)->flush());
  auto source = make_recording_source(bytes_in_memory(bytes_of(folder.file("again.srec"))), "again");
  ASSERT_TRUE(source);
  std::vector<RecordingFrame> again;
  const auto cursor = (*source)->frames_from(0.0);
  for (; cursor->time(); cursor->advance())
    again.push_back({again.size(), static_cast<std::uint64_t>(*cursor->time()), cursor->frame()});
  EXPECT_TRUE(again == relative(frames));
}

TEST_F(Replay, ManyDueAtOnce_AreSentInBoundedPieces) {
  const auto frames = random_frames(2000, 3);
  auto playing = player(source_of(frames));
  const auto late = at(3'600'000.0);
  std::size_t before = 0;
  while (!playing.finished()) {
    ASSERT_LE(playing.next(), late);
    playing.play(late);
    EXPECT_LE(listener_->frames.size() - before, Player::most_at_once);
    before = listener_->frames.size();
  }
  EXPECT_TRUE(relative(listener_->frames) == relative(frames));
  EXPECT_EQ(playing.next(), Player::Clock::time_point::max());
}

TEST_F(Replay, FromTheMiddle_BeginsWithTheFaceThatHoldsThere) {
  const auto frames = random_frames(100, 4);
  const auto all = relative(frames);
  std::size_t k = 50;
  while (all[k].media_time - all[k - 1].media_time < 2) ++k;
  PlayOptions options;
  options.from = static_cast<double>(all[k].media_time - 1);
  auto playing = player(source_of(frames), options);
  play_out(playing, 0.0);
  ASSERT_EQ(listener_->frames.size(), frames.size() - k + 1);
  EXPECT_EQ(listener_->frames[0].state, frames[k - 1].state);
  for (std::size_t i = k; i < frames.size(); ++i) {
    const auto& played = listener_->frames[i - k + 1];
    EXPECT_EQ(played.state, frames[i].state);
    EXPECT_EQ(played.media_time - listener_->frames[0].media_time, frames[i].media_time - frames[k].media_time + 1);
  }
}

TEST_F(Replay, Looped_GoesOnAfterTheMeanFrame) {
  const std::vector<RecordingFrame> frames = [] {
    auto made = random_frames(4, 5);
    made[1].media_time = made[0].media_time + 30;
    made[2].media_time = made[0].media_time + 70;
    made[3].media_time = made[0].media_time + 90;
    return made;
  }();
  PlayOptions options;
  options.loop = true;
  options.from = 70.0;
  auto playing = player(source_of(frames), options);
  while (listener_->frames.size() < 10) playing.play(playing.next());
  std::vector<std::uint64_t> times;
  for (const auto& frame : listener_->frames) times.push_back(frame.media_time - listener_->frames[0].media_time);
  // 120 ms a round: the last frame lasts 30 ms, as the others do in the mean.
  EXPECT_EQ(times, (std::vector<std::uint64_t>{0, 20, 50, 80, 120, 140, 170, 200, 240, 260}));
  EXPECT_EQ(listener_->frames[2].state, frames[0].state);
  EXPECT_EQ(playing.status(at(60.0)).position, 10.0);
  playing.stop();
  EXPECT_EQ(listener_->frames.back().state, FaceFrame{});
}

TEST_F(Replay, OtherSteps_GoToTheNearestLevel) {
  auto frames = random_frames(20, 6);
  Header fine = stream_header();
  for (std::size_t fap = first_low_level_fap; fap <= last_low_level_fap; ++fap)
    fine.quantizers.push_back(standard_quantizers()[fap] / 4.0);
  auto source = make_recording_source(bytes_in_memory(recording_of(frames, fine)), "fine");
  ASSERT_TRUE(source);
  auto playing = player(*source);
  play_out(playing, 0.0);
  ASSERT_EQ(listener_->frames.size(), frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i)
    EXPECT_EQ(listener_->frames[i].state,
              to_frame(to_values(frames[i].state, quantizers_of(fine)), standard_quantizers()));
}

TEST_F(Replay, WithoutFramesOrDamaged_IsRefused) {
  EXPECT_EQ(make_recording_source(bytes_in_memory(encode_beginning(stream_header())), "").error().code,
            ErrorCode::empty);
  EXPECT_EQ(make_recording_source(bytes_in_memory({1, 2, 3}), "").error().code, ErrorCode::truncated);
}

}  // namespace
}  // namespace semblante::recordings
