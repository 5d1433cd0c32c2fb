#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gmock/gmock.h>

#include "tests/unit/runtime/scripted_server.h"

/// Text for a client with a voice of its own, as libsemblante hands it out, and the face that follows the voice.
namespace semblante::testing {
namespace {

using ::testing::ElementsAre;
using Bytes = std::vector<std::uint8_t>;

/// "Am pe": a (120 ms) m (60), p (60) e (120).
const Bytes score = {0xab, 0x11, 0x19, 0xb3};
const SpeechText text = {3, 5500, "en", "Am pe", score};

semblante_stream_options reading() {
  auto options = ScriptedServer::usual();
  options.text = 1;
  return options;
}

semblante_event next_event(semblante_stream* stream) {
  semblante_event event{};
  event.size = sizeof(event);
  semblante_stream_next_event(stream, &event);
  return event;
}

TEST(Text, Hello_AsksForIt_IfASubscriberWishes) {
  for (const std::uint32_t role : {SEMBLANTE_ROLE_SUBSCRIBE, SEMBLANTE_ROLE_PUBLISH}) {
    for (const std::uint32_t wished : {0U, 1U}) {
      auto options = ScriptedServer::usual();
      options.role = role;
      options.text = wished;
      ScriptedServer server(options);
      semblante_stream_start(server.stream, 1000);
      EXPECT_EQ(server.open(1000).text, wished == 1 && role == SEMBLANTE_ROLE_SUBSCRIBE);
    }
  }
}

TEST(Text, Captions_AreAskedForByHelloAndChangedLater) {
  auto options = ScriptedServer::usual();
  options.captions = 1;
  ScriptedServer server(options);
  semblante_stream_start(server.stream, 1000);
  const auto hello = server.open(1000);
  EXPECT_TRUE(hello.captions);
  EXPECT_FALSE(hello.text);
  server.greet(ScriptedServer::header(7, 5000), {10, 5000, face(0)}, 1000);
  server.events();
  server.say(text, 1010);
  EXPECT_EQ(next_event(server.stream).type, static_cast<std::uint32_t>(SEMBLANTE_EVENT_TEXT));
  server.sent();
  EXPECT_EQ(semblante_stream_set_captions(server.stream, 0), SEMBLANTE_OK);
  EXPECT_EQ(semblante_stream_set_captions(server.stream, 0), SEMBLANTE_OK);
  const auto sent = server.sent();
  ASSERT_EQ(sent.size(), 1U) << "once";
  EXPECT_FALSE(std::get<CaptionsWish>(sent[0]).on);
  server.say(text, 1020);
  EXPECT_TRUE(server.events().empty()) << "the server had sent it before it knew";
  semblante_stream_closed(server.stream, 0, 1100);
  EXPECT_EQ(semblante_stream_set_captions(server.stream, 1), SEMBLANTE_OK);
  semblante_stream_start(server.stream, 1200);
  EXPECT_TRUE(server.open(1200).captions);
}

TEST(Text, WishesBetweenHelloAndHeader_AreToldAfterTheHeader) {
  ScriptedServer server;
  semblante_stream_start(server.stream, 1000);
  const auto hello = server.open(1000);
  EXPECT_FALSE(hello.captions);
  EXPECT_FALSE(hello.text);
  EXPECT_EQ(semblante_stream_set_captions(server.stream, 1), SEMBLANTE_OK);
  EXPECT_EQ(semblante_stream_spoken(server.stream, SEMBLANTE_VOICE_READY, 0, 0, 1005), SEMBLANTE_UNAVAILABLE);
  EXPECT_TRUE(server.sent().empty());
  server.greet(ScriptedServer::header(7, 5000), {10, 5000, face(0)}, 1010);
  std::vector<bool> captions;
  std::vector<VoiceState> voice;
  for (const auto& message : server.sent()) {
    if (const auto* wish = std::get_if<CaptionsWish>(&message)) captions.push_back(wish->on);
    if (const auto* spoken = std::get_if<Spoken>(&message)) voice.push_back(spoken->state);
  }
  EXPECT_THAT(captions, ElementsAre(true));
  EXPECT_THAT(voice, ElementsAre(VoiceState::ready));

  // What was wished and taken back is not told, nor what the next hello says.
  semblante_stream_closed(server.stream, 0, 1100);
  semblante_stream_start(server.stream, 1200);
  EXPECT_TRUE(server.open(1200).captions);
  EXPECT_EQ(semblante_stream_set_captions(server.stream, 0), SEMBLANTE_OK);
  EXPECT_EQ(semblante_stream_set_captions(server.stream, 1), SEMBLANTE_OK);
  server.greet(ScriptedServer::header(7, 5200), {20, 5200, face(0)}, 1210);
  for (const auto& message : server.sent()) EXPECT_TRUE(std::holds_alternative<Ping>(message));
}

TEST(Text, CaptionsOfAPublisher_AreRefused) {
  auto options = ScriptedServer::usual();
  options.role = SEMBLANTE_ROLE_PUBLISH;
  options.captions = 1;
  ScriptedServer server(options);
  semblante_stream_start(server.stream, 1000);
  EXPECT_FALSE(server.open(1000).captions);
  EXPECT_EQ(semblante_stream_set_captions(server.stream, 1), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_stream_set_captions(nullptr, 1), SEMBLANTE_INVALID_ARGUMENT);
}

TEST(Text, WordsOfAScore_HaveTheirTimes) {
  std::uint32_t count = 0;
  EXPECT_EQ(semblante_score_words(score.data(), 4, nullptr, &count), SEMBLANTE_OK);
  EXPECT_EQ(count, 2U);
  std::array<double, 2> times{};
  EXPECT_EQ(semblante_score_words(score.data(), 4, times.data(), &count), SEMBLANTE_OK);
  EXPECT_THAT(times, ElementsAre(0, 180));
  count = 1;
  EXPECT_EQ(semblante_score_words(score.data(), 4, times.data(), &count), SEMBLANTE_BUFFER_TOO_SMALL);
  EXPECT_EQ(count, 2U);
  const Bytes none = {0xf7};
  EXPECT_EQ(semblante_score_words(none.data(), 1, nullptr, &count), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_score_words(nullptr, 1, nullptr, &count), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_score_words(score.data(), 4, nullptr, nullptr), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_score_words(nullptr, 0, nullptr, &count), SEMBLANTE_OK);
  EXPECT_EQ(count, 0U);
}

TEST(Text, Sentence_IsAnEventWithAllOfIt) {
  ScriptedServer server(reading());
  server.begin(1000);
  server.say(text, 1010);
  const auto event = next_event(server.stream);
  EXPECT_EQ(event.type, static_cast<std::uint32_t>(SEMBLANTE_EVENT_TEXT));
  EXPECT_EQ(event.sequence, 3U);
  EXPECT_EQ(event.media_time, 5500);
  EXPECT_EQ(event.duration, 360);
  EXPECT_STREQ(event.text, "Am pe");
  EXPECT_STREQ(event.language, "en");
  EXPECT_EQ(Bytes(event.packet, event.packet + event.packet_size), score);
}

TEST(Text, NotAskedFor_IsNotTold) {
  ScriptedServer server;
  server.begin(1000);
  server.say(text, 1010);
  EXPECT_TRUE(server.events().empty());
}

TEST(Text, BytesThatAreNoText_AreAFault) {
  ScriptedServer server(reading());
  server.begin(1000);
  server.say_bytes({11, 1, 0, 0, 1, 'a', 1, 0xf7}, 1010);
  EXPECT_THAT(server.types(), ElementsAre(SEMBLANTE_EVENT_FAULT, SEMBLANTE_EVENT_CLOSE, SEMBLANTE_EVENT_STATE));
}

TEST(Text, Boundary_IsSentWithTheStreamsTime) {
  ScriptedServer server(reading());
  server.begin(1000, 5000);
  ASSERT_EQ(semblante_stream_spoken(server.stream, SEMBLANTE_VOICE_REACHED, 3, 3, 1250), SEMBLANTE_OK);
  const auto sent = server.sent();
  ASSERT_EQ(sent.size(), 1U);
  const auto& spoken = std::get<Spoken>(sent[0]);
  EXPECT_EQ(spoken.state, VoiceState::reached);
  EXPECT_EQ(spoken.speech, 3U);
  EXPECT_EQ(spoken.character, 3U);
  EXPECT_EQ(spoken.media_time, 5250U);
}

TEST(Text, VoiceThatFailedOrIsReady_IsSoInTheNextHello) {
  ScriptedServer server(reading());
  server.begin(1000);
  semblante_stream_spoken(server.stream, SEMBLANTE_VOICE_FAILED, 0, 0, 1010);
  server.say(text, 1020);
  EXPECT_TRUE(server.events().empty()) << "the server had sent it before it knew";
  semblante_stream_closed(server.stream, 0, 1100);
  semblante_stream_start(server.stream, 1200);
  EXPECT_FALSE(server.open(1200).text);
  EXPECT_EQ(semblante_stream_spoken(server.stream, SEMBLANTE_VOICE_READY, 0, 0, 1210), SEMBLANTE_UNAVAILABLE);
  semblante_stream_closed(server.stream, 0, 1300);
  semblante_stream_start(server.stream, 1400);
  EXPECT_TRUE(server.open(1400).text);
}

TEST(Text, SpokenOfNonsense_IsRefused) {
  ScriptedServer server(reading());
  server.begin(1000);
  EXPECT_EQ(semblante_stream_spoken(nullptr, 0, 0, 0, 1000), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_stream_spoken(server.stream, 4, 0, 0, 1000), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_stream_spoken(server.stream, 0, 0, 2001, 1000), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_stream_spoken(server.stream, 0, UINT64_MAX, 0, 1000), SEMBLANTE_INVALID_ARGUMENT);
  auto options = ScriptedServer::usual();
  options.role = SEMBLANTE_ROLE_PUBLISH;
  ScriptedServer publisher(options);
  publisher.begin(1000);
  EXPECT_EQ(semblante_stream_spoken(publisher.stream, 0, 0, 0, 1000), SEMBLANTE_INVALID_ARGUMENT);
}

class SpeakerTest : public ::testing::Test {
 protected:
  SpeakerTest() { EXPECT_EQ(semblante_speaker_create(1, &speaker_, nullptr), SEMBLANTE_OK); }
  ~SpeakerTest() override { semblante_speaker_destroy(speaker_); }
  void say(const Bytes& bytes, double now, std::uint32_t first = 0) {
    EXPECT_EQ(semblante_speaker_say(speaker_, bytes.data(), bytes.size(), first, now), SEMBLANTE_OK);
  }
  /// The viseme with the greater share at a time; -1: nothing is shown.
  int viseme(double now) {
    frame_ = {};
    if (semblante_speaker_show(speaker_, now, &frame_) == 0) return -1;
    return frame_.viseme_blend >= 32 ? frame_.viseme1 : frame_.viseme2;
  }

  semblante_speaker* speaker_ = nullptr;
  semblante_frame frame_{};
};

TEST_F(SpeakerTest, NothingSaid_ShowsNothing) {
  frame_.viseme1 = 9;
  EXPECT_EQ(semblante_speaker_show(speaker_, 1000, &frame_), 0U);
  EXPECT_EQ(frame_.viseme1, 9);
}

TEST_F(SpeakerTest, VoiceWithoutBoundaries_IsFollowedByTheScore) {
  say(score, 1000);
  EXPECT_EQ(viseme(1060), 10);
  EXPECT_EQ(viseme(1150), 1);
  EXPECT_EQ(viseme(1210), 1);
  EXPECT_EQ(viseme(1300), 11);
  EXPECT_EQ(viseme(1500), 0);
  semblante_speaker_end(speaker_, 1510);
  EXPECT_EQ(viseme(1800), -1) << "at rest";
}

TEST_F(SpeakerTest, Lips_AreClosedForTheWholeOfTheirSound) {
  say(score, 1000);
  for (double ms = 1120; ms < 1240; ms += 5) {
    EXPECT_EQ(viseme(ms), 1) << ms;
    EXPECT_TRUE(frame_.viseme1 == 1 ? frame_.viseme_blend == 63 || frame_.viseme2 == 1 : frame_.viseme_blend == 0)
        << ms;
  }
}

TEST_F(SpeakerTest, SlowVoice_IsWaitedForAtTheEndOfTheWord) {
  say(score, 1000);
  semblante_speaker_reach(speaker_, 0, 1000);
  viseme(1170);
  EXPECT_EQ(viseme(1400), 1) << "the second word has not begun";
  semblante_speaker_reach(speaker_, 1, 1500);
  viseme(1550);
  EXPECT_EQ(viseme(1650), 11);
}

TEST_F(SpeakerTest, FastVoice_IsCaughtUpWith) {
  const Bytes slow = {0xaf, 0x07, 0x07, 0xbf, 0x37};  // the second word at 720 ms
  say(slow, 1000);
  semblante_speaker_reach(speaker_, 0, 1000);
  semblante_speaker_reach(speaker_, 1, 1200);
  EXPECT_NE(viseme(1210), 11);
  EXPECT_EQ(viseme(1340), 11);
}

TEST_F(SpeakerTest, VoiceThatTellsOnlySomeWords_DoesNotFreezeTheFace) {
  say(score, 1000);
  semblante_speaker_reach(speaker_, 0, 1000);
  for (double ms = 1000; ms < 1690; ms += 10) viseme(ms);
  EXPECT_EQ(viseme(1700), 11);
}

TEST_F(SpeakerTest, VoiceThatStops_LetsTheMouthRest) {
  say(score, 1000);
  ASSERT_EQ(viseme(1060), 10);
  semblante_speaker_end(speaker_, 1060);
  EXPECT_EQ(viseme(1080), 10) << "no jump";
  EXPECT_EQ(viseme(1200), 0);
  EXPECT_EQ(viseme(1400), -1);
}

TEST_F(SpeakerTest, LateJoin_BeginsAtItsWord) {
  say(score, 1000, 1);
  EXPECT_EQ(viseme(1010), 1);
  EXPECT_EQ(viseme(1120), 11);
}

TEST_F(SpeakerTest, Expression_ComesStaysAndGoesWithoutJumps) {
  say({0xf1, 42, 0xaf, 0x2f, 0x2f, 0xf0, 0x2f, 0x2f, 0x2f}, 1000);
  int before = 0, most = 0;
  for (double ms = 1000; ms < 3000; ms += 20) {
    viseme(ms);
    const int now = frame_.expression1 == 1 ? frame_.intensity1 : 0;
    EXPECT_LE(std::abs(now - before), 5) << ms;
    most = std::max(most, now);
    before = now;
  }
  EXPECT_EQ(most, 42);
  EXPECT_EQ(before, 0);
}

TEST_F(SpeakerTest, Frame_KeepsWhatIsNotSpeech) {
  say(score, 1000);
  semblante_frame frame{};
  frame.fap[12] = 50;
  ASSERT_EQ(semblante_speaker_show(speaker_, 1060, &frame), 1U);
  EXPECT_EQ(frame.fap[12], 50);
}

/// Two phrases of 2 s, each of words with a short vowel and one with a long one, and 400 ms of silence between them.
Bytes two_phrases(bool joyful) {
  Bytes bytes;
  if (joyful) bytes = {0xF1, 63};
  for (int phrase = 0; phrase < 2; ++phrase) {
    for (int word = 0; word < 7; ++word)
      for (const std::uint8_t byte : {0x49, word == 5 ? 0xA7 : 0xA2, 0x42}) bytes.push_back(byte);
    for (int i = 0; i < 2 && phrase == 0; ++i) bytes.push_back(0x06);
  }
  return bytes;
}

/// The most that each FAP differs from 0 while a speaker says a score, and whether it moves smoothly and comes to rest.
std::array<float, 69> most_of_life(std::uint32_t seed, const Bytes& bytes, std::vector<float>* heads = nullptr) {
  std::array<float, 69> most{};
  semblante_speaker* speaker = nullptr;
  EXPECT_EQ(semblante_speaker_create(seed, &speaker, nullptr), SEMBLANTE_OK);
  EXPECT_EQ(semblante_speaker_say(speaker, bytes.data(), bytes.size(), 0, 1000), SEMBLANTE_OK);
  float head = 0, eyes = 0;
  bool shown = true;
  for (double ms = 1000; shown && ms < 9000; ms += 10) {
    if (ms == 6000) semblante_speaker_end(speaker, ms);
    semblante_frame frame{};
    shown = semblante_speaker_show(speaker, ms, &frame) != 0;
    for (std::size_t fap = 1; fap < most.size(); ++fap) most[fap] = std::max(most[fap], std::abs(frame.fap[fap]));
    EXPECT_LT(std::abs(frame.fap[48] - head), 600) << "a third of a degree in 10 ms, at " << ms;
    EXPECT_LT(std::abs(frame.fap[23] - eyes), 3000) << ms;
    head = frame.fap[48];
    eyes = frame.fap[23];
    if (heads != nullptr) heads->push_back(head);
  }
  EXPECT_FALSE(shown) << "it comes to rest";
  semblante_speaker_destroy(speaker);
  return most;
}

TEST_F(SpeakerTest, Face_NodsRaisesItsBrowsLooksAsideAndBlinks_WithoutABitOfIt) {
  std::vector<float> heads, again, others;
  const auto most = most_of_life(1, two_phrases(false), &heads);
  EXPECT_GT(most[48], 3000) << "a nod of two degrees";
  EXPECT_LT(most[48], 7000);
  for (std::size_t fap = 31; fap <= 36; ++fap) EXPECT_GT(most[fap], 50) << fap;
  EXPECT_GT(most[23], 5000) << "a glance of four degrees";
  EXPECT_EQ(most[23], most[24]);
  EXPECT_GT(most[19], 900) << "a blink between phrases";
  EXPECT_EQ(most[3], 0) << "the mouth is that of the score";
  most_of_life(1, two_phrases(false), &again);
  most_of_life(2, two_phrases(false), &others);
  EXPECT_EQ(heads, again);
  EXPECT_NE(heads, others);
  EXPECT_LT(most_of_life(1, two_phrases(true))[31], 20) << "an expression has the brows";
}

TEST_F(SpeakerTest, Eyes_Blink) {
  float most = 0;
  for (double ms = 1000; ms < 30'000; ms += 20) {
    if (static_cast<int>(ms) % 400 == 200) say(score, ms);
    viseme(ms);
    most = std::max(most, frame_.fap[19]);
  }
  EXPECT_GT(most, 900);
}

TEST_F(SpeakerTest, Nonsense_IsRefused) {
  const Bytes none = {0xf7};
  EXPECT_EQ(semblante_speaker_say(speaker_, none.data(), none.size(), 0, 0), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_speaker_say(speaker_, nullptr, 3, 0, 0), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_speaker_say(nullptr, score.data(), score.size(), 0, 0), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_speaker_say(speaker_, score.data(), score.size(), 0, NAN), SEMBLANTE_INVALID_ARGUMENT);
  say(score, 1000, 4'000'000'000U);
  semblante_speaker_reach(speaker_, 4'000'000'000U, 1010);
  semblante_speaker_reach(speaker_, 1, 500);  // before it began
  frame_.fap[3] = NAN;
  EXPECT_EQ(semblante_speaker_show(speaker_, 1020, &frame_), 0U);
  say({}, 1100);
  viseme(1110);
}

}  // namespace
}  // namespace semblante::testing
