// Requests to voices and their answers: both sides are strangers to each other.
#include "server/voice/voice_protocol.h"

#include <limits>

#include <gtest/gtest.h>

#include "core/json/base64.h"

namespace semblante::voice {
namespace {

VoiceRequest request(std::string text) { return {.text = std::move(text), .language = "pt-BR", .voice = ""}; }

TEST(VoiceRequest, GoesThroughJson) {
  auto sent = request("Olá \"mundo\"\n😀");
  sent.rate = 1.25;
  sent.pitch = 0.75;
  sent.voice = "pt-br+f3";
  const auto got = request_from_json(to_json(sent));
  ASSERT_TRUE(got.ok()) << got.error().where << got.error().message;
  EXPECT_EQ(got->text, sent.text);
  EXPECT_EQ(got->voice, sent.voice);
  EXPECT_EQ(got->rate, 1.25);
  EXPECT_EQ(got->pitch, 0.75);
  EXPECT_TRUE(request_from_json(to_json(request(std::string(max_text_bytes, '"')))).ok());
}

TEST(VoiceRequest, HostileTexts_AreRefused) {
  EXPECT_EQ(check(request("")).error().code, ErrorCode::empty);
  EXPECT_EQ(check(request(std::string(max_text_bytes + 1, 'a'))).error().code, ErrorCode::too_large);
  for (const char* const text : {"a\x01", "a\x7F", "\xC2\x85", "\xFF", "\xED\xA0\x80", "a\r"})
    EXPECT_EQ(check(request(text)).error().code, ErrorCode::malformed) << text;
  EXPECT_EQ(check(request(std::string("a\0b", 3))).error().code, ErrorCode::malformed);
  for (const char* const name : {"../../etc/passwd", "a/b", "a.b", "a b"}) {
    auto wrong = request("a");
    wrong.voice = name;
    EXPECT_FALSE(check(wrong).ok()) << name;
    wrong = request("a");
    wrong.language = name;
    EXPECT_FALSE(check(wrong).ok()) << name;
  }
  for (const double factor : {0.49, 2.01, std::numeric_limits<double>::quiet_NaN()}) {
    auto wrong = request("a");
    wrong.rate = factor;
    EXPECT_FALSE(check(wrong).ok()) << factor;
  }
}

TEST(VoiceRequest, Ssml_HasNoDeclarationsFilesOrDepth) {
  const auto ssml = [](std::string text) {
    auto made = request(std::move(text));
    made.ssml = true;
    return check(made).ok();
  };
  EXPECT_TRUE(ssml("<speak>a <break time=\"1s\"/> <prosody rate=\"slow\">b</prosody><!-- c --></speak>"));
  std::string deep;
  for (int i = 0; i < 20; ++i) deep += "<p>";
  for (int i = 0; i < 20; ++i) deep += "</p>";
  for (const auto& text : {std::string("<!DOCTYPE a [<!ENTITY b \"bb\">]><speak>&b;</speak>"), std::string("<?xml?>a"),
                           std::string("<audio src=\"/etc/passwd\"/>"), std::string("<voice name=\"x\">a</voice>"),
                           deep, std::string("<speak>a"), std::string("a</speak>"), std::string("a <b")})
    EXPECT_FALSE(ssml(text)) << text;
}

const std::string header = header_line("test", 8000);

Result<Utterance> answer(const std::vector<std::string>& lines) {
  VoiceAnswer reader;
  for (std::string line : lines) {
    if (line.ends_with('\n')) line.pop_back();
    if (const auto taken = reader.take(line); !taken) return taken.error();
  }
  return std::move(reader).finish();
}

TEST(VoiceAnswer, IsReadAsItWasWritten) {
  const std::vector<std::int16_t> sound = {0, -1, 32767, -32768, 5};
  const auto got = answer({header, line_of(SpokenSentence{0, 0}), line_of(SpokenWord{0, {2, 3}}),
                           line_of(SpokenPhoneme{0.5, "ɐ̃ʊ̃", Stress::secondary}), audio_line(sound),
                           line_of(SpokenMark{0.5, "x"}), "{\"later\":[1],\"time\":1}", end_line()});
  ASSERT_TRUE(got.ok()) << got.error().message;
  EXPECT_EQ(got->samples, sound);
  EXPECT_EQ(got->phonemes[0].symbol, "ɐ̃ʊ̃");
  EXPECT_EQ(got->phonemes[0].stress, Stress::secondary);
  EXPECT_EQ(got->words[0].range, (TextRange{2, 3}));
  EXPECT_EQ(got->marks[0].name, "x");
  EXPECT_DOUBLE_EQ(got->duration, 5.0 / 8.0);
}

TEST(VoiceAnswer, HostileLines_AreErrors) {
  const std::string sound = audio_line(std::vector<std::int16_t>(100));
  const std::string end = end_line();
  for (const std::vector<std::string>& lines : std::vector<std::vector<std::string>>{
           {},
           {header},
           {header, end},              // no sound
           {header, sound},            // no end
           {header, sound, end, end},  // goes on
           {sound, end},               // no header
           {header_line("x", 0), sound, end},
           {header_line("x", 4'000'000), sound, end},
           {"{\"protocol\":2,\"name\":\"x\",\"sample_rate\":8000}", sound, end},
           {header, "{\"audio\":\"A\"}", end},
           {header, "{\"audio\":\"AAAA\"}", end},  // three bytes
           {header, "{\"audio\":7}", end},
           {header, sound, "{\"phoneme\":\"a\",\"time\":-1}", end},
           {header, sound, "{\"phoneme\":\"a\",\"time\":1e300}", end},
           {header, sound, "{\"phoneme\":\"a\"}", end},
           {header, sound, "{\"phoneme\":\"a\",\"time\":1,\"stress\":3}", end},
           {header, sound, "{\"phoneme\":\"" + std::string(33, 'a') + "\",\"time\":1}", end},
           {header, sound, "{\"word\":[1],\"time\":1}", end},
           {header, sound, "{\"word\":[1,-5],\"time\":1}", end},
           {header, sound, line_of(SpokenPhoneme{5, "a"}), line_of(SpokenPhoneme{4, "a"}), end},
           {header, sound, line_of(SpokenPhoneme{90000, "a"}), end},  // after the sound
           {header, "[[[[[[[[", end},
           {header, std::string(max_line_bytes + 1, ' '), end},
           {header, "\xFF", end}}) {
    EXPECT_FALSE(answer(lines).ok()) << (lines.size() > 1 ? lines[1].substr(0, 80) : "");
  }
  const auto faulty = answer({error_line("out of breath")}).error();
  EXPECT_EQ(faulty.message, "out of breath");
  EXPECT_EQ(faulty.code, ErrorCode::invalid_argument);
  const auto unknown = answer({error_line("no such voice", "voice")}).error();
  EXPECT_EQ(unknown.code, ErrorCode::unsupported);
  EXPECT_EQ(unknown.where, "voice");
  EXPECT_EQ(answer({R"({"error":"no","of":"server"})"}).error().code, ErrorCode::invalid_argument);
}

TEST(VoiceAnswer, SoundAndEvents_AreBounded) {
  VoiceAnswer reader;
  ASSERT_TRUE(reader.take(header).ok());
  const std::string second = audio_line(std::vector<std::int16_t>(8000));
  Status taken = Unit{};
  for (int i = 0; i < 1300 && taken; ++i) taken = reader.take(second);
  ASSERT_FALSE(taken.ok());
  EXPECT_EQ(taken.error().code, ErrorCode::too_large);
  VoiceAnswer talker;
  ASSERT_TRUE(talker.take(header).ok());
  taken = Unit{};
  const std::string event = "{\"later\":1,\"time\":0}";
  for (std::size_t i = 0; i <= max_events && taken; ++i) taken = talker.take(event);
  ASSERT_FALSE(taken.ok());
}

TEST(Base64, RefusesWhatItDoesNotWrite) {
  for (std::size_t size = 0; size < 5; ++size) {
    const std::vector<std::uint8_t> bytes(size, 0xFB);
    EXPECT_EQ(from_base64(to_base64(bytes)), bytes);
  }
  for (const char* const text : {"A", "AB", "ABC", "A===", "AB=C", "ABC!", "AB==AAAA", "AC==", "====", "ABD="})
    EXPECT_FALSE(from_base64(text).has_value()) << text;
}

}  // namespace
}  // namespace semblante::voice
