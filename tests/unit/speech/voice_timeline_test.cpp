// Timelines of other voices come in as their makers document them.
#include "core/speech/voice_timeline.h"

#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/speech/sounds.h"
#include "core/speech/speech.h"
#include "core/speech/timelines/viseme_symbols.h"

namespace semblante {
namespace {

using ::testing::HasSubstr;

constexpr const char* azure_json = R"([
  {"audioOffset": 500000, "visemeId": 0},
  {"audioOffset": 500000, "text": "My", "textOffset": 0, "wordLength": 2, "boundaryType": "WordBoundary"},
  {"audioOffset": 1000000, "visemeId": 21},
  {"audioOffset": 2000000, "visemeId": 11},
  {"audioOffset": 3250000, "text": "!", "boundaryType": "PunctuationBoundary"},
  {"audioOffset": 3250000, "visemeId": 0}
])";
constexpr const char* azure_printed =
    "(Viseme), Viseme ID: 0, Audio offset: 50ms.\n\n(Viseme), Viseme ID: 21, Audio offset: 100ms.\r\n……\n"
    "Viseme event received: audio offset: 200.0ms, viseme id: 11.\n(Viseme), Audio offset: 325ms. Viseme ID: 0\n";
constexpr const char* polly =
    "{\"time\":0,\"type\":\"sentence\",\"start\":0,\"end\":14,\"value\":\"Oi, mamãe má!\"}\n"
    "{\"time\":6,\"type\":\"word\",\"start\":0,\"end\":2,\"value\":\"Oi\"}\n"
    "{\"time\":6,\"type\":\"viseme\",\"value\":\"o\"}\n"
    "{\"time\":90,\"type\":\"viseme\",\"value\":\"i\"}\n"
    "{\"time\":180,\"type\":\"ssml\",\"start\":3,\"end\":20,\"value\":\"half\"}\n"
    "{\"time\":200,\"type\":\"viseme\",\"value\":\"sil\"}\n"
    "{\"time\":320,\"type\":\"word\",\"start\":4,\"end\":10,\"value\":\"mamãe\"}\n"
    "{\"time\":320,\"type\":\"viseme\",\"value\":\"p\"}\n"
    "{\"time\":400,\"type\":\"viseme\",\"value\":\"a\"}\n"
    "{\"time\":480,\"type\":\"viseme\",\"value\":\"sil\"}\n";
constexpr const char* rhubarb_tsv = "0.00\tX\n0.05\tD\n0.27\tC\n0.31\tB\n0.43\tX\n0.47\tX\n";
constexpr const char* rhubarb_xml =
    "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<rhubarbResult>\n  <metadata><soundFile>hi.wav</soundFile>"
    "<duration>0.47</duration></metadata>\n  <mouthCues>\n    <mouthCue start=\"0.00\" end=\"0.05\">X</mouthCue>\n"
    "    <mouthCue start=\"0.05\" end=\"0.27\">D</mouthCue>\n    <mouthCue start=\"0.27\" end=\"0.31\">C</mouthCue>\n"
    "    <mouthCue start=\"0.31\" end=\"0.43\">B</mouthCue>\n    <mouthCue start=\"0.43\" end=\"0.47\">X</mouthCue>\n"
    "  </mouthCues>\n</rhubarbResult>\n";
constexpr const char* rhubarb_json =
    R"({"metadata": {"soundFile": "hi.wav", "duration": 0.47}, "mouthCues": [
      {"start": 0.00, "end": 0.05, "value": "X"}, {"start": 0.05, "end": 0.27, "value": "D"},
      {"start": 0.27, "end": 0.31, "value": "C"}, {"start": 0.31, "end": 0.43, "value": "B"},
      {"start": 0.43, "end": 0.47, "value": "X"}]})";
constexpr const char* headtts =
    R"({"type": "audio", "ref": 1, "data": {"words": ["Maps ", "help."], "wtimes": [400, 760], "wdurations": [300, 350],
      "visemes": ["PP", "aa", "PP", "SS", "E", "PP"], "vtimes": [400, 470, 560, 640, 800, 950],
      "vdurations": [75, 95, 80, 60, 150, 90], "audioEncoding": "wav"}})";
constexpr const char* phonemes = "0.10\t0.20\tm\n0.20\t0.40\tˈɐ̃\n0.60\t0.70\tˌu\n";

VoiceTimeline read(std::string_view file) {
  const auto timeline = read_voice_timeline(file);
  EXPECT_TRUE(timeline.ok()) << timeline.error().where << ": " << timeline.error().message;
  return timeline.ok() ? *timeline : VoiceTimeline{};
}

/// "0 50 m@100 ..." of the sounds.
std::string sounds_of(const VoiceTimeline& timeline) {
  std::string text;
  for (const SpokenPhoneme& phoneme : timeline.phonemes)
    text += (text.empty() ? "" : " ") + phoneme.symbol + "@" + std::to_string(std::lround(phoneme.time));
  return text;
}

TEST(VoiceTimeline, Azure_HasTicksInJson_AndMsInPrint) {
  const auto timeline = read(azure_json);
  EXPECT_EQ(timeline.format, TimelineFormat::azure);
  EXPECT_EQ(sounds_of(timeline), "@50 p@100 aɪ@200 @325");
  ASSERT_EQ(timeline.words.size(), 1U) << "no punctuation";
  EXPECT_EQ(timeline.words[0].text, "My");
  EXPECT_EQ(sounds_of(read(azure_printed)), sounds_of(timeline));
  EXPECT_EQ(sounds_of(read(R"({"privAudioOffset":1000000,"privVisemeId":7}
{"audio_offset":2000000,"viseme_id":0})")),
            "u@100 @200")
      << "as the SDKs of JavaScript and Python name them, a line each";
}

TEST(VoiceTimeline, Polly_HasVisemesWordsSentencesAndMarks) {
  const auto timeline = read(polly);
  EXPECT_EQ(timeline.format, TimelineFormat::polly);
  EXPECT_EQ(sounds_of(timeline), "o@6 i@90 @200 p@320 a@400 @480");
  ASSERT_EQ(timeline.marks.size(), 1U);
  EXPECT_EQ(timeline.marks[0].name, "half");
  const std::string text = text_of(timeline);
  EXPECT_EQ(text, "Oi, mamãe má!");
  const auto said = utterance_of(timeline, text, std::nullopt);
  ASSERT_TRUE(said.ok());
  ASSERT_EQ(said->words.size(), 2U);
  EXPECT_EQ(said->words[1].range, (TextRange{4, 5})) << "characters, although Polly counts bytes";
  ASSERT_EQ(said->sentences.size(), 1U);
  EXPECT_EQ(said->duration, 480.0);
}

TEST(VoiceTimeline, Rhubarb_IsTheSameInItsThreeForms) {
  const std::string expected = "@0 ɑ@50 ɛ@270 s@310 @430";
  EXPECT_EQ(sounds_of(read(rhubarb_tsv)).substr(0, expected.size()), expected);
  EXPECT_EQ(sounds_of(read(rhubarb_xml)).substr(0, expected.size()), expected);
  EXPECT_EQ(sounds_of(read(rhubarb_json)).substr(0, expected.size()), expected);
  for (const char* file : {rhubarb_tsv, rhubarb_xml, rhubarb_json}) EXPECT_EQ(read(file).end, 470.0);
}

TEST(VoiceTimeline, HeadTts_ItsGapsAreRest) {
  const auto timeline = read(headtts);
  EXPECT_EQ(timeline.format, TimelineFormat::headtts);
  EXPECT_EQ(sounds_of(timeline), "p@400 ɑ@470 p@560 s@640 @700 ɛ@800 p@950 @1040");
  EXPECT_EQ(text_of(timeline), "Maps help.");
  EXPECT_EQ(timeline.end, 1110.0) << "the end of the last word";
}

TEST(VoiceTimeline, Phonemes_HaveStress) {
  const auto timeline = read(phonemes);
  EXPECT_EQ(timeline.format, TimelineFormat::phonemes);
  EXPECT_FALSE(timeline.of_visemes);
  EXPECT_EQ(sounds_of(timeline), "m@100 ɐ̃@200 @400 u@600 @700");
  EXPECT_EQ(timeline.phonemes[1].stress, Stress::primary);
  EXPECT_EQ(timeline.phonemes[3].stress, Stress::secondary);
}

TEST(VoiceTimeline, OursComesBack_WhollyWithItsTextAndSentences) {
  const std::string text = "Olá,\nmundo!  É 1 só: \"pão\"? Sim...";
  Utterance said;
  said.duration = 2000.0;
  said.phonemes = {{0.0, "", Stress::none},       {120.0, "o", Stress::none},      {200.3, "l", Stress::none},
                   {260.0, "a", Stress::primary}, {900.0, "ɐ̃", Stress::secondary}, {1500.0, "s", Stress::none}};
  said.words = {{120.0, {0, 3}}, {400.0, {5, 5}}, {900.0, {13, 1}}, {950.0, {15, 1}}, {1500.0, {28, 3}}};
  said.sentences = {{120.0, 0}, {899.96, 13}, {1500.0, 28}};
  said.marks = {{700.0, "here"}};
  const std::string ours = timeline_json(said, text, "pt-BR");
  const auto again = read(ours);
  EXPECT_EQ(again.format, TimelineFormat::semblante);
  EXPECT_EQ(text_of(again), text);
  std::size_t missing = 9;
  const auto same = utterance_of(again, text_of(again), std::nullopt, &missing);
  ASSERT_TRUE(same);
  EXPECT_EQ(missing, 0U);
  EXPECT_EQ(timeline_json(*same, text, "pt-BR"), ours);
  EXPECT_EQ(web_vtt(*same, text), web_vtt(said, text));

  // Edited: places of another text are found, and its sentences begin with their words.
  const auto edited = utterance_of(again, "Digo: olá, mundo! É 1 Sim", std::nullopt, &missing);
  ASSERT_TRUE(edited);
  EXPECT_EQ(missing, 1U) << "Olá is written otherwise";
  ASSERT_EQ(edited->sentences.size(), 3U);
  EXPECT_EQ(edited->sentences[1].first, 18U);
  EXPECT_EQ(edited->sentences[2].first, 22U);

  // Of before there was a text in it: words alone.
  auto old = nlohmann::json::parse(ours);
  old.erase("text");
  EXPECT_EQ(text_of(read(old.dump())), "Olá mundo É 1 Sim");
}

TEST(VoiceTimeline, PlacesOfOurs_AreChecked) {
  auto file = nlohmann::json::parse(R"({"format":"semblante.timeline","version":1,"duration":500,"text":"a b",
    "words":[{"time":0,"first":0,"count":1,"text":"a"},{"time":9,"first":7,"count":1,"text":"b"}],
    "sentences":[{"time":0,"first":0},{"time":1,"first":900}],"phonemes":[{"time":0,"end":500,"ipa":"a"}]})");
  std::size_t missing = 0;
  const auto said = utterance_of(read(file.dump()), "a b", std::nullopt, &missing);
  ASSERT_TRUE(said);
  EXPECT_EQ(missing, 1U);
  EXPECT_EQ(said->sentences.size(), 1U);
  file["text"] = std::string(max_utterance_text_bytes + 1, 'a');
  EXPECT_FALSE(read_voice_timeline(file.dump()));
  file["text"] = 7;
  EXPECT_FALSE(read_voice_timeline(file.dump()));
}

TEST(VoiceTimeline, EverySymbolOfASystem_IsASoundOfTheTableOfEnglish) {
  for (const VisemeSymbols* symbols : {&visemes::azure, &visemes::polly, &visemes::rhubarb, &visemes::oculus}) {
    EXPECT_GT(symbols->source.size(), 40U);
    std::set<std::string_view> seen;
    for (const VisemeSymbol& row : symbols->rows) {
      EXPECT_TRUE(seen.insert(row.symbol).second) << row.symbol;
      for (const Sound& sound : ::semblante::sounds_of(sound_table("en"), row.ipa))
        EXPECT_TRUE(row.ipa.empty() || !sound.ipa.empty()) << symbols->system << " " << row.symbol;
    }
  }
  EXPECT_EQ(visemes::azure.rows.size(), 22U);
  EXPECT_EQ(visemes::rhubarb.rows.size(), 9U);
  EXPECT_EQ(visemes::oculus.rows.size(), 15U);
  // What closes there closes here.
  for (const auto& [symbols, closed] :
       {std::pair{&visemes::azure, "21"}, {&visemes::polly, "p"}, {&visemes::rhubarb, "A"}, {&visemes::oculus, "PP"}})
    EXPECT_EQ(::semblante::sounds_of(sound_table("en"), symbols->find(closed)->ipa)[0].kind, SoundKind::both_lips);
}

TEST(VoiceTimeline, WordsOfAnotherText_AreLeftOutAndCounted) {
  std::size_t missing = 0;
  const auto said = utterance_of(read(headtts), "We help.", std::nullopt, &missing);
  ASSERT_TRUE(said.ok());
  ASSERT_EQ(said->words.size(), 1U);
  EXPECT_EQ(said->words[0].range, (TextRange{3, 5}));
  EXPECT_EQ(missing, 1U);
}

TEST(VoiceTimeline, TheSoundIsItsClock_AndMustBeLongEnough) {
  const Recording second{8000, std::vector<std::int16_t>(8000, 100)};
  const auto said = utterance_of(read(rhubarb_tsv), "", second);
  ASSERT_TRUE(said.ok());
  EXPECT_EQ(said->duration, 1000.0);
  const auto late = read("0.0\tA\n9.0\tX\n");
  const auto refused = utterance_of(late, "", second);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::mismatch);
}

TEST(VoiceTimeline, WhatIsWrong_IsNamedWithItsPlace) {
  const auto refused = [](std::string_view file, const char* where, const char* message,
                          std::optional<TimelineFormat> format = {}) {
    const auto timeline = read_voice_timeline(file, format);
    ASSERT_FALSE(timeline.ok()) << file;
    EXPECT_EQ(timeline.error().where, where) << file;
    EXPECT_THAT(timeline.error().message, HasSubstr(message)) << file;
  };
  refused("", "", "no format");
  refused("hello", "", "no format");
  refused("", "", "no sounds", TimelineFormat::phonemes);
  refused("0.0\tX\n0.1\tQ\n", "line 2", "\"Q\" among the symbols of rhubarb");
  refused("0.2\tX\n\n0.1\tA\n", "line 3", "must not decrease");
  refused("0.0\tX\nA\n", "line 2", "columns");
  refused("nan\tX\n", "line 1", "within");
  refused("-1\tX\n", "line 1", "within");
  refused("1e9\tX\n", "line 1", "within");
  refused("0.2\t0.1\ta\n", "line 1", "ends before");
  refused("0.1\t0.2\t" + std::string(40, 'a') + "\n", "line 1", "too long");
  refused(R"([{"audioOffset": 0, "visemeId": 22}])", "/0/visemeId", "\"22\" among");
  refused(R"([{"visemeId": 2}])", "/0/audioOffset", "");
  refused("Viseme ID: 1, Audio offset: 5ms.\nViseme ID: 1\n", "line 2", "Audio offset");
  refused("{\"time\":0,\"type\":\"viseme\",\"value\":\"sil\"}\n{\"time\":9,\"type\":\"viseme\",\"value\":\"Q\"}\n",
          "line 2/value", "polly");
  refused("{\"time\":0,\"type\":\"smell\",\"value\":\"sil\"}\n", "line 1/value", "must be viseme");
  refused("{\"time\":0,\"type\":\"viseme\",\"value\":\"sil\"", "line 1", "cannot be read");
  refused(R"({"mouthCues": [{"start": 0, "end": 1}]})", "/mouthCues/0/value", "");
  refused("<!DOCTYPE a [<!ENTITY b 'c'>]><mouthCue start=\"0\" end=\"1\">X</mouthCue>", "byte 0", "declaration");
  refused("<mouthCue start=\"0\" end=\"1\">X", "byte 0", "no end");
  refused(R"({"visemes": ["PP"], "vtimes": [0, 1], "vdurations": [1]})", "/visemes", "as many");
  refused(std::string(max_timeline_bytes + 1, ' '), "", "longer than");
  std::string many;
  for (std::size_t i = 0; i <= max_timeline_events; ++i)
    many += R"({"time":1,"type":"word","value":"a"})"
            "\n";
  refused(many, ("line " + std::to_string(max_timeline_events + 1) + "/value").c_str(), "more than");
  std::string dense;
  for (int i = 0; i < 100; ++i) dense += "1\tA\n";
  refused(dense, "line 61", "within a second");
}

}  // namespace
}  // namespace semblante
