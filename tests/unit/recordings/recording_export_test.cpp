// What a recording is fetched as gives its frames again, as far as the format can say them.
#include "server/recordings/recording_export.h"

#include <cmath>
#include <sstream>

#include <gtest/gtest.h>

#include "core/bridges/live_link_csv.h"
#include "core/performance/performance.h"
#include "protocol/cpp/fap_file_frames.h"
#include "protocol/cpp/json_codec.h"
#include "protocol/cpp/kernel_values.h"
#include "protocol/cpp/performance_document.h"
#include "tests/unit/recordings/recorded_frames.h"

namespace semblante::recordings {
namespace {

std::shared_ptr<const RecordingReader> reader_of(const std::vector<RecordingFrame>& frames,
                                                 const Header& header = stream_header()) {
  auto bytes = encode_beginning(header);
  for (std::size_t i = 0; i < frames.size(); i += 40) {
    const auto chunk = encode_chunk(std::span(frames).subspan(i, std::min<std::size_t>(40, frames.size() - i)), 0);
    bytes.insert(bytes.end(), chunk.begin(), chunk.end());
  }
  auto reader = RecordingReader::open(bytes_in_memory(std::move(bytes)), Check::everything);
  EXPECT_TRUE(reader);
  return std::make_shared<const RecordingReader>(std::move(*reader));
}

/// How much of each viseme: what FAP 1 means, whichever of its ways says it.
std::array<double, 15> visemes_of(const VisemeBlend& viseme) {
  std::array<double, 15> weights{};
  weights[viseme.select1] += viseme.blend / 63.0;
  weights[viseme.select2] += 1.0 - viseme.blend / 63.0;
  weights[0] = 0.0;
  return weights;
}

/// Random frames at times of their own, one at each.
std::vector<RecordingFrame> frames_apart(std::size_t count, unsigned seed) {
  auto frames = random_frames(count, seed);
  for (std::size_t i = 0; i < count; ++i) frames[i].media_time += 2 * i;
  return frames;
}

void expect_plays_the_recorded_levels(const std::vector<RecordingFrame>& frames, const Header& header) {
  const auto steps = quantizers_of(header);
  const auto text = export_performance(reader_of(frames, header), {}, "take");
  ASSERT_TRUE(text) << text.error().message;
  const auto script = read_performance(*text);
  ASSERT_TRUE(script) << script.error().where << script.error().message;
  EXPECT_EQ(script->name, "take");
  const auto performance = Performance::compile(*script);
  ASSERT_TRUE(performance);
  for (const auto& frame : frames) {
    const auto ms = static_cast<double>(frame.media_time - frames.front().media_time);
    const auto played = quantized(performance->frame_at(ms), steps);
    EXPECT_EQ(played.level, frame.state.level) << "at " << ms;
    const auto got = visemes_of(played.viseme);
    const auto expected = visemes_of(frame.state.viseme);
    for (std::size_t v = 1; v < got.size(); ++v) EXPECT_NEAR(got[v], expected[v], 1e-9) << ms << " viseme " << v;
    const bool shows = frame.state.expression.select1 != 0 && frame.state.expression.intensity1 != 0;
    EXPECT_EQ(shows ? frame.state.expression.intensity1 : 0,
              played.expression.select1 == frame.state.expression.select1   ? played.expression.intensity1
              : played.expression.select2 == frame.state.expression.select1 ? played.expression.intensity2
                                                                            : 0)
        << ms;
  }
}

TEST(RecordingExport, Performance_GivesTheRecordedLevels) {
  expect_plays_the_recorded_levels(frames_apart(400, 1), stream_header());
}

TEST(RecordingExport, Performance_OfFinerSteps_GivesTheirLevels) {
  Header fine = stream_header();
  for (std::size_t fap = first_low_level_fap; fap <= last_low_level_fap; ++fap)
    fine.quantizers.push_back(standard_quantizers()[fap] / 8.0);
  expect_plays_the_recorded_levels(frames_apart(300, 2), fine);
}

TEST(RecordingExport, Fap_AtARateThatHasEveryFrame_GivesThemAll) {
  auto frames = random_frames(200, 3);
  for (std::size_t i = 0; i < frames.size(); ++i) frames[i].media_time = 777 + 40 * i;
  const auto text = export_fap(reader_of(frames), {}, "take");
  ASSERT_TRUE(text) << text.error().message;
  const auto reading = read_fap_file(*text);
  ASSERT_TRUE(reading);
  EXPECT_TRUE(reading->warnings.empty());
  EXPECT_EQ(reading->file.rate, 25.0);
  const auto played = frames_of(reading->file);
  ASSERT_TRUE(played);
  ASSERT_EQ(played->size(), frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ((*played)[i].time, 40 * i);
    EXPECT_EQ(to_frame((*played)[i].state), frames[i].state) << i;
  }
}

TEST(RecordingExport, Fap_AtAnyRate_HasTheFramesThatFallOnIt) {
  const auto frames = frames_apart(100, 4);
  const auto text = export_fap(reader_of(frames), {0, UINT32_MAX, 10.0}, "take");
  ASSERT_TRUE(text);
  const auto reading = read_fap_file(*text);
  ASSERT_TRUE(reading);
  EXPECT_EQ(reading->file.rate, 10.0);
  const auto duration = static_cast<double>(frames.back().media_time - frames.front().media_time);
  EXPECT_EQ(reading->file.frames.back().number, std::lround(duration / 100.0));
}

TEST(RecordingExport, ArkitCsv_IsReadAgain) {
  const auto frames = frames_apart(150, 5);
  std::ostringstream text;
  ASSERT_TRUE(export_arkit_csv(reader_of(frames), {}, text));
  const auto take = read_live_link_csv(text.str());
  ASSERT_TRUE(take) << take.error().where << take.error().message;
  EXPECT_TRUE(take->warnings.empty());
  ASSERT_EQ(take->rows.size(), frames.size());
  std::vector<LiveLinkRow> rows;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double seconds = static_cast<double>(frames[i].media_time - frames[0].media_time) / 1000.0;
    const auto expected = live_link_row_of(seconds, to_kernel_frame(to_values(frames[i].state)));
    EXPECT_NEAR(take->rows[i].seconds, seconds, 1e-4);
    for (std::size_t s = 0; s < arkit_count; ++s)
      EXPECT_NEAR(take->rows[i].coefficients[s], expected.coefficients[s], 1e-6) << i << " " << arkit_name(s);
    EXPECT_NEAR(take->rows[i].head.yaw, expected.head.yaw, 1e-6);
    EXPECT_NEAR(take->rows[i].left_eye.pitch, expected.left_eye.pitch, 1e-6);
    rows.push_back(expected);
  }
  EXPECT_EQ(text.str(), write_live_link_csv(rows)) << "piece by piece it is the same file";
}

TEST(RecordingExport, Frames_AreTheBodyOfARequest) {
  const auto frames = random_frames(300, 6);
  std::ostringstream text;
  ASSERT_TRUE(export_frames(reader_of(frames), {}, text));
  const auto again = decode_json_frames(text.str());
  ASSERT_TRUE(again) << again.error().message;
  ASSERT_EQ(again->size(), frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ((*again)[i].time, frames[i].media_time - frames[0].media_time);
    EXPECT_EQ((*again)[i].state, frames[i].state);
  }
}

TEST(RecordingExport, Cut_BeginsWithTheFaceThatHolds) {
  auto frames = random_frames(5, 7);
  for (std::size_t i = 0; i < frames.size(); ++i) frames[i].media_time = 500 + 100 * i;
  const auto reader = reader_of(frames);
  const auto part = gather(reader, {150, 320});
  ASSERT_TRUE(part);
  ASSERT_EQ(part->size(), 3U);
  EXPECT_EQ((*part)[0], (TimedValues{0, to_values(frames[1].state)}));
  EXPECT_EQ((*part)[1], (TimedValues{50, to_values(frames[2].state)}));
  EXPECT_EQ((*part)[2], (TimedValues{150, to_values(frames[3].state)}));
  EXPECT_EQ(gather(reader, {200, 300})->size(), 2U) << "a frame at the very beginning is the first";
  EXPECT_EQ(gather(reader, {401, 500}).error().code, ErrorCode::empty);
  EXPECT_EQ(gather(reader, {}, 4).error().code, ErrorCode::too_large);
}

TEST(RecordingExport, Rate_GoesStraightBetweenFrames) {
  std::vector<RecordingFrame> frames(3);
  for (std::size_t i = 0; i < 3; ++i) frames[i].sequence = 1 + i;
  frames[0].state.level[3] = 10;
  frames[1].media_time = 100;
  frames[1].state.level[3] = 20;
  frames[2].media_time = 130;
  frames[2].state.level[3] = 50;
  const auto sampled = gather(reader_of(frames), {0, UINT32_MAX, 20.0});
  ASSERT_TRUE(sampled);
  ASSERT_EQ(sampled->size(), 3U);
  const double step = standard_quantizers()[3];
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ((*sampled)[i].time, 50 * i);
    EXPECT_DOUBLE_EQ((*sampled)[i].state.fap[3], step * (10.0 + 5.0 * static_cast<double>(i)));
  }
  const auto alone = gather(reader_of({frames[0]}), {0, UINT32_MAX, 20.0});
  ASSERT_TRUE(alone);
  EXPECT_EQ(alone->size(), 1U);
}

TEST(RecordingExport, Damage_IsAnErrorByByte) {
  auto bytes = encode_beginning(stream_header());
  const auto frames = random_frames(80, 8);
  for (std::size_t i = 0; i < frames.size(); i += 40) {
    const auto chunk = encode_chunk(std::span(frames).subspan(i, 40), 0);
    bytes.insert(bytes.end(), chunk.begin(), chunk.end());
  }
  bytes[bytes.size() - 5] ^= 1U;
  auto reader = RecordingReader::open(bytes_in_memory(bytes), Check::heads);
  ASSERT_TRUE(reader);
  std::ostringstream text;
  const auto status = export_frames(std::make_shared<const RecordingReader>(std::move(*reader)), {}, text);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().where.rfind("byte ", 0), 0U);
}

}  // namespace
}  // namespace semblante::recordings
