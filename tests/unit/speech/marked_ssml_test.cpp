// Emotions within SSML, and the text that a document says.
#include "core/speech/marked_ssml.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace semblante {
namespace {

using ::testing::HasSubstr;

MarkedSsml ssml_of(std::string_view text) {
  const auto read = read_marked_ssml(text);
  EXPECT_TRUE(read.ok()) << read.error().message;
  return read ? *read : MarkedSsml{};
}

TEST(MarkedSsml, AnEmotion_IsProsodyForTheVoice_AndASpanForTheFace) {
  const auto ssml = ssml_of("<speak>Olá, <emotion name='sadness' intensity='0.5'>meu á</emotion> fim.</speak>");
  EXPECT_EQ(ssml.document, "<speak>Olá, <prosody rate=\"94%\" pitch=\"-5%\">meu á</prosody> fim.</speak>");
  EXPECT_EQ(ssml.said.text, "Olá, meu á fim.");
  ASSERT_EQ(ssml.said.emotions.size(), 1U);
  EXPECT_EQ(ssml.said.emotions[0].expression, 2);
  EXPECT_EQ(ssml.said.emotions[0].intensity, 0.5);
  EXPECT_EQ(ssml.said.emotions[0].range, (TextRange{5, 5}));
}

TEST(MarkedSsml, Prosody_CarriesAnEmotion_AndKeepsItsOwnRate) {
  const auto ssml = ssml_of(
      "<prosody rate=\"slow\" emotion=\"anger\" intensity=\"0.3\" pitch='low'>a <prosody "
      "volume='loud'>b</prosody></prosody>");
  EXPECT_EQ(ssml.document, "<prosody rate=\"slow\" pitch=\"low\">a <prosody volume=\"loud\">b</prosody></prosody>");
  ASSERT_EQ(ssml.said.emotions.size(), 1U);
  EXPECT_EQ(ssml.said.emotions[0].expression, 3);
  EXPECT_EQ(ssml.said.emotions[0].range, (TextRange{0, 3}));
}

TEST(MarkedSsml, EverythingElseStays_AndWordsFindTheirPlaceInTheText) {
  const char* const text =
      "<speak>A &amp; <!-- <b> --><mark name=\"x\"/>é <say-as interpret-as='characters'>bc</say-as> & d</speak>";
  const auto ssml = ssml_of(text);
  EXPECT_EQ(ssml.document, text);
  EXPECT_EQ(ssml.said.text, "A & é bc & d");
  Utterance said;
  const auto at = [&](std::string_view what) { return std::string_view(text).find(what); };
  // Characters: "é" has two bytes, and comes after the first two.
  said.words = {{0, {at("A"), 1}}, {1, {at(";"), 1}}, {2, {at("é"), 1}}, {3, {at("bc") - 1, 2}}, {9, {9000, 9}}};
  said.sentences = {{0, at("A")}};
  place_in_text(ssml, said);
  EXPECT_EQ(said.words[0].range, (TextRange{0, 1}));
  EXPECT_EQ(said.words[1].range, (TextRange{2, 1})) << "espeak-ng reports the end of a reference";
  EXPECT_EQ(said.words[2].range, (TextRange{4, 1}));
  EXPECT_EQ(said.words[3].range, (TextRange{6, 2}));
  EXPECT_EQ(said.words[4].range.count, 0U);
  EXPECT_EQ(said.sentences[0].first, 0U);
}

TEST(MarkedSsml, WhatIsWrong_IsNamedWithItsByte) {
  for (const auto& [text, message] : {std::pair{"a<emotion name='joy'>b", "<emotion> is not closed (byte 22)"},
                                      {"a</emotion>", "closes what is not open (byte 1)"},
                                      {"<emotion name='joy'><prosody></emotion></prosody>", "(byte 29)"},
                                      {"<emotion>a</emotion>", "must be one of joy"},
                                      {"<emotion name='bored'>a</emotion>", "must be one of joy"},
                                      {"<emotion name='joy' intensity='2'>a</emotion>", "must be 0 to 1"},
                                      {"<emotion name='joy' rate='x'>a</emotion>", "only a name"},
                                      {"<emotion name='joy' name='joy'>a</emotion>", "twice"},
                                      {"<emotion name='joy>a</emotion>", "has no end"},
                                      {"<emotion name=joy>a</emotion>", "between quotes"},
                                      {"<prosody emotion='x'>a</prosody>", "the emotion of <prosody>"},
                                      {"<emotion name='joy'/>", "nothing in it"},
                                      {"a < b", "no name"},
                                      {"<speak>\xF2\x8B<p>\x8B\x8B</p></speak>", "not UTF-8 (byte 7)"},
                                      {"<!-- a", "comment"}}) {
    const auto read = read_marked_ssml(text);
    ASSERT_FALSE(read.ok()) << text;
    EXPECT_THAT(read.error().message, HasSubstr(message)) << text;
  }
}

TEST(SsmlParts, AreCutBetweenSentences_AndElementsGoOn) {
  const std::string text =
      "<speak><p>Good morning to everybody who is here today! </p><prosody rate=\"slow\"><emotion name=\"joy\">It is "
      "warm and sunny outside, 3.5 degrees more. And it stays so.</emotion></prosody></speak>";
  const auto first = first_part_of_ssml(text);
  EXPECT_EQ(first.first, "<speak><p>Good morning to everybody who is here today! </p></speak>");
  const auto second = first_part_of_ssml(first.rest);
  EXPECT_EQ(second.first,
            "<speak><prosody rate=\"slow\"><emotion name=\"joy\">It is warm and sunny outside, 3.5 degrees more. "
            "</emotion></prosody></speak>");
  EXPECT_EQ(second.rest,
            "<speak><prosody rate=\"slow\"><emotion name=\"joy\">And it stays so.</emotion></prosody></speak>");
  EXPECT_EQ(first_part_of_ssml(second.rest).rest, "");
  // Together they say what the whole says, with its emotions.
  const auto whole = read_marked_ssml(text), a = read_marked_ssml(first.first), b = read_marked_ssml(second.first),
             c = read_marked_ssml(second.rest);
  ASSERT_TRUE(whole && a && b && c);
  EXPECT_EQ(a->said.text + b->said.text + c->said.text, whole->said.text);
  EXPECT_TRUE(a->said.emotions.empty());
  EXPECT_EQ(b->said.emotions.at(0).expression, c->said.emotions.at(0).expression);
}

TEST(SsmlParts, WithoutSentences_AreCutWhereALongTextMayBreak_AlsoInElements) {
  std::string words, entities;
  for (int i = 0; i < 200; ++i) words += "abc ", entities += "&amp;";
  const auto cut = first_part_of_ssml("<speak><s>" + words + "</s></speak>");
  EXPECT_EQ(cut.first, "<speak><s>" + words.substr(0, 320) + "</s></speak>");
  EXPECT_EQ(cut.rest, "<speak><s>" + words.substr(320) + "</s></speak>");
  const auto spelled =
      first_part_of_ssml("<speak><say-as interpret-as=\"characters\">" + std::string(700, 'x') + "</say-as></speak>");
  EXPECT_EQ(spelled.rest, "<speak><say-as interpret-as=\"characters\">" + std::string(220, 'x') + "</say-as></speak>");
  EXPECT_TRUE(
      first_part_of_ssml("<speak>" + entities + entities + entities + "</speak>").rest.starts_with("<speak>&amp;"));
  EXPECT_EQ(first_part_of_ssml("<speak><sub alias=\"x\">" + words + "</sub></speak>").rest, "");
}

TEST(SsmlParts, WhatCannotBeCut_IsWhole) {
  const std::string filler = "This is a sentence with more than forty characters";
  for (const std::string& text :
       {"<speak><s>" + filler + ", and. another. one</s></speak>",
        "<speak><say-as interpret-as=\"x\">" + filler + ". And more.</say-as></speak>",
        "<speak>" + filler + ". </speak>", "<speak>" + filler + ". <break/><mark name=\"a\"/></speak>",
        "<speak><p>" + filler + ". More.</speak></p>", "<speak>" + filler + ". <a b>More.",
        std::string("<speak>\xFF") + filler + ". More</speak>", std::string("<speak><!-- ") + filler + ". More"}) {
    const auto parts = first_part_of_ssml(text);
    EXPECT_EQ(parts.first, text);
    EXPECT_EQ(parts.rest, "");
  }
  EXPECT_EQ(first_part_of_ssml("<speak><s>" + filler + "</s><s>More</s></speak>").rest, "<speak><s>More</s></speak>");
}

}  // namespace
}  // namespace semblante
