// Streams of a real server, by a WebSocket client that shares no code with it.

#include <algorithm>
#include <csignal>
#include <fstream>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/cpp/frame_codec.h"
#include "protocol/cpp/quantizers.h"
#include "tests/integration/server/model_flow.h"
#include "tests/integration/server/shared_server.h"
#include "tests/support/frame_encoder.h"

namespace semblante::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class Streams : public SharedServer {
 protected:
  static void SetUpTestSuite() { start({"--demo"}); }
  static std::string create(const std::string& name) {
    request(port(), "POST", "/v1/streams", R"({"name":")" + name + R"(","batch_interval":0})",
            {{"Content-Type", "application/json"}});
    return "/v1/streams/" + name;
  }
  static json next(WebSocket& socket) {
    const auto text = socket.receive();
    return text ? json::parse(*text, nullptr, false) : json();
  }
  static std::string hello(const std::string& role) {
    return R"({"type":"hello","version":1,"role":")" + role + R"("})";
  }
  static void post(const std::string& stream, int value) {
    const auto reply =
        request(port(), "POST", stream + "/frames", R"({"frames":[{"faps":{"3":)" + std::to_string(value) + "}}]}");
    EXPECT_EQ(reply.status, 202) << reply.body;
  }
};

TEST_F(Streams, Pages_FollowNext) {
  for (const auto* const name : {"page-a", "page-b", "page-c"}) create(name);
  const auto all = json_of(request(port(), "GET", "/v1/streams?limit=200"));
  ASSERT_TRUE(all["next"].is_null());
  json listed = json::array();
  std::string after;
  do {
    const auto page = json_of(request(port(), "GET", "/v1/streams?limit=2&after=" + after));
    ASSERT_LE(page["streams"].size(), 2U);
    for (const auto& stream : page["streams"]) listed.push_back(stream["id"]);
    after = page["next"].is_null() ? "" : page["next"].get<std::string>();
  } while (!after.empty());
  json expected = json::array();
  for (const auto& stream : all["streams"]) expected.push_back(stream["id"]);
  EXPECT_EQ(listed, expected);
  EXPECT_EQ(json_of(request(port(), "GET", "/v1/streams?after=no-such"))["pointer"], "?after");
  EXPECT_EQ(json_of(request(port(), "GET", "/v1/streams?limit=201"))["pointer"], "?limit");
}

TEST_F(Streams, Subprotocol_IsEchoedOnlyIfOffered) {
  EXPECT_FALSE(WebSocket(port(), "/v1/streams/demo", "").handshake().headers.contains("sec-websocket-protocol"));
  EXPECT_FALSE(WebSocket(port(), "/v1/streams/demo", "chat").handshake().headers.contains("sec-websocket-protocol"));
  const WebSocket both(port(), "/v1/streams/demo", "chat, semblante.v1, semblante.v1.json");
  EXPECT_EQ(both.handshake().headers.at("sec-websocket-protocol"), "semblante.v1");
  const WebSocket json_first(port(), "/v1/streams/demo", "semblante.v1.json, semblante.v1");
  EXPECT_EQ(json_first.handshake().headers.at("sec-websocket-protocol"), "semblante.v1.json");
}

TEST_F(Streams, Upgrade_OfWhatIsNoStream_IsRefused) {
  EXPECT_EQ(WebSocket(port(), "/v1/streams/nobody", "").handshake().status, 404);
  EXPECT_EQ(WebSocket(port(), "/v1/models", "").handshake().status, 404);
  EXPECT_EQ(WebSocket(port(), "/v1/streams/demo", "", {{"Origin", "https://evil.example"}}).handshake().status, 403);
}

TEST_F(Streams, DemoInJson_IsHeaderKeyframeFrames) {
  WebSocket socket(port(), "/v1/streams/demo", "semblante.v1.json");
  socket.send_text(hello("subscribe"));
  const auto header = next(socket);
  EXPECT_EQ(header["type"], "header");
  EXPECT_EQ(header["quantizers"], json::array()) << "the standard steps are not sent";
  EXPECT_EQ(header["fps_hint"], 25.0);
  const auto keyframe = next(socket);
  EXPECT_EQ(keyframe["type"], "keyframe");
  auto sequence = keyframe["sequence"].get<std::uint64_t>();
  for (int i = 0; i < 10; ++i) {
    const auto frames = next(socket);
    ASSERT_EQ(frames["type"], "frames");
    EXPECT_EQ(frames["sequence"], sequence + 1) << "no frame is lost or doubled";
    sequence += frames["frames"].size();  // a server that comes late sends several at once
  }
}

TEST_F(Streams, DemoInBinary_Decodes) {
  WebSocket socket(port(), "/v1/streams/demo", "semblante.v1");
  FrameEncoder encoder;
  FrameDecoder decoder;
  const auto bytes = encoder.encode(Hello{});
  socket.send({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, true);
  std::vector<Message> messages;
  for (int i = 0; i < 12; ++i) {
    const auto text = socket.receive();
    ASSERT_TRUE(text && socket.last_was_binary());
    auto message = decoder.decode({reinterpret_cast<const std::uint8_t*>(text->data()), text->size()});
    ASSERT_TRUE(message) << message.error().message;
    messages.push_back(*message);
    if (const auto* frames = std::get_if<Frames>(&*message)) {
      EXPECT_LT(text->size(), 120U * frames->frames.size()) << "a frame is a few bytes";
    }
  }
  EXPECT_TRUE(std::holds_alternative<Header>(messages[0]));
  EXPECT_TRUE(std::holds_alternative<Keyframe>(messages[1]));
  EXPECT_TRUE(std::holds_alternative<Frames>(messages[2]));
}

double fap_3(const json& message) { return message["frames"][0].value("faps", json::object()).value("3", 0.0); }

/// FAP 3 has a standard step of 4: one unit is nothing there, and two levels of an eighth of it.
TEST_F(Streams, FinerSteps_KeepWhatStandardOnesRound) {
  const auto made =
      request(port(), "POST", "/v1/streams", R"({"name":"fine","batch_interval":0,"quantizer_scale":0.125})",
              {{"Content-Type", "application/json"}});
  EXPECT_EQ(made.status, 201) << made.body;
  EXPECT_EQ(json_of(made)["quantizer_scale"], 0.125);
  const auto refused = request(port(), "POST", "/v1/streams", R"({"name":"odd","quantizer_scale":0.3})",
                               {{"Content-Type", "application/json"}});
  EXPECT_EQ(refused.status, 422);
  EXPECT_EQ(json_of(refused)["pointer"], "/quantizer_scale");

  for (const bool fine : {true, false}) {
    const auto stream = fine ? std::string("/v1/streams/fine") : create("coarse");
    WebSocket text(port(), stream, "semblante.v1.json");
    text.send_text(hello("subscribe"));
    const auto steps = next(text)["quantizers"];
    ASSERT_EQ(steps.size(), fine ? 66U : 0U) << "the standard steps are not sent";
    if (fine) {
      EXPECT_EQ(steps[0], 0.5);
    }
    EXPECT_EQ(next(text)["type"], "keyframe");
    WebSocket binary(port(), stream, "semblante.v1");
    FrameDecoder decoder;
    const auto bytes = FrameEncoder().encode(Hello());
    binary.send({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, true);
    const auto read = [&]() -> Message {
      const auto message = binary.receive();
      if (!message) return End{};
      auto decoded = decoder.decode({reinterpret_cast<const std::uint8_t*>(message->data()), message->size()});
      return decoded ? *decoded : Message(End{});
    };
    const auto header = read();
    ASSERT_TRUE(std::holds_alternative<Header>(header));
    EXPECT_EQ(quantizers_of(std::get<Header>(header))[3], fine ? 0.5 : 4.0);
    ASSERT_TRUE(std::holds_alternative<Keyframe>(read()));

    post(stream, 1);
    EXPECT_EQ(fap_3(next(text)), fine ? 1.0 : 0.0);
    const auto frames = read();
    ASSERT_TRUE(std::holds_alternative<Frames>(frames));
    EXPECT_EQ(std::get<Frames>(frames).frames.at(0).state.level[3], fine ? 2 : 0);

    // A publisher in JSON goes by the same steps, and so does what plays.
    WebSocket publisher(port(), stream, "semblante.v1.json");
    publisher.send_text(hello("publish"));
    EXPECT_EQ(next(publisher)["type"], "header");
    publisher.send_text(R"({"type":"frames","sequence":0,"media_time":0,"frames":[{"time":0,"faps":{"3":2.5}}]})");
    EXPECT_EQ(fap_3(next(text)), fine ? 2.5 : 4.0);
    publisher.send_text(R"({"type":"end"})");
    EXPECT_EQ(next(publisher)["type"], "end");
    const auto playing = request(
        port(), "POST", stream + "/performances",
        R"({"format":"semblante.performance","version":1,"duration":60000,"cues":[{"time":0,"fap":3,"value":7.5,"duration":60000,"attack":0,"release":0}]})",
        {{"Content-Type", "application/json"}});
    EXPECT_EQ(playing.status, 202) << playing.body;
    EXPECT_EQ(fap_3(next(text)), fine ? 7.5 : 8.0);
  }
}

TEST_F(Streams, Published_ReachesSubscribersOfBothKinds) {
  const auto stream = create("both");
  WebSocket subscriber(port(), stream, "");
  subscriber.send_text(hello("subscribe"));
  EXPECT_EQ(next(subscriber)["type"], "header");
  EXPECT_EQ(next(subscriber)["sequence"], 0);
  WebSocket binary(port(), stream, "semblante.v1");
  FrameEncoder hello_encoder;
  FrameDecoder decoder;
  const auto bytes = hello_encoder.encode(Hello{});
  binary.send({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, true);
  for (int i = 0; i < 2; ++i) {
    const auto text = binary.receive();
    ASSERT_TRUE(text);
    ASSERT_TRUE(decoder.decode({reinterpret_cast<const std::uint8_t*>(text->data()), text->size()}));
  }

  WebSocket publisher(port(), stream, "semblante.v1.json");
  publisher.send_text(hello("publish"));
  EXPECT_EQ(next(publisher)["type"], "header");
  publisher.send_text(
      R"({"type":"frames","sequence":1,"media_time":0,"frames":[{"time":0,"viseme":{"select1":10,"select2":0,"blend":63},"faps":{"3":200}}]})");
  const auto frames = next(subscriber);
  EXPECT_EQ(frames["sequence"], 1);
  EXPECT_EQ(frames["frames"][0]["viseme"]["select1"], 10);
  EXPECT_EQ(frames["frames"][0]["faps"]["3"], 200.0);
  const auto text = binary.receive();
  ASSERT_TRUE(text);
  const auto message = decoder.decode({reinterpret_cast<const std::uint8_t*>(text->data()), text->size()});
  ASSERT_TRUE(message);
  EXPECT_EQ(std::get<Frames>(*message).frames.at(0).state.viseme.select1, 10);

  // One publisher at a time, on either way in.
  WebSocket second(port(), stream, "");
  second.send_text(hello("publish"));
  const auto refusal = next(second);
  EXPECT_EQ(refusal["type"], "error");
  EXPECT_EQ(refusal["code"], "conflict");
  EXPECT_FALSE(second.receive());
  EXPECT_EQ(second.close_code(), 1008);
  EXPECT_EQ(request(port(), "POST", stream + "/frames", R"({"frames":[{}]})").status, 409);
}

TEST_F(Streams, Performance_IsPlayedAtItsTimesSeenAndEnds) {
  const auto stream = create("stage");
  WebSocket subscriber(port(), stream, "semblante.v1.json");
  subscriber.send_text(hello("subscribe"));
  EXPECT_EQ(next(subscriber).value("type", ""), "header");
  EXPECT_EQ(next(subscriber).value("type", ""), "keyframe");
  const auto document = R"({"format":"semblante.performance","version":1,"name":"Jaw","duration":1000,"cues":[
    {"time":0,"fap":"open_jaw","keys":[[0,0],[1000,1000]],"easing":"linear"}]})";
  const auto reply = request(port(), "POST", stream + "/performances?fps=50&from=200", document, json_type);
  ASSERT_EQ(reply.status, 202) << reply.body;
  const auto playing = json::parse(reply.body);
  EXPECT_EQ(playing["kind"], "performance");
  EXPECT_EQ(playing["name"], "Jaw");
  EXPECT_EQ(playing["duration"], 1000.0);
  EXPECT_EQ(reply.headers.at("location"), stream + "/performances/" + playing["id"].get<std::string>());

  // A server that comes late leaves frames out, but not the last.
  double begin = -1.0;
  double first = 0.0;
  double last = -1.0;
  while (true) {
    const auto message = next(subscriber);
    ASSERT_EQ(message.value("type", ""), "frames") << message;
    const auto time = message["media_time"].get<double>();
    const auto& frame = message["frames"][0];
    const double jaw = frame.contains("faps") && frame["faps"].contains("3") ? frame["faps"]["3"].get<double>() : 0.0;
    if (begin < 0.0) {
      begin = time;
      first = jaw;
    }
    // The value tells the time it belongs to: that and the media time agree to a millisecond and the quantizer's step.
    if (jaw > 0.0) {
      EXPECT_NEAR(time - begin, jaw - first, 5.0);
    }
    if (jaw == 0.0) break;  // from its duration on no cue is active
    EXPECT_GT(jaw, last);
    last = jaw;
  }
  EXPECT_TRUE(
      testing::eventually([&] { return json::parse(request(port(), "GET", stream).body)["playing"].is_null(); }));
}

TEST_F(Streams, Performance_TakesOverOnlyIfItSaysSo) {
  const auto stream = create("contested");
  WebSocket publisher(port(), stream, "semblante.v1.json");
  publisher.send_text(hello("publish"));
  EXPECT_EQ(next(publisher).value("type", ""), "header");
  const auto document = R"({"format":"semblante.performance","version":1,"idle":{"seed":3}})";
  EXPECT_EQ(request(port(), "POST", stream + "/performances", document, json_type).status, 409);
  const auto reply = request(port(), "POST", stream + "/performances?take_over=true&loop=true", document, json_type);
  ASSERT_EQ(reply.status, 202) << reply.body;
  const auto end = next(publisher);
  EXPECT_EQ(end.value("type", ""), "end");
  EXPECT_EQ(end.value("reason", ""), "replaced");
  const auto address = reply.headers.at("location");
  EXPECT_EQ(request(port(), "GET", address).status, 200);
  EXPECT_EQ(json::parse(request(port(), "GET", stream).body)["playing"]["id"], json::parse(reply.body)["id"]);
  EXPECT_EQ(request(port(), "POST", stream + "/performances", document, json_type).status, 409);
  EXPECT_EQ(request(port(), "POST", stream + "/frames", R"({"frames":[{}]})", json_type).status, 409);
  EXPECT_EQ(request(port(), "DELETE", address).status, 204);
  EXPECT_EQ(request(port(), "DELETE", address).status, 404);
  EXPECT_EQ(request(port(), "POST", stream + "/frames", R"({"frames":[{}]})", json_type).status, 202);
}

TEST_F(Streams, BadPerformances_NameThePlace) {
  const auto stream = create("strict");
  const auto refused = [&](const std::string& body, const std::string& query, int status, const std::string& pointer) {
    const auto reply = request(port(), "POST", stream + "/performances" + query, body, json_type);
    EXPECT_EQ(reply.status, status) << reply.body;
    EXPECT_EQ(json::parse(reply.body).value("pointer", ""), pointer) << reply.body;
  };
  const auto with = [](const std::string& cues) {
    return R"({"format":"semblante.performance","version":1,"cues":[)" + cues + "]}";
  };
  const std::string blink = R"({"time":9,"blink":"both"})";
  refused(with(blink + R"(,{"time":8,"blink":"both"})"), "", 422, "/cues/1/time");
  refused(with(R"({"time":0,"duration":1,"fap":69,"value":1})"), "", 422, "/cues/0/fap");
  refused(with(R"({"time":0,"duration":1,"fap":3,"value":1e999})"), "", 422, "/cues/0/value");
  refused(with(R"({"time":0,"duration":1,"fap":3,"value":NaN})"), "", 400, "");
  refused("{", "", 400, "");
  refused(with(blink), "?fps=1000", 400, "?fps");
  refused(with(blink), "?loop=yes", 400, "?loop");
  refused(with(blink), "?from=9000", 400, "?from");
  std::string cues;
  for (int i = 0; i < 100'000; ++i) cues += R"({"time":0,"blink":"both"},)";
  refused(with(cues + blink), "", 413, "/cues");
  const auto huge = raw_exchange(port(), "POST " + stream +
                                             "/performances HTTP/1.1\r\nHost: localhost\r\n"
                                             "Content-Type: application/json\r\nContent-Length: 400000000\r\n\r\n");
  EXPECT_THAT(huge, HasSubstr(" 413 ")) << "ten million cues are refused by their size, before they are read";
}

std::string fap_mask(const std::vector<int>& faps) {
  std::string text;
  for (int fap = 1; fap <= 68; ++fap)
    text.append(std::find(faps.begin(), faps.end(), fap) == faps.end() ? "0" : "1").append(fap < 68 ? " " : "\n");
  return text;
}

TEST_F(Streams, FapFile_IsPlayedInRealTime) {
  const auto stream = create("fap");
  WebSocket subscriber(port(), stream, "semblante.v1.json");
  subscriber.send_text(hello("subscribe"));
  EXPECT_EQ(next(subscriber).value("type", ""), "header");
  EXPECT_EQ(next(subscriber).value("type", ""), "keyframe");
  // Ten frames at 20 a second; every second one leaves FAP 3 out; the last is beyond the range of FAP 4.
  std::string file = "2.1 my talk 20 10\n";
  for (int i = 0; i < 10; ++i) {
    const bool open = i % 2 == 0;
    file += fap_mask(open ? std::vector{3, 4} : std::vector{4}) + std::to_string(i) + (open ? " 400 " : " ") +
            std::to_string(i == 9 ? 99999 : 20 * i) + "\n";
  }
  const auto reply = request(port(), "POST", stream + "/fap?absent=keep", file, {{"Content-Type", "text/plain"}});
  ASSERT_EQ(reply.status, 202) << reply.body;
  const auto playing = json::parse(reply.body);
  EXPECT_EQ(playing["kind"], "fap");
  EXPECT_EQ(playing["name"], "my_talk");
  EXPECT_EQ(playing["fps"], 20.0);
  EXPECT_EQ(playing["duration"], 500.0);
  ASSERT_EQ(playing["warnings"].size(), 1U);
  EXPECT_THAT(playing["warnings"][0].get<std::string>(), HasSubstr("line 1: blanks"));

  // A server that comes late leaves frames out, but not the last.
  double begin = -1.0;
  double first = 0.0;
  double lip = -1.0;
  while (lip < 1200.0) {
    const auto message = next(subscriber);
    ASSERT_EQ(message.value("type", ""), "frames") << message;
    const auto& faps = message["frames"][0]["faps"];
    EXPECT_EQ(faps.value("3", 0.0), 400.0) << "what a frame leaves out is kept";
    lip = faps.value("4", 0.0);
    const auto time = message["media_time"].get<double>();
    if (begin < 0.0) {
      begin = time;
      first = lip;
    }
    if (lip < 1200.0) {
      EXPECT_NEAR(time - begin, (lip - first) / 20 * 50, 2.0) << "frame k is at k / rate";
    }
  }
  EXPECT_EQ(lip, 1200.0) << "600 levels of 2: the end of the range";
  EXPECT_GE(json::parse(request(port(), "GET", stream).body)["clamped_values"].get<int>(), 1);
  EXPECT_THAT(request(port(), "GET", "/metrics").body, HasSubstr("semblante_stream_clamped_values_total"));
}

TEST_F(Streams, BadFapFiles_NameLineAndWord) {
  const auto stream = create("badfap");
  const auto refused = [&](const std::string& body, const std::string& query, int status, const std::string& where) {
    const auto reply = request(port(), "POST", stream + "/fap" + query, body, {{"Content-Type", "text/plain"}});
    EXPECT_EQ(reply.status, status) << reply.body;
    EXPECT_EQ(json::parse(reply.body).value("pointer", ""), where) << reply.body;
  };
  const std::string good = "2.1 x 25 1\n" + fap_mask({3}) + "0 100\n";
  refused("2.1 x 25 1\n" + fap_mask({3}) + "0 viel\n", "", 422, "line 3, word 2");
  refused("\n", "", 422, "line 1");
  refused("{}", "", 422, "line 1");
  refused(good, "?absent=maybe", 400, "?absent");
  refused(good, "?gaps=1", 400, "?gaps");
  refused(good, "?fps=0", 400, "?fps");
  refused(good, "?from=1000", 400, "?from");
  EXPECT_EQ(request(port(), "POST", "/v1/streams/nowhere/fap", good, {{"Content-Type", "text/plain"}}).status, 404);
  EXPECT_EQ(request(port(), "POST", stream + "/fap", good, {{"Content-Type", "image/png"}}).status, 415);
}

TEST_F(Streams, FramesByRequest_BeyondTheirRange_AreClampedAndCounted) {
  const auto stream = create("clamped");
  const auto reply = request(port(), "POST", stream + "/frames",
                             R"({"frames":[{"faps":{"3":-4320,"4":1202}},{"faps":{"23":-153600,"24":-153728}}]})",
                             {{"Content-Type", "application/json"}});
  ASSERT_EQ(reply.status, 202) << reply.body;
  EXPECT_EQ(json::parse(reply.body)["clamped"], 2);
  EXPECT_EQ(json::parse(request(port(), "GET", stream).body)["clamped_values"], 2);
}

TEST_F(Streams, FramesInArkitsTerms_ArriveAsFaps) {
  const auto stream = create("arkit");
  WebSocket subscriber(port(), stream, "semblante.v1.json");
  subscriber.send_text(hello("subscribe"));
  EXPECT_EQ(next(subscriber).value("type", ""), "header");
  EXPECT_EQ(next(subscriber).value("type", ""), "keyframe");
  const auto reply = request(port(), "POST", stream + "/frames",
                             R"({"frames":[{"arkit":{"jawOpen":1.5,"eyeBlinkLeft":1},"faps":{"4":1202}},)"
                             R"({"oculus":{"aa":1}}]})",
                             json_type);
  ASSERT_EQ(reply.status, 202) << reply.body;
  EXPECT_EQ(json::parse(reply.body)["clamped"], 2) << "a coefficient and a FAP";
  const auto message = next(subscriber);
  ASSERT_EQ(message["frames"].size(), 2U) << message;
  const auto& faps = message["frames"][0]["faps"];
  EXPECT_GT(faps.value("3", 0.0), 200.0) << "the jaw is open";
  EXPECT_GT(faps.value("19", 0.0), 500.0) << "the left upper lid is down";
  EXPECT_EQ(faps.value("20", 0.0), 0.0) << "the right one is not";
  EXPECT_EQ(faps.value("4", 0.0), 1200.0) << "what `faps` says goes before what the coefficients say";
  EXPECT_FALSE(message["frames"][0].contains("arkit"));
  EXPECT_EQ(message["frames"][1]["viseme"]["select1"], 10);
  const auto wrong = request(port(), "POST", stream + "/frames", R"({"frames":[{"arkit":{"jawopen":1}}]})", json_type);
  EXPECT_EQ(wrong.status, 422);
  EXPECT_EQ(json::parse(wrong.body).value("pointer", ""), "/frames/0/arkit/jawopen");
}

TEST_F(Streams, LateJoin_GetsTheNewestStateAtOnce) {
  const auto stream = create("late");
  post(stream, 100);
  post(stream, 300);
  WebSocket socket(port(), stream, "");
  socket.send_text(hello("subscribe"));
  EXPECT_EQ(next(socket)["sequence"], 2);
  const auto keyframe = next(socket);
  EXPECT_EQ(keyframe["sequence"], 2);
  EXPECT_EQ(keyframe["state"]["faps"]["3"], 300.0);
}

TEST_F(Streams, Resume_ReplaysTheGapOrSaysThatItCannot) {
  const auto stream = create("resume");
  std::uint64_t epoch = 0;
  {
    WebSocket socket(port(), stream, "");
    socket.send_text(hello("subscribe"));
    epoch = next(socket)["epoch"].get<std::uint64_t>();
    next(socket);
    post(stream, 100);
    EXPECT_EQ(next(socket)["sequence"], 1);
  }
  post(stream, 200);
  post(stream, 300);
  const auto resume = [&](std::uint64_t of_epoch, int sequence) {
    return R"({"type":"hello","version":1,"role":"subscribe","resume":{"epoch":)" + std::to_string(of_epoch) +
           R"(,"sequence":)" + std::to_string(sequence) + "}}";
  };
  WebSocket back(port(), stream, "");
  back.send_text(resume(epoch, 1));
  EXPECT_EQ(next(back)["recovered"], true);
  const auto keyframe = next(back);
  EXPECT_EQ(keyframe["sequence"], 1);
  EXPECT_EQ(keyframe["state"]["faps"]["3"], 100.0);
  EXPECT_EQ(next(back)["frames"][0]["faps"]["3"], 200.0);
  EXPECT_EQ(next(back)["frames"][0]["faps"]["3"], 300.0);

  WebSocket other_epoch(port(), stream, "");
  other_epoch.send_text(resume(epoch - 1, 1));
  EXPECT_EQ(next(other_epoch)["recovered"], false);
  EXPECT_EQ(next(other_epoch)["sequence"], 3);
}

TEST_F(Streams, BadMessages_AreAnsweredAndTheServerGoesOn) {
  const auto stream = create("bad");
  WebSocket publisher(port(), stream, "semblante.v1.json");
  const auto frames_with = [](const std::string& frame) {
    return R"({"type":"frames","sequence":1,"media_time":0,"frames":[)" + frame + "]}";
  };
  publisher.send_text(frames_with("{}"));
  EXPECT_EQ(next(publisher)["code"], "missing") << "the hello comes first";
  publisher.send_text(hello("publish"));
  EXPECT_EQ(next(publisher)["type"], "header");
  struct Case {
    std::string frame, where;
  };
  for (const auto& item : {Case{R"({"faps":{"99":1}})", "/frames/0/faps/99"},
                           Case{R"({"viseme":{"select1":15}})", "/frames/0/viseme/select1"},
                           Case{R"({"faps":{"3":"wide"}})", "/frames/0/faps/3"}}) {
    publisher.send_text(frames_with(item.frame));
    const auto error = next(publisher);
    EXPECT_EQ(error["type"], "error");
    EXPECT_EQ(error["where"], item.where);
    EXPECT_FALSE(error.value("message", "").empty());
  }
  publisher.send_text(std::string(65536, 'x'));
  EXPECT_EQ(next(publisher)["type"], "error");
  publisher.send(std::string(65536, '\xfe'), true);
  EXPECT_EQ(next(publisher)["type"], "error");
  publisher.send_text(frames_with(R"({"faps":{"3":5}})"));
  publisher.send_text(R"({"type":"ping","id":7,"client_time":1})");
  EXPECT_EQ(next(publisher)["id"], 7) << "nothing was wrong with the good frame";
  EXPECT_EQ(json_of(request(port(), "GET", stream))["sequence"], 1);
}

TEST_F(Streams, BinaryGarbage_IsAnsweredAndTheServerGoesOn) {
  const auto stream = create("garbage");
  WebSocket socket(port(), stream, "semblante.v1");
  socket.send(std::string(65536, '\xa5'), true);
  const auto text = socket.receive();
  ASSERT_TRUE(text);
  const auto message = FrameDecoder().decode({reinterpret_cast<const std::uint8_t*>(text->data()), text->size()});
  ASSERT_TRUE(message);
  EXPECT_TRUE(std::holds_alternative<StreamError>(*message));
  EXPECT_EQ(request(port(), "GET", "/healthz").status, 200);
}

TEST_F(Streams, Deleted_IsToldToEveryone) {
  const auto stream = create("short");
  WebSocket socket(port(), stream, "");
  socket.send_text(hello("subscribe"));
  next(socket);
  next(socket);
  EXPECT_EQ(request(port(), "DELETE", stream).status, 204);
  const auto end = next(socket);
  EXPECT_EQ(end["type"], "end");
  EXPECT_EQ(end["reason"], "deleted");
  EXPECT_FALSE(socket.receive());
  EXPECT_EQ(socket.close_code(), 1000);
}

/// KiB in memory, by the kernel's account.
long resident_kib(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  std::string line;
  while (std::getline(status, line))
    if (line.starts_with("VmRSS:")) return std::stol(line.substr(6));
  return 0;
}

TEST_F(Streams, WhoDoesNotRead_CostsNobodyAFrame_TakesBoundedMemory_AndIsClosed) {
  const auto stream = create("slow");
  constexpr int count = 10;
  std::vector<std::unique_ptr<WebSocket>> slow;
  for (int i = 0; i < count; ++i) {
    slow.push_back(std::make_unique<WebSocket>(port(), stream, "", Fields{}, 4096));
    slow.back()->send_text(hello("subscribe"));
  }
  const auto memory = resident_kib(server().pid());
  WebSocket quick(port(), stream, "");
  quick.send_text(hello("subscribe"));
  next(quick);
  next(quick);
  WebSocket publisher(port(), stream, "");
  publisher.send_text(hello("publish"));
  next(publisher);
  // A batch of 100 frames is about 30 kB of JSON: far more in all than the kernel holds for one who does not read.
  std::string batch = R"({"type":"frames","sequence":1,"media_time":0,"frames":[)";
  for (int i = 0; i < 100; ++i) {
    batch += i == 0 ? "{" : ",{";
    batch += R"("time":)" + std::to_string(i) + R"(,"faps":{)";
    for (int fap = 3; fap <= 22; ++fap)
      batch += (fap == 3 ? "\"" : ",\"") + std::to_string(fap) + "\":" + std::to_string(10 * (i + 1));
    batch += "}}";
  }
  batch += "]}";
  std::uint64_t sequence = 1;
  const std::string all_closed =
      "semblante_stream_connections_closed_total{reason=\"slow\"} " + std::to_string(count) + "\n";
  // Within the publisher's 500 frames a second (2000 at once), until the slow ones are given up. By how much they delay
  // the others is what bench_fanout --stall measures.
  testing::eventually(
      [&] {
        publisher.send_text(batch);
        const auto message = next(quick);
        EXPECT_EQ(message.value("type", ""), "frames");
        EXPECT_EQ(message.value("sequence", std::uint64_t{0}), sequence) << "nothing is lost, nothing comes twice";
        sequence += 100;
        return HasFailure() || request(port(), "GET", "/metrics").body.find(all_closed) != std::string::npos;
      },
      std::chrono::milliseconds(200));
  EXPECT_THAT(request(port(), "GET", "/metrics").body, HasSubstr(all_closed));
#if !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)
  // All of them share what is held, some 2 MB of the stream's own; copies of what waits for each would be 15 MB.
  EXPECT_LT(resident_kib(server().pid()) - memory, 12 * 1024);
#else
  EXPECT_GT(memory, 0);
#endif
  for (const auto& socket : slow) {
    while (socket->receive()) {
    }
    EXPECT_TRUE(socket->close_code() == 1013 || socket->close_code() == 0) << socket->close_code();
  }
}

TEST_F(Streams, ZStop_TellsSubscribersGoodbye) {
  WebSocket socket(port(), "/v1/streams/demo", "");
  socket.send_text(hello("subscribe"));
  next(socket);
  kill(server().pid(), SIGTERM);
  json last;
  while (const auto text = socket.receive()) last = json::parse(*text);
  EXPECT_EQ(last["type"], "end");
  EXPECT_EQ(last["reason"], "shutdown");
  EXPECT_EQ(socket.close_code(), 1001);
  EXPECT_EQ(server().end(0), 0) << "without another signal, which would end it at once";
}

}  // namespace
}  // namespace semblante::test
