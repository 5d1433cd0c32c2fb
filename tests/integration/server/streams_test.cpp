// Streams of a real server, by a WebSocket client that shares no code with it.

#include <csignal>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/cpp/frame_codec.h"
#include "tests/integration/server/model_flow.h"

namespace semblante::test {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using ::testing::HasSubstr;

class Streams : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    server_ = new ServerProcess(folder_->path() / "data", {"--demo"});
  }
  static void TearDownTestSuite() {
    delete server_;
    delete folder_;
  }
  static int port() { return server_->port(); }
  static std::string create(const std::string& name) {
    request(port(), "POST", "/v1/streams", R"({"name":")" + name + R"("})", {{"Content-Type", "application/json"}});
    return "/v1/streams/" + name;
  }
  static json next(WebSocket& socket, milliseconds limit = milliseconds(5000)) {
    const auto text = socket.receive(limit);
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

  static inline TemporaryFolder* folder_ = nullptr;
  static inline ServerProcess* server_ = nullptr;
};

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
  EXPECT_EQ(header["quantizers"].size(), 66U);
  EXPECT_EQ(header["fps_hint"], 25.0);
  const auto keyframe = next(socket);
  EXPECT_EQ(keyframe["type"], "keyframe");
  auto sequence = keyframe["sequence"].get<std::uint64_t>();
  for (int i = 0; i < 10; ++i) {
    const auto frames = next(socket);
    ASSERT_EQ(frames["type"], "frames");
    EXPECT_EQ(frames["sequence"], ++sequence) << "no frame is lost or doubled";
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
    if (i >= 2) {
      EXPECT_LT(text->size(), 120U) << "a frame is a few bytes";
    }
  }
  EXPECT_TRUE(std::holds_alternative<Header>(messages[0]));
  EXPECT_TRUE(std::holds_alternative<Keyframe>(messages[1]));
  EXPECT_TRUE(std::holds_alternative<Frames>(messages[2]));
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

TEST_F(Streams, SlowReader_DelaysNobodyAndIsClosed) {
  const auto stream = create("slow");
  WebSocket slow(port(), stream, "", {}, 4096);
  slow.send_text(hello("subscribe"));
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
  int rounds = 0;
  int received = 0;
  const auto begin = std::chrono::steady_clock::now();
  // Within the publisher's 500 frames a second (2000 at once), until the slow one must have been given up.
  for (; std::chrono::steady_clock::now() - begin < std::chrono::seconds(16); ++rounds) {
    publisher.send_text(batch);
    if (next(quick, milliseconds(2000)).value("type", "") == "frames") ++received;
    timespec pause{0, 200'000'000};
    nanosleep(&pause, nullptr);
    if (request(port(), "GET", "/metrics").body.find("closed_slow_total 1") != std::string::npos) break;
  }
  EXPECT_GT(2 * received, rounds) << "the quick one got its frames meanwhile";
  EXPECT_THAT(request(port(), "GET", "/metrics").body, HasSubstr("semblante_stream_closed_slow_total 1\n"));
  while (slow.receive(milliseconds(3000))) {
  }
  EXPECT_TRUE(slow.close_code() == 1013 || slow.close_code() == 0) << slow.close_code();
}

TEST_F(Streams, ZStop_TellsSubscribersGoodbye) {
  WebSocket socket(port(), "/v1/streams/demo", "");
  socket.send_text(hello("subscribe"));
  next(socket);
  kill(server_->pid(), SIGTERM);
  json last;
  while (const auto text = socket.receive(milliseconds(5000))) last = json::parse(*text);
  EXPECT_EQ(last["type"], "end");
  EXPECT_EQ(last["reason"], "shutdown");
  EXPECT_EQ(socket.close_code(), 1001);
  EXPECT_EQ(server_->end(SIGTERM), 0);
}

}  // namespace
}  // namespace semblante::test
