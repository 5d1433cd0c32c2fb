// Sound and captions of an utterance as files.
#include <fstream>
#include <regex>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/speech/characters.h"
#include "core/speech/loudness.h"
#include "core/speech/speech.h"
#include "core/speech/text_breaks.h"
#include "core/speech/wav.h"
#include "core/speech/whole_words.h"

namespace semblante {
namespace {

TEST(WebVtt, WordsWithoutSpaceBetween_AreJoined) {
  Utterance said;
  said.duration = 2000;
  said.words = {{100, {0, 1}}, {500, {1, 2}}, {900, {4, 6}}};
  EXPECT_EQ(web_vtt(said, "3,5 metros"),
            "WEBVTT\n\n00:00:00.100 --> 00:00:01.900\n3<00:00:00.500>,5 <00:00:00.900>metros\n");
}

TEST(WebVtt, QuotationMarksAndBrackets_StandBeforeTheirWords) {
  Utterance said;
  said.duration = 3000;
  said.words = {{100, {2, 3}}, {900, {10, 3}}, {1500, {15, 1}}};
  said.sentences = {{100, 0}, {900, 8}};
  EXPECT_EQ(web_vtt(said, "¡“Olá!”\n \t“Sim (é)”."),
            "WEBVTT\n\n00:00:00.100 --> 00:00:00.900\n¡“Olá!”\n\n"
            "00:00:00.900 --> 00:00:02.500\n“Sim <00:00:01.500>(é)”.\n");
}

TEST(WebVtt, HasEachWordWithItsTime_ASentenceACue_AndNoMarkup) {
  Utterance said;
  said.duration = 3000;
  said.words = {{400, {0, 3}}, {900, {5, 5}}, {1500, {12, 1}}};
  said.sentences = {{400, 0}, {1500, 12}};
  EXPECT_EQ(web_vtt(said, "Olá, mundo! <a&"),
            "WEBVTT\n\n00:00:00.400 --> 00:00:01.500\nOlá, <00:00:00.900>mundo!\n\n"
            "00:00:01.500 --> 00:00:02.500\n&lt;a&amp;\n");
}

/// The cues of a text, without times, if every word takes 300 ms.
std::vector<std::string> cues_of(std::string_view text) {
  const Characters characters(text);
  const auto is_blank = [&](std::size_t i) { return i == characters.count() || is_space(text[characters.byte_of(i)]); };
  Utterance said;
  for (std::size_t begin = 0, end = 0; begin < characters.count(); begin = end + 1) {
    for (end = begin; !is_blank(end);) ++end;
    said.words.push_back({300.0 * static_cast<double>(said.words.size()), {begin, end - begin}});
  }
  said.duration = 300.0 * static_cast<double>(said.words.size());
  said.sentences = {{0, 0}};
  std::istringstream vtt(std::regex_replace(web_vtt(said, text), std::regex("<[^>]*>"), ""));
  std::vector<std::string> cues;
  for (std::string line; std::getline(vtt, line);)
    if (!line.empty() && line != "WEBVTT" && line.find("-->") == std::string::npos) cues.push_back(line);
  return cues;
}

TEST(WebVtt, SentencesAreDividedAsInPages) {
  std::ifstream file(SEMBLANTE_SOURCE_DIR "/tests/golden/speech/cues.json");
  const auto vectors = nlohmann::json::parse(file);
  ASSERT_GE(vectors.size(), 10U);
  for (const auto& vector : vectors) {
    const auto text = vector.at("text").get<std::string>();
    EXPECT_EQ(cues_of(text), vector.at("cues").get<std::vector<std::string>>()) << text;
  }
}

TEST(WebVtt, WordsOutsideTheText_DoNoHarm) {
  Utterance said;
  said.duration = 2000;
  said.words = {{10, {90, 3}}, {20, {1, 20000}}};
  EXPECT_NE(web_vtt(said, "ab").find("WEBVTT"), std::string::npos);
}

TEST(WholeWords, SignsAloneAndPartsOfWords_AreNone) {
  // As espeak-ng tells them of "<speak>Code <say-as interpret-as='characters'>XY</say-as>. It is <say-as
  // interpret-as='digits'>123</say-as>, no? </speak>"
  const std::string text = "Code XY. It is 123, né? … 。";
  Utterance said;
  said.duration = 3000;
  said.words = {{0, {0, 4}},     {500, {5, 2}},   {1100, {7, 1}},  {1200, {9, 2}},  {1300, {12, 2}}, {1400, {15, 3}},
                {1800, {16, 3}}, {2000, {20, 2}}, {2100, {22, 1}}, {2200, {24, 1}}, {2300, {26, 1}}};
  keep_whole_words(said, text);
  std::vector<std::size_t> places;
  for (const auto& word : said.words) places.push_back(word.range.first);
  EXPECT_EQ(places, (std::vector<std::size_t>{0, 5, 9, 12, 15, 20}));
  EXPECT_EQ(web_vtt(said, text).find("-->", 40), std::string::npos) << "one cue";
}

/// A number that is said in parts, of which the first claims all of it; a word that is named again, and one that is not
/// there.
TEST(WholeWords, OverlapAndOrder) {
  const std::string text = "3,5 metros e meio";
  Utterance said;
  said.duration = 2000;
  said.words = {{0, {0, 3}},    {100, {1, 2}}, {200, {4, 6}},  {300, {4, 6}},    {350, {11, 0}},
                {400, {11, 1}}, {500, {0, 3}}, {600, {40, 2}}, {700, {13, 999}}, {800, {15, 2}}};
  keep_whole_words(said, text);
  std::vector<double> times;
  for (const auto& word : said.words) times.push_back(word.time);
  EXPECT_EQ(times, (std::vector<double>{0, 200, 400, 700}));
  EXPECT_EQ(web_vtt(said, text),
            "WEBVTT\n\n00:00:00.000 --> 00:00:01.700\n3,5 <00:00:00.200>metros <00:00:00.400>e "
            "<00:00:00.700>meio\n");
}

TEST(WholeWords, SmileysNumbersAndUnits_AreWords) {
  const std::string text = "😀 5 % & €";
  Utterance said;
  said.words = {{0, {0, 1}}, {1, {2, 1}}, {2, {4, 1}}, {3, {6, 1}}, {4, {8, 1}}};
  keep_whole_words(said, text);
  EXPECT_EQ(said.words.size(), 5U);
}

TEST(Wav, HasItsHeader_AndSilenceAround) {
  Utterance said;
  said.sample_rate = 1000;
  said.samples = {1, -2};
  said.phonemes = {{1, "a"}};
  said = with_silence(said, 3, 4);
  EXPECT_EQ(said.samples.size(), 9U);
  EXPECT_EQ(said.phonemes[0].time, 4);
  EXPECT_EQ(said.duration, 9);
  const std::string file = wav(said);
  EXPECT_EQ(file.size(), 44U + 18U);
  EXPECT_EQ(file.substr(0, 4) + file.substr(8, 8), "RIFFWAVEfmt ");
  EXPECT_EQ(file.substr(44 + 6, 4), std::string("\x01\x00\xFE\xFF", 4));
}

}  // namespace
}  // namespace semblante
