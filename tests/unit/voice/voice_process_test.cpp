// Voices as programs: the one of espeak-ng, the example, and ones that misbehave.
#include "server/voice/voice_process.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/store/store_error.h"

namespace semblante::voice {
namespace {

VoiceRequest asking(std::string text, std::string language = "pt-BR") {
  return {.text = std::move(text), .language = std::move(language), .voice = ""};
}

/// A voice that runs this line of shell.
VoiceProgram shell(std::string line) {
  VoiceProgram program;
  program.command = {"/bin/sh", "-c", std::move(line)};
  program.wall_seconds = 10;
  return program;
}

const std::string fake_header = R"(echo '{"protocol":1,"name":"fake","sample_rate":8000}';)";

TEST(Voice, AFake_IsHeard) {
  const auto got = speak(shell("cat > /dev/null;" + fake_header +
                               R"(echo '{"audio":"AAABAAIA"}'; echo '{"phoneme":"a","time":0}'; echo '{"end":true}')"),
                         asking("a"));
  ASSERT_TRUE(got.ok()) << got.error().message;
  EXPECT_EQ(got->samples, (std::vector<std::int16_t>{0, 1, 2}));
  EXPECT_EQ(got->voice, "fake");
}

TEST(Voice, Misbehaviour_IsAnErrorAndEndsTheProgram) {
  const auto begin = std::chrono::steady_clock::now();
  for (const char* const line : {"exit 3", "echo nonsense; sleep 100", "yes", "tr '\\0' a < /dev/zero", "kill -SEGV $$",
                                 "true", "echo '{\"error\":\"not today\"}'; exit 2", "echo oops >&2; exit 1"}) {
    const auto got = speak(shell(line), asking("a"));
    EXPECT_FALSE(got.ok()) << line;
    if (std::string_view(line).starts_with("echo oops")) {
      EXPECT_NE(got.error().message.find("oops"), std::string::npos) << got.error().message;
    }
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(60));
  EXPECT_FALSE(speak({.command = {"/nonexistent"}}, asking("a")).ok());
  EXPECT_FALSE(speak({.command = {""}}, asking("a")).ok());
}

TEST(Voice, LimitsHoldBeforeItReads) {
  auto program = shell(R"sh(cat > /dev/null; [ "$(ulimit -v)" = 1048576 ] && echo '{"error":"is limited"}')sh");
  program.memory_bytes = std::uint64_t{1} << 30U;
  EXPECT_EQ(speak(program, asking("a")).error().message, "is limited");
  auto sleeper = shell("sleep 30");
  sleeper.wall_seconds = 1;
  EXPECT_NE(speak(sleeper, asking("a")).error().message.find("longer than 1 s"), std::string::npos);
  auto busy = shell("while :; do :; done");
  busy.cpu_seconds = 1;
  EXPECT_NE(speak(busy, asking("a")).error().message.find("signal"), std::string::npos);
}

TEST(Voice, FolderOfTemporaryFilesThatCannotBeWritten_IsAFaultOfTheStorage) {
  auto program = shell("cat");
  program.temporary = "/absent";
  EXPECT_THROW(static_cast<void>(speak(program, asking("a"))), store::StoreError);
}

TEST(Voice, ListsItsNames_OrSaysThatItHasNone) {
  const auto listed = [](const std::string& line) {
    return list_voices(shell("cat > /dev/null;" + fake_header + "echo '" + line + "'; echo '{\"end\":true}'"));
  };
  const auto one = listed(R"({"voice":"pt+f2","label":"P","language":"pt-BR"})");
  ASSERT_TRUE(one.ok()) << one.error().message;
  ASSERT_EQ(one->size(), 1U);
  EXPECT_EQ(one->front().voice, "pt+f2");
  EXPECT_FALSE(listed(R"({"voice":"../x","language":"pt"})").ok());
  EXPECT_FALSE(listed(R"({"voice":"x","language":"p t"})").ok());
  EXPECT_FALSE(listed(R"({"voice":"x"})").ok());
  EXPECT_FALSE(list_voices(shell("cat > /dev/null; echo '{\"error\":\"no text\"}'")).ok());
  EXPECT_FALSE(list_voices(shell("cat > /dev/null;" + fake_header + R"(yes '{"voice":"x","language":"pt"}')")).ok());
}

TEST(Voice, TheExampleInPython_Speaks) {
  VoiceProgram program;
  program.command = {SEMBLANTE_SOURCE_DIR "/server/voice/examples/beeps.py"};
  const auto got = speak(program, asking("Olá, mundo!"));
  ASSERT_TRUE(got.ok()) << got.error().message;
  ASSERT_EQ(got->words.size(), 2U);
  EXPECT_EQ(got->words[1].range, (TextRange{5, 5}));
  EXPECT_GT(got->duration, 500.0);
}

#ifdef SEMBLANTE_VOICE_ESPEAK
const VoiceProgram espeak = {.command = {SEMBLANTE_VOICE_ESPEAK}};

TEST(VoiceEspeak, SaysPortuguese_WithStressWordsAndSentences) {
  const auto got = speak(espeak, asking("Olá, mundo! A mãe põe pão."));
  ASSERT_TRUE(got.ok()) << got.error().message;
  EXPECT_EQ(got->sample_rate, 22050U);
  ASSERT_EQ(got->words.size(), 6U);
  EXPECT_EQ(got->words[1].range, (TextRange{5, 5}));
  EXPECT_EQ(got->sentences.size(), 2U);
  ASSERT_GE(got->phonemes.size(), 3U);
  EXPECT_EQ(got->phonemes[0].symbol, "o");
  EXPECT_EQ(got->phonemes[0].stress, Stress::none);
  EXPECT_EQ(got->phonemes[2].symbol, "a");
  EXPECT_EQ(got->phonemes[2].stress, Stress::primary);
}

TEST(VoiceEspeak, SpeaksWithEachVoiceThatItLists) {
  const auto names = list_voices(espeak);
  ASSERT_TRUE(names.ok()) << names.error().message;
  int portuguese = 0, english = 0;
  for (const VoiceName& name : *names) {
    if (name.language != "pt-BR" && name.language != "en-US") continue;
    (name.language == "pt-BR" ? portuguese : english) += 1;
    auto request = asking("Oi.", name.language);
    request.voice = name.voice;
    EXPECT_TRUE(speak(espeak, request).ok()) << name.voice;
  }
  EXPECT_GE(portuguese, 4);
  EXPECT_GE(english, 4);
}

TEST(VoiceEspeak, SsmlProsody_ChangesTheRateOfItsSpan) {
  auto ssml = asking("<speak>Uma frase <prosody rate=\"50%\">bem comprida</prosody> aqui</speak>");
  ssml.ssml = true;
  auto plain = ssml;
  plain.text = "<speak>Uma frase bem comprida aqui</speak>";
  const auto slow = speak(espeak, ssml), usual = speak(espeak, plain);
  ASSERT_TRUE(slow.ok() && usual.ok());
  ASSERT_EQ(slow->words.size(), usual->words.size());
  EXPECT_NEAR(slow->words[2].time, usual->words[2].time, 100.0);
  EXPECT_GT(slow->words[4].time - slow->words[2].time, 1.3 * (usual->words[4].time - usual->words[2].time));
}

TEST(VoiceEspeak, IsTheSameEachTime_AndFasterAtRate) {
  const auto first = speak(espeak, asking("The boy bought pepper.", "en"));
  const auto again = speak(espeak, asking("The boy bought pepper.", "en"));
  ASSERT_TRUE(first.ok() && again.ok());
  EXPECT_EQ(first->samples, again->samples);
  auto fast = asking("The boy bought pepper.", "en");
  fast.rate = 1.8;
  EXPECT_LT(speak(espeak, fast)->duration, 0.75 * first->duration);
}

TEST(VoiceEspeak, TakesSsml_AndIsolatesItself) {
  auto ssml = asking("<speak>Hello <mark name=\"x\"/> there <break time=\"500ms\"/> again</speak>", "en");
  ssml.ssml = true;
  const auto got = speak(espeak, ssml);
  ASSERT_TRUE(got.ok()) << got.error().message;
  ASSERT_EQ(got->marks.size(), 1U);
  EXPECT_EQ(got->marks[0].name, "x");
  ssml.text = "<speak>a<break time=\"99999s\"/>b<break time=\"99999s\"/></speak>";
  const auto bomb = speak(espeak, ssml);
  if (bomb) {
    EXPECT_LE(bomb->duration, max_seconds * 1000.0);
  } else {
    EXPECT_NE(bomb.error().message.find("longer than"), std::string::npos) << bomb.error().message;
  }
}

TEST(VoiceEspeak, TextOfMoreThanTheLongestSound_IsRefusedForTheText) {
  std::string text;  // its last words begin after the longest sound, and events come before their samples
  for (int i = 0; i < 1200; ++i) text += "mark, name, x. ";
  const auto got = speak(espeak, asking(text, "en"));
  ASSERT_FALSE(got.ok());
  EXPECT_EQ(got.error().where, "text");
  EXPECT_EQ(got.error().message, "the sound is longer than 1200 s");
}

TEST(VoiceEspeak, WhatItDoesNotKnow_IsAnError) {
  const auto unknown = speak(espeak, asking("a", "xx")).error();
  EXPECT_EQ(unknown.code, ErrorCode::unsupported);
  EXPECT_EQ(unknown.where, "language");
  EXPECT_EQ(unknown.message, "there is no voice for xx");
}

TEST(VoiceEspeak, CharactersThatAreNoWords_AreTaken) {
  for (const char* const text :
       {"!!!???...", "\U0001D573\U0001D58A \u202E abc", "1234567890123456789012345678901234567890",
        "\U0001F1E7\U0001F1F7", "e\u0301\u0301\u0301", "\u200B"}) {
    const auto got = speak(espeak, asking(text));
    EXPECT_TRUE(got.ok()) << text << ": " << got.error().message;
  }
}

TEST(VoiceEspeak, WordsThatOverflowTheLibrary_AreSpoken) {
  for (const char* const piece : {"a.", "\u00E9.", "s'", "s\u2019", "a. ", "a&#46;", "a&#x2e;", "s&#39;", "s&apos;"}) {
    std::string text;
    for (int i = 0; i < 300; ++i) text += piece;
    for (const bool ssml : {false, true}) {
      auto request = asking((ssml ? "<speak>" : "") + text + (ssml ? "</speak>" : ""), "en");
      request.ssml = ssml;
      const auto got = speak(espeak, request);
      ASSERT_TRUE(got.ok()) << piece << ": " << got.error().message;
      EXPECT_GT(got->duration, 2'000.0) << piece;
    }
  }
  const auto short_one = speak(espeak, asking("Dr. A.B.C. isn't here", "en"));
  ASSERT_TRUE(short_one.ok());
  EXPECT_EQ(short_one->words.back().range.first, 17U);
}

// The library opens the dictionary of another alphabet or language at its first word, and crashes without.
TEST(VoiceEspeak, WordsOfOtherAlphabetsAndLanguages_AreSpokenByTheirDictionaries) {
  for (const char* const text :
       {"Ol\u00E1 \u041F\u0440\u0438\u0432\u0435\u0442", "\u0645\u0631\u062D\u0628\u0627", "\u05E9\u05DC\u05D5\u05DD",
        "\u3053\u3093\u306B\u3061\u306F", "\u4F60\u597D", "\u0939\u093F\u0928\u094D\u0926\u0940", "\uD55C\uAD6D\uC5B4",
        "\u0E44\u0E17\u0E22", "\u03A9\u03BC\u03AD\u03B3\u03B1"})
    for (const char* const language : {"pt-BR", "en", "de", "fr"}) {
      const auto got = speak(espeak, asking(text, language));
      EXPECT_TRUE(got.ok()) << language << " " << text << ": " << got.error().message;
    }
  const auto symbols = [](const Utterance& said) {
    std::vector<std::string> all;
    for (const auto& phoneme : said.phonemes) all.push_back(phoneme.symbol);
    return all;
  };
  const auto greek = speak(espeak, asking("\u03A9\u03BC\u03AD\u03B3\u03B1"));
  ASSERT_TRUE(greek.ok());
  EXPECT_THAT(symbols(*greek), ::testing::Contains("\u0263")) << "as a Greek says it";
  EXPECT_THAT(symbols(*greek), ::testing::Each(::testing::Not(::testing::StartsWith("("))))
      << "names of languages are no sounds";
  EXPECT_EQ(speak(espeak, asking("Ol\u00E1 \u041F\u0440\u0438\u0432\u0435\u0442 mundo"))->words.size(), 3U)
      << "spelled, it is one word";
  const auto english = speak(espeak, asking("le software", "fr"));
  ASSERT_TRUE(english.ok()) << english.error().message;
  EXPECT_THAT(symbols(*english), ::testing::Contains("\u0252")) << "a vowel of English, which French has not";
}
#endif

}  // namespace
}  // namespace semblante::voice
