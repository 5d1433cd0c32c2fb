// A stream says the first sentences of a text while a voice speaks the others: what a subscriber gets at the joints,
// and what becomes of a voice that is late, fails or is not wanted any more.

#include <algorithm>
#include <cmath>
#include <csignal>
#include <thread>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/cpp/json_codec.h"
#include "protocol/cpp/opus_packet.h"
#include "tests/integration/server/model_flow.h"
#include "tests/integration/server/troubled_voice.h"
#include "tests/support/wait.h"

namespace semblante::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

const std::string first = "A sentence that is long enough to be a part. ";

/// What a subscriber with sound gets.
struct Heard {
  std::vector<std::uint64_t> frames;  ///< media times, ms
  std::vector<SoundPacket> sound;
  /// Where a packet does not begin at the end of the one before it: by how much later, ms. What is no voice to the
  /// coder is not sent, so there are some also within a part.
  [[nodiscard]] std::vector<double> gaps() const {
    std::vector<double> gaps;
    for (std::size_t i = 1; i < sound.size(); ++i) {
      const double gap = static_cast<double>(sound[i].media_time - sound[i - 1].media_time) -
                         opus_packet_ms(sound[i - 1].packet).value_or(0.0);
      if (gap != 0.0) gaps.push_back(gap);
    }
    return gaps;
  }
  [[nodiscard]] double sound_ms() const {
    return sound.empty() ? 0.0
                         : static_cast<double>(sound.back().media_time - sound.front().media_time) +
                               opus_packet_ms(sound.back().packet).value_or(0.0);
  }
  /// All packets together.
  [[nodiscard]] double packets_ms() const {
    double sum = 0.0;
    for (const auto& packet : sound) sum += opus_packet_ms(packet.packet).value_or(0.0);
    return sum;
  }
  /// Whether the frames but the last, which is the end, are those of one clock, 25 a second. A busy machine leaves some
  /// out.
  [[nodiscard]] bool one_clock() const {
    return !frames.empty() && std::all_of(frames.begin(), frames.end() - 1, [&](auto time) {
      const auto phase = (time - frames.front()) % 40U;
      return phase <= 1U || phase == 39U;  // times are rounded
    });
  }
};

class LiveSpeech : public ::testing::Test {
 protected:
  explicit LiveSpeech(std::string voice = troubled_voice) : voice_(std::move(voice)) {}
  void SetUp() override {
    server_ =
        std::make_unique<ServerProcess>(folder_.path() / "data", std::vector<std::string>{"--voice-program", voice_});
    open_stream();
  }
  void open_stream() {
    heard_ = {};
    ASSERT_EQ(ask("POST", "/v1/streams", R"({"name":"talk","batch_interval":0})").status, 201);
    follow();
  }
  /// Anew where a test has asked for something long: the server closes a listener that answers no ping for a minute.
  void follow() {
    listener_ = std::make_unique<WebSocket>(server_->port(), "/v1/streams/talk", "semblante.v1.json");
    listener_->send_text(R"({"type":"hello","version":1,"sound":true})");
    ASSERT_TRUE(listener_->receive());
  }
  [[nodiscard]] Reply ask(const std::string& method, const std::string& target, const std::string& body = {}) const {
    return request(server_->port(), method, target, body, body.empty() ? Fields{} : json_type);
  }
  [[nodiscard]] Reply say(const std::string& text, bool take_over = false) const {
    return ask("POST", "/v1/streams/talk/speech",
               json{{"text", text}, {"language", "en"}, {"take_over", take_over}}.dump());
  }
  [[nodiscard]] json stream() const { return json_of(ask("GET", "/v1/streams/talk")); }
  void wait_until_it_is_silent() const {
    EXPECT_TRUE(testing::eventually([&] { return stream()["playing"].is_null(); }));
  }
  /// Until `enough`, or the end of the stream.
  template <class Enough>
  void listen(Enough enough) {
    listen_to(*listener_, enough);
  }
  template <class Enough>
  void listen_to(WebSocket& listener, Enough enough) {
    while (!enough()) {
      const auto text = listener.receive();
      ASSERT_TRUE(text);
      const auto message = decode_json(*text);
      ASSERT_TRUE(message) << *text;
      if (const auto* sound = std::get_if<SoundPacket>(&*message)) heard_.sound.push_back(*sound);
      if (const auto* frames = std::get_if<Frames>(&*message)) {
        for (const auto& frame : frames->frames) heard_.frames.push_back(frames->media_time + frame.time);
      }
      if (std::holds_alternative<End>(*message)) return;
    }
  }
  void listen_to_the_end() {
    wait_until_it_is_silent();
    ASSERT_EQ(ask("DELETE", "/v1/streams/talk").status, 204);
    listen([] { return false; });
  }

  /// Says a text of `parts` parts to the end of the stream as if none of them came late. On a busy machine one may, and
  /// the face waits for it, which makes the whole longer than `duration`, ms: then it is said again.
  void say_as_a_whole(const std::string& text, double parts, double duration) {
    EXPECT_TRUE(testing::eventually([&] {
      EXPECT_EQ(say(text).status, 202);
      json plays;  // null when it has ended
      EXPECT_TRUE(testing::eventually([&] {
        plays = stream()["playing"];
        return plays.is_null() || plays.value("complete", true);
      }));
      const double longer = (plays.is_null() ? 0.0 : plays.value("duration", 0.0)) - duration;
      listen_to_the_end();
      const bool as_long = std::abs(longer) <= parts * 10.0;
      if (!as_long) open_stream();
      return as_long;
    }));
  }

  const std::string voice_;
  TemporaryFolder folder_;
  std::unique_ptr<ServerProcess> server_;
  std::unique_ptr<WebSocket> listener_;
  Heard heard_;
};

TEST_F(LiveSpeech, FirstSentence_IsHeard_HoweverLateTheNextIs) {
  const auto answer = say(first + "This one is never there.");
  ASSERT_EQ(answer.status, 202) << answer.body;
  EXPECT_EQ(json_of(answer)["complete"], false);
  const auto duration = json_of(answer)["duration"].get<double>();
  // The face goes on living, and the play does not end.
  listen([&] {
    return !heard_.frames.empty() &&
           static_cast<double>(heard_.frames.back() - heard_.frames.front()) > duration + 500.0;
  });
  EXPECT_GT(heard_.sound_ms(), duration / 2.0);
  EXPECT_TRUE(heard_.one_clock());
  const auto playing = stream()["playing"];
  EXPECT_EQ(playing["complete"], false);
  EXPECT_EQ(playing["failure"], nullptr);

  EXPECT_EQ(voices_of(server_->pid()), 1U);
  EXPECT_EQ(ask("DELETE", answer.headers.at("location")).status, 204);
  EXPECT_TRUE(testing::eventually([&] { return voices_of(server_->pid()) == 0; })) << "nobody hears it any more";
  EXPECT_EQ(stream()["failed"], nullptr) << "who stops it knows";
  EXPECT_EQ(say("It speaks again.").status, 202);
}

TEST_F(LiveSpeech, Joints_AreHeardAsInTheWhole) {
  const std::string text = first + "[joy]Another one that is just as long, and glad.[/joy] And the last of the three.";
  const auto whole = json_of(ask("POST", "/v1/speeches", json{{"text", text}, {"language", "en"}}.dump()));
  follow();
  say_as_a_whole(text, 3, whole["duration"].get<double>());
  for (const double gap : heard_.gaps()) EXPECT_GE(gap, 0.0) << "no packet begins before the one before it ends";
  EXPECT_TRUE(heard_.one_clock()) << "through the joints";
}

TEST_F(LiveSpeech, LateSentence_IsWaitedFor_AndWhole) {
  // The first part is long to read and short to say.
  ASSERT_EQ(say("Oh - - - - - - - - - - - - - - - - - - - - - -. Here is the late one.").status, 202);
  EXPECT_EQ(say("Soon.").status, 409);
  listen_to_the_end();
  EXPECT_TRUE(heard_.one_clock()) << "the face goes on";
  const auto gaps = heard_.gaps();
  ASSERT_GE(gaps.size(), 1U);
  EXPECT_GT(*std::max_element(gaps.begin(), gaps.end()), 1000.0) << "the voice was late";
  EXPECT_GT(heard_.packets_ms(), 10 * 90.0);
}

TEST_F(LiveSpeech, ClientWithAVoice_GetsTheSentencesOfEachPart_AtTheTimesOfTheirSound) {
  WebSocket reader(server_->port(), "/v1/streams/talk", "semblante.v1.json");
  reader.send_text(R"({"type":"hello","version":1,"text":true})");
  ASSERT_TRUE(reader.receive());
  const std::string short_to_say = "Oh - - - - - - - - - - - - - - - - - - - - - -.";
  ASSERT_EQ(say(short_to_say + " Here is the late one.").status, 202);
  listen_to_the_end();
  std::vector<SpeechText> texts;
  while (const auto text = reader.receive()) {
    const auto message = decode_json(*text);
    ASSERT_TRUE(message) << *text;
    if (const auto* one = std::get_if<SpeechText>(&*message)) texts.push_back(*one);
    if (std::holds_alternative<End>(*message)) break;
  }
  ASSERT_EQ(texts.size(), 2U);
  EXPECT_EQ(texts[0].text, short_to_say);
  EXPECT_EQ(texts[1].text, "Here is the late one.");
  // The second part is late: it begins after the longest gap.
  auto begin = heard_.sound.begin();
  std::uint64_t longest = 0;
  for (auto at = begin + 1; at != heard_.sound.end(); ++at) {
    const auto gap = at->media_time - std::prev(at)->media_time;
    if (gap > longest) begin = at;
    longest = std::max(longest, gap);
  }
  const auto after = [](const SpeechText& text, const SoundPacket& packet) {
    return static_cast<double>(text.media_time) - static_cast<double>(packet.media_time);
  };
  EXPECT_NEAR(after(texts[0], heard_.sound.front()), 120.0, 80.0) << "the silence before the first word";
  EXPECT_NEAR(after(texts[1], *begin), 0.0, 80.0);
}

TEST_F(LiveSpeech, SentenceThatFails_EndsThePlay_AndIsSaid) {
  const auto answer = say(first + "But this one is broken, and will not be heard. " + first);
  ASSERT_EQ(answer.status, 202);
  const auto duration = json_of(answer)["duration"].get<double>();
  wait_until_it_is_silent();
  EXPECT_TRUE(testing::eventually([&] { return !stream()["failed"].is_null(); }));
  const auto failed = stream()["failed"];
  EXPECT_EQ(failed["id"], json_of(answer)["id"]);
  EXPECT_THAT(failed["failure"].get<std::string>(), HasSubstr("the string is torn"));
  EXPECT_EQ(failed["duration"], duration);
  EXPECT_EQ(json_of(ask("GET", answer.headers.at("location"))), failed);
  EXPECT_EQ(say("[joy]" + std::string("broken[/joy]")).status, 502) << "of the first part at once";
  ASSERT_EQ(say("It is whole.").status, 202);
  EXPECT_EQ(stream()["failed"], nullptr);
  EXPECT_EQ(ask("GET", answer.headers.at("location")).status, 404);
}

TEST_F(LiveSpeech, Replaced_InTheMiddle_TheOtherIsHeard) {
  ASSERT_EQ(say(first + "This one is never there.").status, 202);
  listen([&] { return heard_.sound_ms() > 500.0; });
  const auto answer = say(first + "And more of it.", true);
  ASSERT_EQ(answer.status, 202) << answer.body;
  EXPECT_TRUE(testing::eventually([&] { return voices_of(server_->pid()) == 0; }));
  EXPECT_TRUE(testing::eventually([&] { return stream()["playing"].value("complete", true); }));
  EXPECT_EQ(stream()["playing"]["id"], json_of(answer)["id"]);
  const auto before = heard_.sound_ms();
  listen_to_the_end();
  EXPECT_GT(heard_.sound_ms(), before + 3000.0);
}

TEST_F(LiveSpeech, Recording_SaysWhetherItHasSound) {
  const auto record = [&] {
    return json_of(ask("POST", "/v1/streams/talk/recordings"))["links"]["self"].get<std::string>();
  };
  const auto spoken = record();
  ASSERT_EQ(say("Mamma mia!").status, 202);
  listen([&] { return heard_.sound_ms() > 500.0; });
  EXPECT_EQ(json_of(ask("POST", spoken + "/stop"))["sound"], true);
  wait_until_it_is_silent();
  const auto silent = record();
  ASSERT_EQ(
      ask("POST", "/v1/streams/talk/frames", R"({"frames":[{"expression":{"select1":1,"intensity1":40}}]})").status,
      202);
  EXPECT_EQ(json_of(ask("POST", silent + "/stop"))["sound"], false);
  EXPECT_EQ(ask("GET", spoken + "/content?format=opus").status, 200);
  EXPECT_EQ(ask("GET", silent + "/content?format=opus").status, 409);

  server_->end(SIGKILL);
  server_ = std::make_unique<ServerProcess>(folder_.path() / "data");
  EXPECT_EQ(json_of(ask("GET", spoken))["sound"], true);
  const auto all = json_of(ask("GET", "/v1/recordings"))["recordings"];
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0]["sound"], true);
  EXPECT_EQ(all[1]["sound"], false);
}

TEST_F(LiveSpeech, Stop_OfTheServer_DoesNotWaitForAVoice) {
  ASSERT_EQ(say(first + "This one is never there.").status, 202);
  EXPECT_EQ(server_->end(SIGTERM), 0);
}

TEST_F(LiveSpeech, StoredSpeech_BeginsBeforeItsSoundIsCoded) {
  std::string text;
  for (int i = 0; i < 200; ++i) text += "Mamma mia! ";
  const auto stored = json_of(ask("POST", "/v1/speeches", json{{"text", text}, {"language", "en"}}.dump()));
  follow();
  const auto answer = ask("POST", "/v1/streams/talk/speech", json{{"speech", stored["id"]}}.dump());
  ASSERT_EQ(answer.status, 202) << answer.body;
  EXPECT_EQ(json_of(answer)["duration"], stored["duration"]) << "the face is whole";
  EXPECT_EQ(json_of(answer)["complete"], false) << "200 s of sound take a second or two to code";
  listen([&] { return heard_.sound_ms() > 4000.0; });
}

#ifdef SEMBLANTE_VOICE_ESPEAK
class LiveSpeechOfEspeak : public LiveSpeech {
 protected:
  LiveSpeechOfEspeak() : LiveSpeech(SEMBLANTE_VOICE_ESPEAK) {}
};

TEST_F(LiveSpeechOfEspeak, IsHeardBeforeTheWholeIsMade_AndEndsWhenItIsStopped) {
  std::string text;
  for (int i = 0; i < 150; ++i) text += "A sentence that is said while the next one is being made. ";
  const auto answer = say(text);
  ASSERT_EQ(answer.status, 202) << answer.body;
  listen([&] { return !heard_.sound.empty(); });
  EXPECT_EQ(stream()["playing"]["complete"], false) << "eight minutes of sound take seconds to code";
  listen([&] { return heard_.sound_ms() > 1000.0; });
  const auto playback = answer.headers.at("location");
  ASSERT_EQ(ask("DELETE", playback).status, 204);
  const auto now = heard_.sound.back().media_time;
  EXPECT_EQ(ask("GET", playback).status, 404);
  listen_to_the_end();
  EXPECT_LT(heard_.sound.back().media_time - now, 30'000U) << "of minutes";
}

TEST_F(LiveSpeechOfEspeak, PartsJoin_WithoutGapOrOverlap_AsInTheWhole) {
  const std::string text =
      "The first sentence of four is said while the second is made. Papa bought a blue piano for the baby's room. The "
      "third one is here to be joined on both of its sides, too. And this is the last of them.";
  const auto stored = json_of(ask("POST", "/v1/speeches", json{{"text", text}, {"language", "en"}}.dump()));
  ASSERT_EQ(ask("POST", "/v1/streams", R"({"name":"whole","batch_interval":0})").status, 201);
  WebSocket other(server_->port(), "/v1/streams/whole", "semblante.v1.json");
  other.send_text(R"({"type":"hello","version":1,"sound":true})");
  ASSERT_TRUE(other.receive());
  ASSERT_EQ(ask("POST", "/v1/streams/whole/speech", json{{"speech", stored["id"]}}.dump()).status, 202);
  say_as_a_whole(text, 4, stored["duration"].get<double>());
  const Heard parts = std::exchange(heard_, {});
  listener_ = nullptr;
  EXPECT_TRUE(testing::eventually([&] { return json_of(ask("GET", "/v1/streams/whole"))["playing"].is_null(); }));
  ASSERT_EQ(ask("DELETE", "/v1/streams/whole").status, 204);
  listen_to(other, [] { return false; });
  for (const double gap : parts.gaps()) EXPECT_GE(gap, 0.0) << "an overlap";
  // A part ends with a shorter packet, so durations are compared, not numbers of packets.
  EXPECT_NEAR(parts.packets_ms(), heard_.packets_ms(), 4 * 60.0);
  EXPECT_NEAR(parts.sound_ms(), heard_.sound_ms(), 4 * 20.0);
  EXPECT_TRUE(parts.one_clock());
}

TEST_F(LiveSpeechOfEspeak, ReaderWhoReadsNothing_LearnsAfterwardsThatTheSpeechWasStopped) {
  WebSocket reader(server_->port(), "/v1/streams/talk", "semblante.v1.json", {}, 4096);
  reader.send_text(R"({"type":"hello","version":1,"text":true})");
  ASSERT_TRUE(reader.receive());
  const auto answer = say(first + first + first);
  ASSERT_EQ(answer.status, 202) << answer.body;
  listen([&] { return heard_.sound_ms() > 500.0; });
  ASSERT_EQ(ask("DELETE", answer.headers.at("location")).status, 204);
  ASSERT_EQ(ask("DELETE", "/v1/streams/talk").status, 204);
  std::vector<SpeechText> texts;
  bool shown = false;  // frames after the last text
  while (const auto text = reader.receive()) {
    const auto message = decode_json(*text);
    ASSERT_TRUE(message) << *text;
    if (const auto* one = std::get_if<SpeechText>(&*message)) {
      texts.push_back(*one);
      shown = false;
    }
    shown = shown || std::holds_alternative<Keyframe>(*message);
    if (std::holds_alternative<End>(*message)) break;
  }
  ASSERT_GE(texts.size(), 2U);
  EXPECT_EQ(texts.front().text, first.substr(0, first.size() - 1));
  EXPECT_EQ(texts.back().text, "");
  EXPECT_TRUE(shown);
}
#endif

}  // namespace
}  // namespace semblante::test
