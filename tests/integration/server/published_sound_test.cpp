// A publisher sends its voice with its face: who listens hears it, and a recording keeps it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "protocol/cpp/json_codec.h"
#include "tests/integration/server/test_client.h"

namespace semblante::test {
namespace {

using nlohmann::json;
using ::testing::StartsWith;

Message next(WebSocket& socket) {
  const auto text = socket.receive();
  auto message = decode_json(text.value_or(std::string()));
  EXPECT_TRUE(message) << text.value_or("nothing");
  return message ? std::move(*message) : Message(End{});
}

TEST(PublishedSound, IsHeardByListenersAndKeptByARecording) {
  const TemporaryFolder folder;
  const ServerProcess server(folder.path() / "data", {});
  const int port = server.port();
  request(port, "POST", "/v1/streams", R"({"name":"voice","batch_interval":0})", json_type);
  WebSocket listener(port, "/v1/streams/voice", "semblante.v1.json");
  listener.send_text(R"({"type":"hello","version":1,"sound":true})");
  EXPECT_TRUE(std::get<Header>(next(listener)).sound);
  EXPECT_TRUE(std::holds_alternative<Keyframe>(next(listener)));
  const auto made = request(port, "POST", "/v1/streams/voice/recordings", "{}", json_type);
  ASSERT_EQ(made.status, 201) << made.body;
  const auto recording = "/v1/recordings/" + json::parse(made.body)["id"].get<std::string>();

  WebSocket publisher(port, "/v1/streams/voice", "semblante.v1.json");
  publisher.send_text(R"({"type":"hello","version":1,"role":"publish","sound":true})");
  EXPECT_TRUE(std::get<Header>(next(publisher)).sound);
  const std::vector<std::uint8_t> packet = {0x08, 1, 2, 3};  // 20 ms
  constexpr std::uint64_t begin = 7'000'000;                 // by its own clock
  std::vector<std::uint64_t> seen, heard;
  for (std::uint64_t k = 0; k < 10; ++k) {
    FaceFrame face;
    face.viseme.select1 = static_cast<std::uint8_t>(k + 1);
    publisher.send_text(encode_json(Frames{0, begin + 20 * k, {{0, face}}}));
    publisher.send_text(encode_json(SoundPacket{begin + 20 * k, packet}));
  }
  while (seen.size() < 10 || heard.size() < 10) {
    const auto message = next(listener);
    if (const auto* frames = std::get_if<Frames>(&message)) {
      for (const auto& frame : frames->frames) seen.push_back(frames->media_time + frame.time);
    } else if (const auto* sound = std::get_if<SoundPacket>(&message)) {
      EXPECT_EQ(sound->packet, packet);
      heard.push_back(sound->media_time);
    } else {
      FAIL() << "neither a frame nor sound";
    }
  }
  EXPECT_EQ(heard, seen) << "one clock for both";

  EXPECT_EQ(json::parse(request(port, "POST", recording + "/stop").body)["sound"], true);
  const auto ogg = request(port, "GET", recording + "/content?format=opus");
  EXPECT_EQ(ogg.status, 200) << ogg.body;
  EXPECT_THAT(ogg.body, StartsWith("OggS"));
}

}  // namespace
}  // namespace semblante::test
