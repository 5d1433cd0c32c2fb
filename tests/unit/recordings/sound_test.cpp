// The sound of a recording: kept durable like frames, played again on their clock, and exported.
#include <cmath>
#include <fstream>
#include <numbers>
#include <opus.h>
#include <sstream>

#include <gtest/gtest.h>
#include <ogg/ogg.h>

#include "server/recordings/recording_export.h"
#include "server/recordings/recording_source.h"
#include "server/recordings/recording_writer.h"
#include "server/streams/batch_listener.h"
#include "server/streams/player.h"
#include "server/voice/sound_coder.h"
#include "tests/unit/recordings/recorded_frames.h"

namespace semblante::recordings {
namespace {

using Reader = std::shared_ptr<const RecordingReader>;

constexpr std::uint64_t first_time = 5010;  ///< of random_frames()

/// Packets of 60 ms (RFC 6716, table 2: configuration 3) from `begin` on, each with its number in it.
std::vector<SoundPacket> numbered_packets(std::uint64_t begin, std::size_t count) {
  std::vector<SoundPacket> packets;
  for (std::size_t i = 0; i < count; ++i)
    packets.push_back({begin + 60 * i, {0x18, static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i >> 8U), 1}});
  return packets;
}

std::vector<SoundPacket> all_sound(const Reader& reader, std::uint32_t from = 0) {
  std::vector<SoundPacket> packets;
  RecordingSoundCursor cursor(reader, from);
  for (; cursor.packet() != nullptr; cursor.advance()) packets.push_back(*cursor.packet());
  EXPECT_FALSE(cursor.error()) << cursor.error()->message;
  return packets;
}

Reader opened(std::vector<std::uint8_t> bytes) {
  auto reader = RecordingReader::open(bytes_in_memory(std::move(bytes)), Check::everything);
  EXPECT_TRUE(reader) << reader.error().message;
  return reader ? std::make_shared<const RecordingReader>(std::move(*reader)) : nullptr;
}

std::vector<std::uint8_t> file_bytes(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Frames every 40 ms and packets every 60 ms, written in the order in which a stream has them, with a flush every
/// second.
std::vector<std::uint8_t> recorded(const std::filesystem::path& path, std::uint64_t duration,
                                   const std::vector<SoundPacket>& packets) {
  auto writer = RecordingWriter::create(path, stream_header());
  EXPECT_TRUE(writer);
  std::size_t sound = 0;
  std::uint64_t sequence = 42;
  for (std::uint64_t ms = 0; ms <= duration; ms += 20) {
    while (sound < packets.size() && packets[sound].media_time <= first_time + ms)
      EXPECT_TRUE((*writer)->add(packets[sound++]));
    if (ms % 40 == 0) {
      EXPECT_TRUE((*writer)->add(Frames{sequence++, first_time + ms, {{0, {}}}}));
    }
    if (ms % 1000 == 980) {
      EXPECT_TRUE((*writer)->flush());
    }
  }
  EXPECT_TRUE((*writer)->flush());
  EXPECT_EQ((*writer)->durable().bytes, std::filesystem::file_size(path));
  return file_bytes(path);
}

TEST(RecordingSound, Written_IsReadAgainOnTheClockOfTheFrames) {
  const Folder folder;
  const auto packets = numbered_packets(first_time + 30, 400);
  const auto reader = opened(recorded(folder.file("a.srec"), 30'000, packets));
  ASSERT_TRUE(reader);
  EXPECT_EQ(reader->torn_bytes(), 0U);
  EXPECT_EQ(reader->sound_packets(), 400U);
  auto expected = packets;
  for (auto& packet : expected) packet.media_time -= first_time;
  EXPECT_EQ(all_sound(reader), expected);
  for (const std::uint32_t from : {29U, 30U, 31U, 990U, 12'345U, 23'970U, 23'971U}) {
    auto rest = expected;
    std::erase_if(rest, [&](const SoundPacket& packet) { return packet.media_time < from; });
    EXPECT_EQ(all_sound(reader, from), rest) << from;
  }
}

TEST(RecordingSound, BeforeTheFirstFrame_IsLeftOut) {
  const Folder folder;
  auto writer = RecordingWriter::create(folder.file("a.srec"), stream_header());
  ASSERT_TRUE(writer);
  auto packets = numbered_packets(0, 1201);
  for (std::size_t i = 0; i < packets.size(); ++i) packets[i].media_time = first_time - 4 * (1200 - i);
  for (const auto& packet : packets) ASSERT_TRUE((*writer)->add(packet));
  ASSERT_TRUE((*writer)->flush());
  EXPECT_EQ((*writer)->durable().sound_packets, 0U) << "nothing to count from";
  ASSERT_TRUE((*writer)->add(Frames{42, first_time, {{0, {}}}}));
  ASSERT_TRUE((*writer)->flush());
  const auto sound = all_sound(opened(file_bytes(folder.file("a.srec"))));
  ASSERT_EQ(sound.size(), 1U) << "that of the first frame's time";
  EXPECT_EQ(sound[0].media_time, 0U);
  EXPECT_EQ(sound[0].packet, packets.back().packet);
}

TEST(RecordingSound, OutOfOrder_IsLeftOut) {
  const Folder folder;
  auto writer = RecordingWriter::create(folder.file("a.srec"), stream_header());
  ASSERT_TRUE(writer);
  ASSERT_TRUE((*writer)->add(Frames{42, first_time, {{0, {}}}}));
  for (const std::uint64_t ms : {60U, 0U, 120U}) ASSERT_TRUE((*writer)->add(SoundPacket{first_time + ms, {0x18, 1}}));
  ASSERT_TRUE((*writer)->flush());
  const auto sound = all_sound(opened(file_bytes(folder.file("a.srec"))));
  ASSERT_EQ(sound.size(), 2U);
  EXPECT_EQ(sound[1].media_time, 120U);
}

TEST(RecordingSound, LargePackets_AreWrittenInChunksWithinTheLimit) {
  const Folder folder;
  auto packets = numbered_packets(first_time, 100);
  for (auto& packet : packets) packet.packet.resize(max_sound_packet_bytes);
  const auto bytes = recorded(folder.file("a.srec"), 6000, packets);
  std::size_t chunks = 0;
  for (std::size_t at = file_magic.size(); at < bytes.size();) {
    const auto head = read_chunk_head(std::span(bytes).subspan(at));
    ASSERT_TRUE(head);
    if (head->kind == ChunkKind::sound) {
      ++chunks;
      EXPECT_LE(head->bytes, max_sound_chunk_bytes);
    }
    at += chunk_head_bytes + head->bytes;
  }
  EXPECT_GT(chunks, 100U * max_sound_packet_bytes / max_sound_chunk_bytes);
  EXPECT_EQ(all_sound(opened(bytes)).size(), 100U);
}

TEST(RecordingSound, TornEnd_IsCutAndTheRestKept) {
  const Folder folder;
  const auto whole = recorded(folder.file("a.srec"), 2000, numbered_packets(first_time, 30));
  std::size_t last = 0;
  for (std::size_t at = file_magic.size(); at < whole.size();) {
    last = at;
    at += chunk_head_bytes + read_chunk_head(std::span(whole).subspan(at))->bytes;
  }
  for (std::size_t size = last; size < whole.size(); size += 17) {
    std::filesystem::resize_file(folder.file("a.srec"), size);
    const auto progress = repair_recording(folder.file("a.srec"));
    ASSERT_TRUE(progress) << progress.error().message;
    EXPECT_EQ(progress->bytes, last);
    EXPECT_EQ(std::filesystem::file_size(folder.file("a.srec")), last);
    std::ofstream(folder.file("a.srec"), std::ios::binary)
        .write(reinterpret_cast<const char*>(whole.data()), static_cast<std::streamsize>(whole.size()));
  }
}

TEST(RecordingSound, FlippedByte_IsNeverOtherSound) {
  const Folder folder;
  const auto whole = recorded(folder.file("a.srec"), 400, numbered_packets(first_time, 6));
  const auto expected = all_sound(opened(whole));
  ASSERT_EQ(expected.size(), 6U);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    auto bytes = whole;
    bytes[at] ^= 0x10U;
    const auto reader = RecordingReader::open(bytes_in_memory(std::move(bytes)), Check::everything);
    if (!reader) continue;
    const auto shared = std::make_shared<const RecordingReader>(*reader);
    RecordingSoundCursor cursor(shared, 0);
    std::size_t count = 0;
    for (; cursor.packet() != nullptr; cursor.advance(), ++count) EXPECT_EQ(*cursor.packet(), expected[count]) << at;
    EXPECT_TRUE(count == 0 || count == expected.size()) << at;
  }
}

/// Keeps what a stream has.
class SoundListener : public streams::BatchListener {
 public:
  void taken(std::string_view, std::uint64_t, const Frames& batch) override {
    for (const auto& frame : batch.frames) frames.push_back(batch.media_time + frame.time);
  }
  void heard(std::string_view, std::uint64_t epoch, const SoundPacket& packet) override {
    EXPECT_EQ(epoch, 9U);
    sound.push_back(packet);
  }
  void ended(std::string_view) override {}
  std::vector<std::uint64_t> frames;
  std::vector<SoundPacket> sound;
};

TEST(RecordingSound, Played_IsHeardAtTheSameDistancesFromTheFrames) {
  const Folder folder;
  const auto packets = numbered_packets(first_time + 30, 40);
  const auto bytes = recorded(folder.file("a.srec"), 3000, packets);
  for (const double from : {0.0, 1000.0}) {
    streams::StreamInfo info;
    info.id = "s";
    info.epoch = 9;
    info.settings.batch_interval = 0;
    const auto stream = std::make_shared<streams::Stream>(info, streams::StreamLimits{});
    const auto listener = std::make_shared<SoundListener>();
    stream->set_listener(listener);
    const auto source = make_recording_source(bytes_in_memory(bytes), "talk");
    ASSERT_TRUE(source);
    const auto ticket = stream->begin_playing(25.0, false);
    ASSERT_TRUE(ticket);
    const auto begin = streams::Player::Clock::now();
    streams::PlayOptions options;
    options.from = from;
    streams::Player player("1", stream, *ticket, *source, options, begin);
    while (!player.finished()) player.play(player.next());
    ASSERT_FALSE(listener->frames.empty());
    std::vector<SoundPacket> expected;
    for (auto packet : packets) {
      if (static_cast<double>(packet.media_time - first_time) < from) continue;
      packet.media_time += listener->frames[0] - first_time - static_cast<std::uint64_t>(from);
      expected.push_back(packet);
    }
    ASSERT_EQ(listener->sound.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_EQ(listener->sound[i].packet, expected[i].packet);
      EXPECT_NEAR(static_cast<double>(listener->sound[i].media_time), static_cast<double>(expected[i].media_time), 1.0);
    }
  }
}

// ---- Ogg/Opus ---------------------------------------------------------------------------------------------------

/// Decodes a file Ogg/Opus as a player does: all packets in order, each after the other.
std::vector<float> decoded(const std::string& file) {
  ogg_sync_state sync;
  ogg_stream_state stream;
  ogg_sync_init(&sync);
  char* const to = ogg_sync_buffer(&sync, static_cast<long>(file.size()));
  std::copy(file.begin(), file.end(), to);
  ogg_sync_wrote(&sync, static_cast<long>(file.size()));
  ogg_page page;
  int error = 0;
  auto* const decoder = opus_decoder_create(48'000, 1, &error);
  std::vector<float> sound;
  bool is_open = false;
  int packets = 0;
  std::int64_t last_position = 0;
  bool ended = false;
  while (ogg_sync_pageout(&sync, &page) == 1) {
    if (!std::exchange(is_open, true)) ogg_stream_init(&stream, ogg_page_serialno(&page));
    EXPECT_EQ(ogg_stream_pagein(&stream, &page), 0);
    ogg_packet packet;
    while (ogg_stream_packetout(&stream, &packet) == 1) {
      EXPECT_FALSE(ended);
      if (packets++ < 2) {
        const std::string_view magic(reinterpret_cast<const char*>(packet.packet), 8);
        EXPECT_EQ(magic, packets == 1 ? "OpusHead" : "OpusTags");
        continue;
      }
      std::vector<float> part(5760);
      const int samples =
          opus_decode_float(decoder, packet.packet, static_cast<opus_int32>(packet.bytes), part.data(), 5760, 0);
      EXPECT_GT(samples, 0);
      sound.insert(sound.end(), part.begin(), part.begin() + samples);
      if (packet.granulepos >= 0) {
        EXPECT_GT(packet.granulepos, last_position);
        EXPECT_EQ(static_cast<std::size_t>(packet.granulepos), sound.size()) << "the clock of the file";
        last_position = packet.granulepos;
      }
      ended = packet.e_o_s != 0;
    }
  }
  EXPECT_TRUE(ended) << "the last packet says that it is the last";
  opus_decoder_destroy(decoder);
  if (is_open) ogg_stream_clear(&stream);
  ogg_sync_clear(&sync);
  return sound;
}

/// The first sample of each tone that begins after 50 ms of silence, in ms.
std::vector<double> tone_beginnings(const std::vector<float>& sound) {
  std::vector<double> times;
  std::size_t silent = 2400;
  for (std::size_t i = 0; i < sound.size(); ++i) {
    if (std::abs(sound[i]) < 0.1F) {
      ++silent;
      continue;
    }
    if (silent >= 2400) times.push_back(static_cast<double>(i) / 48.0);
    silent = 0;
  }
  return times;
}

std::string ogg_of(const Reader& reader, const Cut& cut) {
  std::ostringstream file;
  const auto written = export_sound(reader, cut, file);
  EXPECT_TRUE(written) << written.error().message;
  return file.str();
}

/// Tones of 100 ms at these times of the recording, coded as the server's speech is.
std::vector<SoundPacket> tones_at(const std::vector<double>& times, double duration) {
  std::vector<std::int16_t> samples(static_cast<std::size_t>(duration * 24.0));
  for (const double time : times)
    for (int i = 0; i < 2400; ++i)
      samples[static_cast<std::size_t>(time * 24.0) + static_cast<std::size_t>(i)] =
          static_cast<std::int16_t>(12'000.0 * std::sin(2.0 * std::numbers::pi * 500.0 * i / 24'000.0));
  auto coder = voice::SoundCoder::make();
  EXPECT_TRUE(coder && coder->add(samples, 24'000));
  std::vector<SoundPacket> sound;
  const auto packets = coder->code(duration);
  EXPECT_TRUE(packets);
  for (const auto& coded : *packets) sound.push_back({first_time + coded.time, coded.packet});
  return sound;
}

TEST(RecordingSound, Exported_HasTheClockOfTheFrames) {
  const Folder folder;
  const std::vector<double> times = {700.0, 2900.0, 9300.0, 14'210.0};
  const auto packets = tones_at(times, 15'000.0);
  ASSERT_LT(packets.size(), 250U) << "pauses are not sent";
  const auto reader = opened(recorded(folder.file("a.srec"), 15'000, packets));
  const auto found = tone_beginnings(decoded(ogg_of(reader, {})));
  ASSERT_EQ(found.size(), times.size());
  for (std::size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(found[i], times[i], 10.0);

  const auto part = tone_beginnings(decoded(ogg_of(reader, {2000, 10'000, 0.0})));
  ASSERT_EQ(part.size(), 2U);
  EXPECT_NEAR(part[0], 900.0, 10.0);
  EXPECT_NEAR(part[1], 7300.0, 10.0);
}

TEST(RecordingSound, ExportedWithoutSound_SaysThereIsNone) {
  const Folder folder;
  const auto reader = opened(recorded(folder.file("a.srec"), 1000, {}));
  std::ostringstream file;
  EXPECT_EQ(export_sound(reader, {}, file).error().code, ErrorCode::empty);
  EXPECT_TRUE(file.str().empty());
}

TEST(RecordingSound, PacketsThatOverlap_DoNotShiftWhatFollows) {
  const Folder folder;
  // Every packet lasts 60 ms and the next begins 55 ms later, for 20 s; then one after a pause.
  std::vector<SoundPacket> packets;
  for (std::uint64_t i = 0; i < 364; ++i) packets.push_back({first_time + 55 * i, {0x18, 0, 0, 1}});
  packets.push_back({first_time + 25'000, {0x18, 0, 0, 1}});
  const auto reader = opened(recorded(folder.file("a.srec"), 26'000, packets));
  EXPECT_NEAR(static_cast<double>(decoded(ogg_of(reader, {})).size()) / 48.0, 25'060.0, 2.5);
}

}  // namespace
}  // namespace semblante::recordings
