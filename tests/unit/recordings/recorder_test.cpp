// What the recorder hears is on the disk, whole, counted, and within its limits.
#include "server/recordings/recorder.h"

#include <fstream>
#include <sqlite3.h>
#include <thread>

#include <gtest/gtest.h>

#include "server/recordings/recording_reader.h"
#include "server/store/sqlite_store.h"
#include "tests/support/failing_database.h"
#include "tests/support/wait.h"
#include "tests/unit/recordings/recorded_frames.h"

namespace semblante::recordings {
namespace {

using std::chrono::milliseconds;
using store::RecordingRecord;
using store::RecordingState;

class RecorderTest : public ::testing::Test {
 protected:
  RecorderTest() {
    test::fail_database_writes(SQLITE_OK);
    auto opened = store::open_sqlite_store(folder_.file("facts.sqlite"));
    EXPECT_TRUE(opened);
    store_ = std::move(*opened);
    limits_.flush_interval = milliseconds(20);
    limits_.disk_reserve = 0;
  }
  void begin() {
    recorder_.reset();
    recorder_ = Recorder::open(*store_, *store_, pending_, folder_.file("recordings"), limits_);
  }
  RecordingRecord start(std::optional<std::uint64_t> max_duration = std::nullopt) {
    auto record = recorder_->start({stream_header(), "take", max_duration}, std::nullopt);
    EXPECT_TRUE(record) << record.error().message;
    return record ? *record : RecordingRecord{};
  }
  void hear(const std::vector<RecordingFrame>& frames) {
    for (const auto& batch : in_batches(frames, 1)) recorder_->taken("talk", 7, batch);
  }
  RecordingRecord wait_until_it_ends(const std::string& id) {
    testing::eventually([&] { return recorder_->find(id)->record.state != RecordingState::recording; });
    return recorder_->find(id)->record;
  }
  void wait_for_frames(const std::string& id, std::size_t count) {
    EXPECT_TRUE(testing::eventually([&] { return recorder_->find(id)->record.frames >= count; }));
  }
  std::vector<RecordingFrame> frames_of(const std::string& id) {
    auto bytes = open_bytes(recorder_->path_of(id));
    EXPECT_TRUE(bytes);
    auto reader = RecordingReader::open(*bytes, Check::everything);
    EXPECT_TRUE(reader);
    EXPECT_EQ(reader->torn_bytes(), 0U);
    std::vector<RecordingFrame> frames;
    RecordingCursor cursor(std::make_shared<const RecordingReader>(*reader), 0);
    for (; cursor.frame() != nullptr; cursor.advance()) frames.push_back(*cursor.frame());
    return frames;
  }

  Folder folder_;
  RecorderLimits limits_;
  std::unique_ptr<store::Store> store_;
  store::PendingWrites pending_{{}};
  std::shared_ptr<Recorder> recorder_;
};

TEST_F(RecorderTest, Stopped_HasEveryFrame) {
  begin();
  const auto record = start();
  EXPECT_EQ(store_->recording(record.id)->state, RecordingState::recording);
  const auto frames = random_frames(5000, 1);
  hear(frames);
  const auto stopped = recorder_->stop(record.id);
  ASSERT_TRUE(stopped);
  EXPECT_EQ(stopped->state, RecordingState::finished);
  EXPECT_EQ(stopped->ended, ended::stopped);
  EXPECT_EQ(stopped->frames, frames.size());
  EXPECT_EQ(stopped->lost, 0U);
  EXPECT_EQ(stopped->duration, frames.back().media_time - frames.front().media_time);
  EXPECT_EQ(stopped->media_time, frames.front().media_time);
  EXPECT_EQ(stopped->bytes, std::filesystem::file_size(recorder_->path_of(record.id)));
  EXPECT_EQ(stopped->model, "head");
  EXPECT_EQ(frames_of(record.id), frames);
  EXPECT_EQ(recorder_->stop(record.id), stopped) << "it stays as it is";
  EXPECT_EQ(recorder_->stop("absent"), std::nullopt);
  EXPECT_EQ(recorder_->counts().running, 0U);
  EXPECT_EQ(recorder_->counts().frames, frames.size());
}

TEST_F(RecorderTest, Running_SaysWhatIsDurable) {
  begin();
  const auto record = start();
  const auto frames = random_frames(300, 2);
  hear(frames);
  wait_for_frames(record.id, frames.size());
  const auto now = recorder_->find(record.id)->record;
  EXPECT_EQ(now.frames, frames.size()) << "without being stopped";
  EXPECT_EQ(now.duration, frames.back().media_time - frames.front().media_time);
  EXPECT_EQ(now.state, RecordingState::recording);
  EXPECT_EQ(frames_of(record.id), frames);
}

TEST_F(RecorderTest, OtherStreamsAndOtherLives_AreNotInIt) {
  begin();
  const auto record = start();
  recorder_->taken("walk", 7, {42, 5, {{0, {}}}});
  recorder_->taken("talk", 8, {42, 5, {{0, {}}}});
  recorder_->ended("walk");
  const auto frames = random_frames(20, 3);
  hear(frames);
  recorder_->ended("talk");
  recorder_->taken("talk", 7, {500, 500'000, {{0, {}}}});
  const auto done = wait_until_it_ends(record.id);
  EXPECT_EQ(done.ended, ended::stream_ended);
  EXPECT_EQ(frames_of(record.id), frames);
}

TEST_F(RecorderTest, TwoOfOneStream_EachHaveIt) {
  begin();
  const auto first = start();
  const auto frames = random_frames(100, 4);
  hear({frames.begin(), frames.begin() + 50});
  const auto second = start();
  hear({frames.begin() + 50, frames.end()});
  recorder_->close();
  EXPECT_EQ(store_->recording(first.id)->ended, ended::server_stopped);
  EXPECT_EQ(frames_of(first.id), frames);
  EXPECT_EQ(frames_of(second.id), (std::vector<RecordingFrame>{frames.begin() + 50, frames.end()}));
  EXPECT_FALSE(recorder_->start({stream_header(), "late", std::nullopt}, std::nullopt));
}

TEST_F(RecorderTest, MoreThanTheQueueTakes_IsAGapThatIsCounted) {
  limits_.queued_frames = 100;
  begin();
  const auto record = start();
  const auto frames = random_frames(231, 5);
  const auto batch_of = [&](std::size_t from, std::size_t count) {
    Frames batch{frames[from].sequence, frames[from].media_time, {}};
    for (std::size_t i = from; i < from + count; ++i)
      batch.frames.push_back({static_cast<std::uint32_t>(frames[i].media_time - batch.media_time), frames[i].state});
    return batch;
  };
  recorder_->taken("talk", 7, batch_of(0, 10));
  wait_for_frames(record.id, 10);
  recorder_->taken("talk", 7, batch_of(10, 101));
  recorder_->taken("talk", 7, batch_of(111, 10));
  wait_for_frames(record.id, 20);
  recorder_->taken("talk", 7, batch_of(121, 110));
  EXPECT_EQ(recorder_->find(record.id)->dropped, 211U);
  const auto stopped = recorder_->stop(record.id);
  EXPECT_EQ(stopped->frames, 20U);
  EXPECT_EQ(stopped->lost, 211U) << "those at the end are lost as well";
  EXPECT_EQ(recorder_->counts().dropped, 211U);
  std::vector<RecordingFrame> kept(frames.begin(), frames.begin() + 10);
  kept.insert(kept.end(), frames.begin() + 111, frames.begin() + 121);
  EXPECT_EQ(frames_of(record.id), kept);
}

TEST_F(RecorderTest, Limits_EndItOrRefuseIt) {
  limits_.max_bytes = 2 * max_chunk_bytes;
  limits_.max_recordings = 2;
  limits_.max_running = 1;
  begin();
  const auto record = start();
  EXPECT_EQ(recorder_->start({stream_header(), "", std::nullopt}, std::nullopt).error().code, ErrorCode::too_large);
  auto frames = random_frames(30'000, 6);
  for (std::size_t i = 0; i < frames.size() && recorder_->counts().running > 0; i += 1000) {
    hear({frames.begin() + static_cast<std::ptrdiff_t>(i), frames.begin() + static_cast<std::ptrdiff_t>(i + 1000)});
    EXPECT_TRUE(testing::eventually(
        [&] { return recorder_->counts().running == 0 || recorder_->find(record.id)->record.frames >= i + 1000; }));
  }
  const auto done = wait_until_it_ends(record.id);
  EXPECT_EQ(done.ended, ended::max_bytes);
  EXPECT_LE(done.bytes, limits_.max_bytes);
  EXPECT_GT(done.frames, 1000U);
  const auto second = start();
  recorder_->stop(second.id);
  EXPECT_EQ(recorder_->start({stream_header(), "", std::nullopt}, std::nullopt).error().code, ErrorCode::too_large);
  EXPECT_TRUE(recorder_->remove(second.id));
  EXPECT_FALSE(recorder_->remove(second.id));
  EXPECT_FALSE(std::filesystem::exists(recorder_->path_of(second.id)));
  start();
}

TEST_F(RecorderTest, DiskNearlyFull_IsRefusedAndEndsWhatRuns) {
  limits_.disk_reserve = UINT64_MAX / 2;
  begin();
  EXPECT_THROW(static_cast<void>(recorder_->start({stream_header(), "", std::nullopt}, std::nullopt)),
               store::NotEnoughRoom);
}

TEST_F(RecorderTest, EndThatCannotBeRecorded_IsNotShown_AndIsRecordedWithRoom) {
  begin();
  const auto record = start();
  const auto frames = random_frames(100, 9);
  hear(frames);
  {
    const test::FullDatabaseDisk full;
    const auto stopped = recorder_->stop(record.id);
    ASSERT_TRUE(stopped);
    EXPECT_EQ(stopped->state, RecordingState::recording) << "it is not ended before this is durable";
    EXPECT_EQ(stopped->frames, frames.size()) << "its frames are in its file";
    EXPECT_EQ(recorder_->with_progress(*store_->recording(record.id)).record.frames, frames.size());
    EXPECT_EQ(recorder_->counts().running, 0U);
    EXPECT_EQ(pending_.status().what, std::vector<std::string>{"the end of recording " + record.id});
    EXPECT_THROW(recorder_->remove(record.id), store::DiskFull);
    EXPECT_TRUE(std::filesystem::exists(recorder_->path_of(record.id)));
    EXPECT_THROW(static_cast<void>(recorder_->start({stream_header(), "", std::nullopt}, std::nullopt)),
                 store::DiskFull);
  }
  const auto ended = wait_until_it_ends(record.id);
  EXPECT_EQ(ended.state, RecordingState::finished);
  EXPECT_EQ(ended.ended, ended::stopped);
  EXPECT_EQ(store_->recording(record.id)->frames, frames.size());
  EXPECT_EQ(frames_of(record.id), frames);
}

TEST_F(RecorderTest, RemovedWhileItsEndIsPending_IsGone) {
  begin();
  const auto record = start();
  hear(random_frames(10, 1));
  {
    const test::FullDatabaseDisk full;
    recorder_->stop(record.id);
  }
  EXPECT_TRUE(recorder_->remove(record.id));
  EXPECT_FALSE(recorder_->find(record.id));
  EXPECT_EQ(recorder_->counts().bytes, 0U);
}

TEST_F(RecorderTest, StartsOnAFullDisk_AndRepairsWithRoom) {
  begin();
  const auto record = start();
  const auto frames = random_frames(50, 4);
  hear(frames);
  {
    const test::FullDatabaseDisk full;
    recorder_->close();  // what a process leaves behind whose end could not be recorded
    EXPECT_EQ(store_->recording(record.id)->state, RecordingState::recording);
    begin();
    EXPECT_EQ(recorder_->find(record.id)->record.state, RecordingState::recording);
    EXPECT_EQ(recorder_->find(record.id)->record.frames, frames.size()) << "it can be read already";
    EXPECT_EQ(pending_.status().what, std::vector<std::string>{"the repair of recording " + record.id});
  }
  const auto ended = wait_until_it_ends(record.id);
  EXPECT_EQ(ended.state, RecordingState::finished);
  EXPECT_EQ(ended.ended, ended::server_killed);
  EXPECT_EQ(recorder_->counts().bytes, std::filesystem::file_size(recorder_->path_of(record.id)));
}

TEST_F(RecorderTest, MaxDuration_CutsByMediaTime_AndByTheClock) {
  begin();
  const auto by_media = start(600'000);
  Frames batch{42, 9000, {}};
  for (std::uint32_t i = 0; i < 30; ++i) batch.frames.push_back({60'000 * i, {}});
  recorder_->taken("talk", 7, batch);
  const auto done = wait_until_it_ends(by_media.id);
  EXPECT_EQ(done.ended, ended::max_duration);
  EXPECT_EQ(done.frames, 11U);
  EXPECT_EQ(done.duration, 600'000U);
  EXPECT_EQ(done.lost, 0U);
  const auto silent = start(30);
  EXPECT_EQ(wait_until_it_ends(silent.id).ended, ended::max_duration);
}

TEST_F(RecorderTest, AfterAKill_WhatWasDurableIsKept_AndDamageIsSaid) {
  std::filesystem::create_directory(folder_.file("recordings"));
  const auto frames = random_frames(32, 7);
  for (const std::string id : {"torn", "damaged", "gone"}) {
    RecordingRecord record;
    record.id = id;
    record.stream = "talk";
    record.created = store::timestamp_now();
    store_->create_recording(record, std::nullopt);
    if (id == "gone") continue;
    auto bytes = encode_beginning(stream_header());
    const auto chunk = encode_chunk(frames, 0);
    bytes.insert(bytes.end(), chunk.begin(), chunk.end());
    if (id == "torn") bytes.insert(bytes.end(), chunk.begin(), chunk.begin() + 100);
    if (id == "damaged") bytes[20] ^= 1U;
    std::ofstream(folder_.file("recordings") / (id + ".srec"), std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }
  std::ofstream(folder_.file("recordings") / "nobodys.srec") << "left by a crash";
  begin();
  const auto torn = store_->recording("torn");
  EXPECT_EQ(torn->state, RecordingState::finished);
  EXPECT_EQ(torn->ended, ended::server_killed);
  EXPECT_EQ(torn->frames, 32U);
  EXPECT_EQ(frames_of("torn"), frames);
  for (const std::string id : {"damaged", "gone"}) {
    EXPECT_EQ(store_->recording(id)->state, RecordingState::broken) << id;
    EXPECT_EQ(store_->recording(id)->ended, ended::damaged);
  }
  EXPECT_TRUE(std::filesystem::exists(folder_.file("recordings") / "nobodys.srec")) << "not the recorder's to remove";
}

TEST_F(RecorderTest, Sound_IsDurableWithTheFramesOfItsTime) {
  begin();
  const auto record = start(2000);
  const std::vector<std::uint8_t> packet = {0x18, 1, 2, 3};
  recorder_->heard("talk", 7, {5000, packet});  // before the first frame
  recorder_->taken("talk", 7, {42, 5010, {{0, {}}}});
  recorder_->heard("talk", 7, {5010, packet});
  recorder_->heard("talk", 8, {5060, packet});  // of another stream
  recorder_->heard("walk", 7, {5060, packet});
  recorder_->heard("talk", 7, {5070, packet});
  recorder_->heard("talk", 7, {7011, packet});  // beyond the duration that was asked for
  const auto times = [&] {
    std::vector<std::uint64_t> found;
    const auto reader = RecordingReader::open(*open_bytes(recorder_->path_of(record.id)), Check::everything);
    RecordingSoundCursor cursor(std::make_shared<const RecordingReader>(*reader), 0);
    for (; cursor.packet() != nullptr; cursor.advance()) found.push_back(cursor.packet()->media_time);
    return found;
  };
  const std::vector<std::uint64_t> expected = {0, 60};
  EXPECT_TRUE(testing::eventually([&] { return times() == expected; })) << "while it runs";
  EXPECT_EQ(recorder_->stop(record.id)->frames, 1U);
  EXPECT_EQ(times(), expected);
}

TEST_F(RecorderTest, ManyThreads_LoseNothing) {
  begin();
  const auto record = start();
  const auto frames = random_frames(4000, 8);
  std::thread other([&] {
    for (int i = 0; i < 50; ++i) {
      const auto short_one = recorder_->start({stream_header(), "short", std::nullopt}, std::nullopt);
      ASSERT_TRUE(short_one);
      EXPECT_EQ(recorder_->stop(short_one->id)->ended, ended::stopped);
      recorder_->remove(short_one->id);
    }
  });
  hear(frames);
  other.join();
  EXPECT_EQ(recorder_->stop(record.id)->frames, frames.size());
  EXPECT_EQ(frames_of(record.id), frames);
}

}  // namespace
}  // namespace semblante::recordings
