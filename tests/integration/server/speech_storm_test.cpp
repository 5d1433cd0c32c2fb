// Speech that is started, stopped, replaced and deleted from many sides at once, while others listen, record and
// publish. SEMBLANTE_STORM_SECONDS sets how long it lasts; by default it is short.

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <random>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "protocol/cpp/json_codec.h"
#include "tests/integration/server/test_client.h"
#include "tests/integration/server/troubled_voice.h"
#include "tests/support/wait.h"

namespace semblante::test {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string sentence = "A sentence that is long enough to be a part. ";

class Storm {
 public:
  Storm() : server_(folder_.path() / "data", {"--voice-program", troubled_voice, "--threads", "8"}) {
    for (const auto& stream : streams_) open(stream);
    const auto stored = ask("POST", "/v1/speeches", {{"text", sentence + sentence}, {"language", "en"}});
    EXPECT_EQ(stored.status, 201) << stored.body;
    stored_ = json::parse(stored.body)["id"];
  }

  void blow(std::chrono::seconds length) {
    using Side = void (Storm::*)(std::mt19937&);
    constexpr Side sides[] = {&Storm::speak,  &Storm::speak,  &Storm::speak,   &Storm::listen,
                              &Storm::listen, &Storm::record, &Storm::publish, &Storm::reopen};
    const auto end = std::chrono::steady_clock::now() + length;
    std::vector<std::thread> threads;
    unsigned seed = 1;
    for (const Side side : sides)
      threads.emplace_back([this, side, end, number = seed++] {
        std::mt19937 random(number);
        while (std::chrono::steady_clock::now() < end) (this->*side)(random);
      });
    for (auto& thread : threads) thread.join();
  }

  /// Nothing of it is left: no voice, no play; and the server speaks as before.
  void expect_calm() {
    for (const auto& stream : streams_) ask("DELETE", "/v1/streams/" + stream);
    EXPECT_TRUE(testing::eventually([&] { return voices_of(server_.pid()) == 0; }));
    open("calm");
    WebSocket listener(server_.port(), "/v1/streams/calm", "semblante.v1.json");
    listener.send_text(R"({"type":"hello","version":1,"sound":true})");
    const auto answer = ask("POST", "/v1/streams/calm/speech", {{"text", sentence + sentence}, {"language", "en"}});
    EXPECT_EQ(answer.status, 202) << answer.body;
    int packets = 0;
    while (packets < 20) {
      const auto text = listener.receive();
      ASSERT_TRUE(text);
      const auto message = decode_json(*text);
      packets += message && std::holds_alternative<SoundPacket>(*message) ? 1 : 0;
    }
    EXPECT_EQ(server_.end(SIGTERM), 0);
    EXPECT_THAT(server_.errors(), Not(HasSubstr("Sanitizer")));
    EXPECT_THAT(server_.errors(), Not(HasSubstr("has failed")));
    std::printf("%d speeches began, %d were refused; %d messages were heard\n", begun_.load(), refused_.load(),
                heard_.load());
    EXPECT_GT(begun_, 0);
    EXPECT_GT(heard_, 0);
  }

 private:
  Reply ask(const std::string& method, const std::string& target, const json& body = {}) const {
    return request(server_.port(), method, target, body.is_null() ? "" : body.dump(),
                   body.is_null() ? Fields{} : json_type);
  }
  void open(const std::string& stream) const {
    EXPECT_THAT(ask("POST", "/v1/streams", {{"name", stream}, {"batch_interval", 0}}).status, AnyOf(201, 409));
  }
  static unsigned one_of(std::mt19937& random, unsigned count) { return static_cast<unsigned>(random() % count); }
  const std::string& any_stream(std::mt19937& random) const { return streams_[one_of(random, streams_.size())]; }

  void speak(std::mt19937& random) {
    const std::string texts[] = {"Mamma mia!",
                                 sentence + sentence + "[joy]" + sentence + "[/joy]",
                                 sentence + "This one is late.",
                                 sentence + "This one is never there.",
                                 sentence + "This one is broken.",
                                 "broken"};
    const auto kind = one_of(random, 7);
    json wish = kind == 6 ? json{{"speech", stored_}} : json{{"text", texts[kind]}, {"language", "en"}};
    wish["take_over"] = one_of(random, 2) == 0;
    const auto answer = ask("POST", "/v1/streams/" + any_stream(random) + "/speech", wish);
    EXPECT_THAT(answer.status, AnyOf(202, 404, 409, 429, 502)) << answer.body;
    ++(answer.status == 202 ? begun_ : refused_);
    std::this_thread::sleep_for(milliseconds(one_of(random, 150)));
    if (answer.status == 202 && one_of(random, 2) == 0) {
      EXPECT_THAT(ask("DELETE", answer.headers.at("location")).status, AnyOf(204, 404));
    }
  }

  void listen(std::mt19937& random) {
    constexpr const char* wishes[] = {"", R"(,"sound":true)", R"(,"text":true)", R"(,"sound":true,"text":true)"};
    WebSocket listener(server_.port(), "/v1/streams/" + any_stream(random), "semblante.v1.json");
    if (listener.handshake().status != 101) return;
    listener.send_text(R"({"type":"hello","version":1)" + std::string(wishes[one_of(random, 4)]) + "}");
    for (auto left = one_of(random, 60); left > 0; --left) {
      const auto text = listener.receive(milliseconds(100));
      if (!text) return;
      EXPECT_TRUE(decode_json(*text)) << *text;
      ++heard_;
    }
  }

  void record(std::mt19937& random) {
    const auto made = ask("POST", "/v1/streams/" + any_stream(random) + "/recordings", json::object());
    EXPECT_THAT(made.status, AnyOf(201, 404, 409)) << made.body;
    if (made.status != 201) return;
    std::this_thread::sleep_for(milliseconds(one_of(random, 300)));
    const auto recording = json::parse(made.body)["links"]["self"].get<std::string>();
    EXPECT_THAT(ask("POST", recording + "/stop").status, AnyOf(200, 409));
    EXPECT_THAT(ask("DELETE", recording).status, AnyOf(204, 409));
  }

  void publish(std::mt19937& random) {
    WebSocket publisher(server_.port(), "/v1/streams/" + any_stream(random), "semblante.v1.json");
    if (publisher.handshake().status != 101) return;
    publisher.send_text(R"({"type":"hello","version":1,"role":"publish","sound":true,"take_over":true})");
    const std::vector<std::uint8_t> packet = {0x08, 1, 2, 3};  // 20 ms
    for (std::uint64_t k = 0; k < 10; ++k) {
      publisher.send_text(encode_json(Frames{0, 20 * k, {{0, FaceFrame{}}}}));
      publisher.send_text(encode_json(SoundPacket{20 * k, packet}));
      std::this_thread::sleep_for(milliseconds(20));
    }
  }

  void reopen(std::mt19937& random) {
    std::this_thread::sleep_for(milliseconds(one_of(random, 400)));
    const auto& stream = streams_.back();
    EXPECT_THAT(ask("DELETE", "/v1/streams/" + stream).status, AnyOf(204, 404));
    open(stream);
  }

  const std::vector<std::string> streams_ = {"north", "south", "deleted"};
  TemporaryFolder folder_;
  ServerProcess server_;
  std::string stored_;
  std::atomic<int> begun_{0}, refused_{0}, heard_{0};
};

TEST(SpeechStorm, FromManySidesAtOnce_LeavesNothing) {
  const char* const wished = std::getenv("SEMBLANTE_STORM_SECONDS");
  Storm storm;
  storm.blow(std::chrono::seconds(wished != nullptr ? std::atoi(wished) : 4));
  storm.expect_calm();
}

}  // namespace
}  // namespace semblante::test
