#include "server/voice/speech_texts.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "protocol/cpp/frame_codec.h"
#include "protocol/cpp/speech_score.h"
#include "tests/support/frame_encoder.h"

/// A speech as text for clients with a voice of their own.
namespace semblante::voice {
namespace {

/// "Pa me! O." after 120 ms: p a (200 ms), m e (200 ms), a pause (300 ms), o (100 ms), and silence.
Speech two_sentences() {
  Speech speech;
  speech.text = "Pa me! O.";
  speech.sounds = "pt-BR";
  Utterance& said = speech.utterance;
  said.duration = 1600;
  said.phonemes = {{0, ""}, {120, "p"}, {170, "a"}, {320, "m"}, {370, "e"}, {520, ""}, {820, "o"}, {920, ""}};
  said.words = {{120, {0, 2}}, {320, {3, 2}}, {820, {7, 1}}};
  said.sentences = {{120, 0}, {820, 7}};
  return speech;
}

Cue joy(double time, double duration, double value) {
  Cue cue;
  cue.time = time;
  cue.duration = duration;
  cue.target = ExpressionTarget{1};
  cue.value = value;
  return cue;
}

SpeechScore score_of(const SpeechText& text) {
  EXPECT_TRUE(check_text(text)) << text.text;
  return read_score(text.score).value_or(SpeechScore{});
}

TEST(SpeechTexts, EachSentence_IsATextAtItsTime) {
  const auto texts = speech_texts(two_sentences());
  ASSERT_EQ(texts.size(), 2U);
  EXPECT_EQ(texts[0].text, "Pa me!");
  EXPECT_EQ(texts[1].text, "O.");
  EXPECT_EQ(texts[0].media_time, 120U);
  EXPECT_EQ(texts[1].media_time, 820U);
  EXPECT_EQ(texts[0].language, "pt-BR");
}

TEST(SpeechTexts, Score_HasWordsAndVisemesAtTheirTimes) {
  const auto score = score_of(speech_texts(two_sentences()).at(0));
  ASSERT_EQ(score.steps.size(), 4U);
  EXPECT_EQ(score.steps[0].viseme, 1) << "p";
  EXPECT_TRUE(score.steps[0].begins_word);
  EXPECT_EQ(score.steps[0].end, 60U);
  EXPECT_EQ(score.steps[1].end, 210U) << "200 ms by steps of 30";
  EXPECT_EQ(score.steps[2].viseme, 1) << "m";
  EXPECT_TRUE(score.steps[2].begins_word);
  EXPECT_EQ(score.duration(), 390U) << "without the pause after it";
}

TEST(SpeechTexts, ShortClosure_LastsLongEnoughToBeSeen) {
  Speech speech = two_sentences();
  speech.utterance.phonemes[2].time = 130;  // p of 10 ms
  const auto score = score_of(speech_texts(speech).at(0));
  EXPECT_EQ(score.steps[0].viseme, 1);
  EXPECT_EQ(score.steps[0].end, 60U);
  EXPECT_EQ(score.steps[1].end, 210U) << "the next word is at its time";
}

TEST(SpeechTexts, SentencesThatNobodyTold_AreFoundByTheirEnds) {
  Speech speech = two_sentences();
  speech.utterance.sentences.clear();
  const auto texts = speech_texts(speech);
  ASSERT_EQ(texts.size(), 2U);
  EXPECT_EQ(texts[1].text, "O.");
}

TEST(SpeechTexts, Expression_IsWhereItsWordsAre) {
  Speech speech = two_sentences();
  speech.performance.cues = {joy(200, 2000, 0.5)};
  const auto texts = speech_texts(speech);
  const auto first = score_of(texts.at(0)).expressions;
  ASSERT_EQ(first.size(), 1U);
  EXPECT_EQ(first[0].expression, 1);
  EXPECT_EQ(first[0].intensity, 32);
  EXPECT_EQ(first[0].begin, 210U) << "with the next sound";
  const auto second = score_of(texts.at(1)).expressions;
  ASSERT_EQ(second.size(), 1U);
  EXPECT_EQ(second[0].begin, 0U) << "it goes on";
}

TEST(SpeechTexts, WordInWhichNothingIsSaid_HasItsPlaceToo) {
  Speech speech = two_sentences();
  speech.text = "Pa - me!";
  speech.utterance.words = {{120, {0, 2}}, {320, {5, 2}}};
  speech.utterance.sentences = {{120, 0}};
  const auto texts = speech_texts(speech);
  ASSERT_EQ(texts.size(), 1U);
  const auto score = score_of(texts[0]);
  std::size_t words = 0;
  for (const auto& step : score.steps) words += step.begins_word ? 1 : 0;
  EXPECT_EQ(words, 3U);
}

TEST(SpeechTexts, QuotationMark_BelongsToItsSentence) {
  Speech speech = two_sentences();
  speech.text = "Pa me! \"O.\"";
  speech.utterance.words[2].range.first = 8;
  speech.utterance.sentences[1].first = 8;
  const auto texts = speech_texts(speech);
  ASSERT_EQ(texts.size(), 2U);
  EXPECT_EQ(texts[0].text, "Pa me!");
  EXPECT_EQ(texts[1].text, "\"O.\"");
}

TEST(SpeechTexts, LongSentence_IsDividedAtWords) {
  Speech speech;
  speech.sounds = "en";
  for (std::size_t i = 0; i < 2000; ++i) {
    speech.utterance.words.push_back({200.0 * static_cast<double>(i), {speech.text.size(), 4}});
    speech.utterance.phonemes.push_back({200.0 * static_cast<double>(i), i % 2 == 0 ? "a" : "m"});
    speech.text += "word ";
  }
  speech.utterance.duration = 400'000;
  speech.utterance.sentences = {{0, 0}};
  const auto texts = speech_texts(speech);
  std::size_t words = 0;
  for (const auto& text : texts) {
    EXPECT_LE(text.text.size(), 300U);
    words += word_begins(text.text).size();
    EXPECT_LE(score_of(text).duration(), 200.0 * static_cast<double>(word_begins(text.text).size()) + 60.0);
  }
  EXPECT_EQ(words, 2000U) << "none is lost";
}

TEST(SpeechTexts, TextWithoutSpaces_IsCutToAMessage) {
  Speech speech;
  speech.sounds = "cmn";
  for (int i = 0; i < 1500; ++i) speech.text += "\u4f60";
  speech.utterance.words = {{0, {0, 1500}}};
  speech.utterance.phonemes = {{0, "n"}};
  speech.utterance.duration = 3'000'000;
  for (const auto& text : speech_texts(speech)) {
    EXPECT_LE(text.text.size(), max_speech_text_bytes);
    EXPECT_EQ(text.text.size() % 3, 0U) << "not within a character";
    EXPECT_TRUE(check_text(text));
  }
}

TEST(SpeechWithoutWords, OfASmileyAlone_IsAFaceThatShowsIt) {
  for (const auto& [text, expression] : {std::pair{"😀", 1}, std::pair{" :( ", 2}, std::pair{"😠😠", 3}}) {
    SpeechRequest request;
    request.voice.text = text;
    request.voice.language = "pt-BR";
    const auto speech = make_speech({}, request);  // no voice is needed
    ASSERT_TRUE(speech) << text << speech.error().message;
    EXPECT_GT(speech->utterance.duration, 2000.0);
    EXPECT_TRUE(std::all_of(speech->utterance.samples.begin(), speech->utterance.samples.end(),
                            [](std::int16_t sample) { return sample == 0; }));
    EXPECT_TRUE(std::any_of(speech->performance.cues.begin(), speech->performance.cues.end(),
                            [&, expression = expression](const Cue& cue) {
                              const auto* const target = std::get_if<ExpressionTarget>(&cue.target);
                              return target != nullptr && target->expression == expression &&
                                     cue.duration.value_or(0.0) > 1000.0;
                            }))
        << text;
    auto parts = SpeechParts::read({}, request);
    ASSERT_TRUE(parts);
    EXPECT_TRUE(parts->next());
    EXPECT_TRUE(parts->done());
  }
  SpeechRequest nothing;
  nothing.voice.text = " ";
  nothing.voice.language = "en";
  EXPECT_FALSE(make_speech({}, nothing));
}

TEST(SpeechTexts, NoWords_NoTexts) {
  Speech speech = two_sentences();
  speech.utterance.words.clear();
  EXPECT_TRUE(speech_texts(speech).empty());
  EXPECT_TRUE(speech_texts({}).empty());
}

#ifdef SEMBLANTE_VOICE_ESPEAK
TEST(SpeechTexts, OfTheVoice_CanBeRead_AndSayTheWholeText) {
  for (const auto* language : {"pt-BR", "en"}) {
    SpeechRequest request;
    request.voice.language = language;
    request.voice.text = "Good morning - \"hello\"! It costs 25.50, Mr. Smith... :) Really? [joy]Yes, of course.[/joy]";
    VoiceProgram program;
    program.command = {SEMBLANTE_VOICE_ESPEAK};
    const auto speech = make_speech(program, request);
    ASSERT_TRUE(speech) << speech.error().message;
    const auto texts = speech_texts(*speech);
    EXPECT_GE(texts.size(), 3U);
    std::size_t words = 0;
    double before = 0;
    bool joyful = false;
    for (const auto& text : texts) {
      words += word_begins(text.text).size();
      const auto score = score_of(text);
      EXPECT_GE(static_cast<double>(text.media_time), before) << text.text;
      before = static_cast<double>(text.media_time) + score.duration() - 100.0;
      for (const auto& one : score.expressions) joyful = joyful || one.expression == 1;
      const auto decoded = FrameDecoder().decode(FrameEncoder().encode(text));
      EXPECT_TRUE(decoded.ok());
    }
    EXPECT_EQ(words, word_begins(speech->text).size());
    EXPECT_TRUE(joyful);
    EXPECT_LE(before, speech->utterance.duration);
  }
}

TEST(SpeechParts, OfLongSsml_SayWhatTheWholeSays) {
  SpeechRequest request;
  request.voice.language = "en";
  request.voice.ssml = true;
  request.voice.text =
      "<speak><p>Good morning to everybody who is here with us today.</p><break time=\"500ms\"/><prosody "
      "rate=\"80%\">It is "
      "warm and sunny outside, so we begin. <emotion name=\"joy\">Everybody will have a very good time of it, I am "
      "sure. "
      "Nothing is missing.</emotion></prosody></speak>";
  VoiceProgram program;
  program.command = {SEMBLANTE_VOICE_ESPEAK};
  const auto whole = make_speech(program, request);
  ASSERT_TRUE(whole) << whole.error().message;
  auto parts = SpeechParts::read(program, request);
  ASSERT_TRUE(parts);
  double ms = 0.0, first_ms = 0.0;
  std::size_t phonemes = 0, count = 0;
  for (; !parts->done(); ++count) {
    const auto part = parts->next();
    ASSERT_TRUE(part) << part.error().message;
    ms += part->sound.duration;
    if (count == 0) first_ms = ms;
    for (const auto& phoneme : part->sound.phonemes) phonemes += phoneme.symbol.empty() ? 0 : 1;
  }
  EXPECT_GE(count, 3U);
  EXPECT_LT(first_ms, 0.4 * ms);
  EXPECT_EQ(phonemes,
            static_cast<std::size_t>(std::count_if(whole->utterance.phonemes.begin(), whole->utterance.phonemes.end(),
                                                   [](const auto& phoneme) { return !phoneme.symbol.empty(); })));
  EXPECT_NEAR(ms, whole->utterance.duration, 0.03 * whole->utterance.duration);
  request.part = true;
  const auto first = make_speech(program, request);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->text, "Good morning to everybody who is here with us today.");
}
#endif

}  // namespace
}  // namespace semblante::voice
