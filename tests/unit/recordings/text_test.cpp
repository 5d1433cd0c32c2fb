// What is said in a recording: kept durable like frames, played again for captions on the clock of the frames.
#include <gtest/gtest.h>

#include "server/recordings/recording_source.h"
#include "server/recordings/recording_writer.h"
#include "server/streams/batch_listener.h"
#include "server/streams/player.h"
#include "tests/unit/recordings/recorded_frames.h"

namespace semblante::recordings {
namespace {

constexpr std::uint64_t text_clock = 5010;

/// Two words, 480 ms; of the stream's clock.
SpeechText said(std::uint64_t media_time, std::uint64_t number = 1) {
  return {number, media_time, "pt-BR", "Olá você", {0x9f, 0x9f}};
}
SpeechText hush(std::uint64_t media_time) { return {9, media_time, "", "", {}}; }

RecordingReader read_back(const std::filesystem::path& path) {
  auto reader = RecordingReader::open(bytes_in_memory(bytes_of(path)), Check::everything);
  EXPECT_TRUE(reader) << reader.error().message;
  EXPECT_EQ(reader->torn_bytes(), 0U);
  return *std::move(reader);
}

class RecordingText : public ::testing::Test {
 protected:
  RecordingText() {
    auto writer = RecordingWriter::create(path_, stream_header());
    EXPECT_TRUE(writer);
    writer_ = std::move(*writer);
  }
  void frames_until(std::uint64_t ms) {
    for (; at_ <= ms; at_ += 40) EXPECT_TRUE(writer_->add(Frames{sequence_++, text_clock + at_, {{0, {}}}}));
  }
  void add(const SpeechText& text) { EXPECT_TRUE(writer_->add(text)); }
  std::vector<SpeechText> texts() {
    EXPECT_TRUE(writer_->flush());
    EXPECT_EQ(writer_->durable().bytes, std::filesystem::file_size(path_));
    auto read = read_back(path_).texts();
    EXPECT_TRUE(read);
    return *std::move(read);
  }

  const Folder folder_;
  const std::filesystem::path path_ = folder_.file("a.srec");
  std::unique_ptr<RecordingWriter> writer_;
  std::uint64_t at_ = 0, sequence_ = 42;
};

TEST_F(RecordingText, Written_IsReadAgainOnTheClockOfTheFrames) {
  frames_until(1000);
  add(said(text_clock + 1500, 1));
  ASSERT_TRUE(writer_->flush());
  frames_until(3000);
  add(said(text_clock + 2500, 2));
  EXPECT_EQ(texts(), (std::vector{said(1500, 1), said(2500, 2)}));
}

TEST_F(RecordingText, BeforeTheFirstFrame_IsKeptIfItsWordsComeLater) {
  add(said(text_clock - 1, 1));
  add(said(text_clock + 120, 2));
  ASSERT_TRUE(writer_->flush());
  EXPECT_EQ(writer_->durable().frames, 0U);
  frames_until(1000);
  EXPECT_EQ(texts(), std::vector{said(120, 2)});
}

TEST_F(RecordingText, EndOfASpeech_TakesBackWhatWasNotSaidYet) {
  frames_until(5000);
  add(said(text_clock + 100, 1));
  add(said(text_clock + 1100, 2));
  add(hush(text_clock + 300));
  add(said(text_clock + 900, 10));
  EXPECT_EQ(texts(), (std::vector{said(100, 1), hush(300), said(900, 10)}));
}

TEST_F(RecordingText, AfterTheLastFrame_IsLeftOut) {
  frames_until(1000);
  add(said(text_clock + 100, 1));
  add(said(text_clock + 1100, 2));
  EXPECT_EQ(texts(), std::vector{said(100, 1)});
}

TEST_F(RecordingText, LongTexts_AreWrittenInChunksWithinTheLimit) {
  std::vector<SpeechText> expected;
  frames_until(40'000);
  for (std::uint64_t i = 0; i < 40; ++i) {
    auto text = said(text_clock + 1000 * i, i);
    text.text = std::string(max_speech_text_bytes, 'a');
    text.score.assign(max_score_bytes, 0x07);
    text.score[0] = 0x9f;
    add(text);
    text.media_time -= text_clock;
    expected.push_back(text);
  }
  EXPECT_EQ(texts(), expected);
  const auto bytes = bytes_of(path_);
  std::size_t chunks = 0;
  for (std::size_t at = file_magic.size(); at < bytes.size();) {
    const auto head = read_chunk_head(std::span(bytes).subspan(at));
    ASSERT_TRUE(head);
    if (head->kind == ChunkKind::text) {
      ++chunks;
      EXPECT_LE(head->bytes, max_text_chunk_bytes);
    }
    at += chunk_head_bytes + head->bytes;
  }
  EXPECT_GE(chunks, 4U);
}

TEST_F(RecordingText, FlippedByte_IsNeverAnotherText) {
  frames_until(400);
  add(said(text_clock + 100, 1));
  add(said(text_clock + 200, 2));
  const auto expected = texts();
  const auto whole = bytes_of(path_);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    auto bytes = whole;
    bytes[at] ^= 0x10U;
    const auto reader = RecordingReader::open(bytes_in_memory(std::move(bytes)), Check::everything);
    if (!reader) continue;
    const auto read = reader->texts();
    EXPECT_TRUE(!read || read->empty() || *read == expected) << at;
  }
}

/// Keeps what a stream has.
class TextListener : public streams::BatchListener {
 public:
  void taken(std::string_view, std::uint64_t, const Frames& batch) override {
    if (!first_frame) first_frame = batch.media_time;
  }
  void said(std::string_view, std::uint64_t, const SpeechText& text) override { texts.push_back(text); }
  void ended(std::string_view) override {}
  std::optional<std::uint64_t> first_frame;
  std::vector<SpeechText> texts;
};

TEST_F(RecordingText, Played_IsSaidAtTheSameDistancesFromTheFrames) {
  frames_until(5000);
  add(said(text_clock + 1200, 1));
  add(said(text_clock + 2200, 2));
  add(hush(text_clock + 2300));
  ASSERT_TRUE(writer_->flush());
  streams::StreamInfo info;
  info.settings.batch_interval = 0;
  const auto stream = std::make_shared<streams::Stream>(info, streams::StreamLimits{});
  const auto listener = std::make_shared<TextListener>();
  stream->set_listener(listener);
  const auto source = make_recording_source(bytes_in_memory(bytes_of(path_)), "talk");
  ASSERT_TRUE(source);
  const auto ticket = stream->begin_playing(25.0, false);
  ASSERT_TRUE(ticket);
  streams::Player player("1", stream, *ticket, *source, {}, streams::Player::Clock::now());
  while (!player.finished()) player.play(player.next());
  ASSERT_EQ(listener->texts.size(), 3U);
  const auto time = [&](std::size_t i) { return listener->texts[i].media_time - *listener->first_frame; };
  EXPECT_NEAR(static_cast<double>(time(0)), 1200, 1);
  EXPECT_NEAR(static_cast<double>(time(1)), 2200, 1);
  EXPECT_NEAR(static_cast<double>(time(2)), 2300, 1);
  EXPECT_EQ(listener->texts[0].text, "Olá você");
  EXPECT_EQ(listener->texts[2].text, "");
}

}  // namespace
}  // namespace semblante::recordings
