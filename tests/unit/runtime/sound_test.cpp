#include <cmath>
#include <cstddef>

#include <gmock/gmock.h>

#include "tests/unit/runtime/scripted_server.h"

/// The sound of a stream as libsemblante hands it out.
namespace semblante::testing {
namespace {

using ::testing::ElementsAre;
using Bytes = std::vector<std::uint8_t>;

const Bytes packet = {0x18, 1, 2, 3};  ///< one frame of 60 ms

semblante_stream_options listening() {
  auto options = ScriptedServer::usual();
  options.sound = 1;
  return options;
}

semblante_header header_of(const semblante_stream* stream) {
  semblante_header header{};
  header.size = sizeof(header);
  EXPECT_EQ(semblante_stream_header(stream, &header), SEMBLANTE_OK);
  return header;
}

TEST(Sound, Hello_SaysWhetherTheClientHearsOrSendsIt) {
  for (const std::uint32_t role : {SEMBLANTE_ROLE_SUBSCRIBE, SEMBLANTE_ROLE_PUBLISH}) {
    for (const std::uint32_t wished : {0U, 1U}) {
      auto options = ScriptedServer::usual();
      options.role = role;
      options.sound = wished;
      ScriptedServer server(options);
      semblante_stream_start(server.stream, 1000);
      EXPECT_EQ(server.open(1000).sound, wished == 1);
    }
  }
}

TEST(Sound, Header_NamesIt) {
  ScriptedServer server(listening());
  semblante_stream_start(server.stream, 1000);
  server.open(1000);
  Header header = ScriptedServer::header(7, 5000);
  server.say(header, 1000);
  EXPECT_EQ(header_of(server.stream).sound_rate, 0U) << "there is none";
  header.sound = SoundTrack{SoundCodec::opus, 48'000, 1, 20'000};
  server.say(header, 1000);
  const auto told = header_of(server.stream);
  EXPECT_EQ(told.sound_codec, SEMBLANTE_SOUND_OPUS);
  EXPECT_EQ(told.sound_rate, 48'000U);
  EXPECT_EQ(told.sound_channels, 1U);
  EXPECT_EQ(told.sound_bitrate, 20'000U);
}

TEST(Sound, Publisher_SendsPacketsAtTheirTimes) {
  auto options = ScriptedServer::usual();
  options.role = SEMBLANTE_ROLE_PUBLISH;
  options.sound = 1;
  options.batch = 100;
  ScriptedServer server(options);
  const std::vector<std::uint8_t> packet = {0x08, 1, 2, 3};
  const auto publish = [&](double media_time) {
    return semblante_stream_publish_sound(server.stream, packet.data(), 4, media_time);
  };
  EXPECT_EQ(publish(5000), SEMBLANTE_UNAVAILABLE);
  semblante_stream_start(server.stream, 1000);
  server.open(1000);
  Header header = ScriptedServer::header(7, 5000);
  server.say(header, 1000);
  EXPECT_EQ(publish(5000), SEMBLANTE_UNAVAILABLE) << "the server takes none";
  header.sound = SoundTrack{SoundCodec::opus, 48'000, 1, 20'000};
  server.say(header, 1000);
  server.sent();

  ASSERT_EQ(publish(5000.4), SEMBLANTE_OK);
  const auto sent = server.sent();
  ASSERT_EQ(sent.size(), 1U) << "at once, whatever the batches of frames";
  EXPECT_EQ(std::get<SoundPacket>(sent[0]), (SoundPacket{5000, packet}));

  const std::vector<std::uint8_t> long_packet(4001, 0x08);
  EXPECT_EQ(publish(-1), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(publish(std::nan("")), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_stream_publish_sound(server.stream, packet.data(), 0, 6000), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_stream_publish_sound(server.stream, long_packet.data(), 4001, 6000), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_stream_publish_sound(server.stream, nullptr, 4, 6000), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_stream_publish_sound(nullptr, packet.data(), 4, 6000), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_TRUE(server.sent().empty());
}

TEST(Sound, Packet_IsAnEventWithItsTimeAndBytes) {
  ScriptedServer server(listening());
  server.begin(1000);
  server.say(SoundPacket{5060, packet}, 1010);
  semblante_event event{};
  event.size = sizeof(event);
  ASSERT_EQ(semblante_stream_next_event(server.stream, &event), 1U);
  EXPECT_EQ(event.type, static_cast<std::uint32_t>(SEMBLANTE_EVENT_SOUND));
  EXPECT_EQ(event.media_time, 5060);
  EXPECT_EQ(event.duration, 60);
  EXPECT_EQ(Bytes(event.packet, event.packet + event.packet_size), packet);
  server.batch(5040, {{0, face(1)}}, 1020);
  EXPECT_THAT(server.types(), ElementsAre(SEMBLANTE_EVENT_FRAMES)) << "frames go on as if there were no sound";
}

TEST(Sound, CallerOfAnEarlierVersion_GetsTheEventWithoutItsBytes) {
  ScriptedServer server(listening());
  server.begin(1000);
  server.say(SoundPacket{5060, packet}, 1010);
  semblante_event event{};
  event.size = offsetof(semblante_event, duration);
  ASSERT_EQ(semblante_stream_next_event(server.stream, &event), 1U);
  EXPECT_EQ(event.media_time, 5060);
  EXPECT_EQ(event.packet, nullptr);
}

TEST(Sound, NotAskedFor_IsNotTold) {
  ScriptedServer server;
  server.begin(1000);
  server.say(SoundPacket{5060, packet}, 1010);
  EXPECT_TRUE(server.events().empty());
}

TEST(Sound, BeforeTheHeader_IsNotTold) {
  ScriptedServer server(listening());
  semblante_stream_start(server.stream, 1000);
  server.open(1000);
  server.events();
  server.say(SoundPacket{5060, packet}, 1010);
  EXPECT_TRUE(server.events().empty());
}

TEST(Sound, NobodyTakesTheEvents_KeepsTheNewest) {
  ScriptedServer server(listening());
  server.begin(1000);
  for (std::uint64_t i = 0; i < 1000; ++i) server.say(SoundPacket{5000 + 60 * i, packet}, 1010);
  const auto events = server.events();
  ASSERT_EQ(events.size(), 64U);
  EXPECT_EQ(events.back().media_time, 5000 + 60 * 999);
}

TEST(Sound, BytesThatAreNoPacket_AreAFault) {
  ScriptedServer server(listening());
  server.begin(1000);
  server.say_bytes({10, 0, 2, 0x83, 0x40}, 1010);  // no frames in it
  EXPECT_THAT(server.types(), ElementsAre(SEMBLANTE_EVENT_FAULT, SEMBLANTE_EVENT_CLOSE, SEMBLANTE_EVENT_STATE));
}

}  // namespace
}  // namespace semblante::testing
