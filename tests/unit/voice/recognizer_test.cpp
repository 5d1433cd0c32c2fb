// What a recognizer hears in a recording without a text: fakes, and pocketsphinx on Debian's recordings of people.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/speech/speech.h"
#include "core/speech/wav.h"
#include "server/voice/speech_maker.h"
#include "server/voice/voice_process.h"

namespace semblante::voice {
namespace {

/// A recognizer that reads its sound and answers these lines.
VoiceProgram answering(const std::string& lines) {
  VoiceProgram program;
  program.command = {"/bin/sh", "-c",
                     "cat > /dev/null; echo '{\"protocol\":1,\"name\":\"fake\",\"sample_rate\":16000}'; " + lines};
  program.wall_seconds = 10;
  return program;
}

/// Half a second of silence.
std::string silent_file() {
  Utterance silence;
  silence.sample_rate = 16'000;
  silence.samples.resize(8'000);
  return wav(silence);
}

Result<Speech> heard_by(const VoiceProgram& recognizer, const std::string& file, const std::string& language = "en") {
  SaidRequest request;
  request.sound = file;
  request.language = language;
  request.recognizer = recognizer;
  return make_speech({}, request);
}

const std::string good_answer =
    R"(echo '{"heard":"hi ma","confidence":0.8}'; echo '{"sentence":0,"time":0}'; echo '{"word":[0,2],"time":50}';)"
    R"(echo '{"word":[3,2],"time":200}'; echo '{"phoneme":"","time":0}'; echo '{"phoneme":"h","time":50}';)"
    R"(echo '{"phoneme":"aɪ","time":80}'; echo '{"phoneme":"m","time":200}'; echo '{"phoneme":"ɑ","time":300}';)";

TEST(Recognizer, ItsWords_BecomeTextCaptionsAndMouths) {
  const auto speech = heard_by(answering(good_answer + R"(echo '{"end":true}')"), silent_file());
  ASSERT_TRUE(speech) << speech.error().message;
  EXPECT_EQ(speech->text, "hi ma");
  EXPECT_EQ(speech->utterance.voice, "recording, heard by fake");
  EXPECT_EQ(speech->utterance.samples.size(), 8'000U);
  EXPECT_EQ(speech->utterance.phonemes.size(), 5U);
  ASSERT_EQ(speech->warnings.size(), 1U);
  EXPECT_NE(speech->warnings[0].find("80 %"), std::string::npos) << speech->warnings[0];
  EXPECT_NE(web_vtt(speech->utterance, speech->text).find("hi <00:00:00.200>ma"), std::string::npos);
}

TEST(Recognizer, GetsTheSoundAndItsLanguage) {
  VoiceProgram program = answering("");
  program.command.back() =
      R"(head -n 1 | grep -q '"language":"en-US".*"sample_rate":16000' && echo '{"error":"has got it"}')";
  const auto speech = heard_by(program, silent_file(), "en-US");
  ASSERT_TRUE(speech);
  EXPECT_NE(speech->warnings.at(0).find("has got it"), std::string::npos) << speech->warnings[0];
}

TEST(Recognizer, ThatMisbehaves_LeavesTheMouthToTheSound) {
  const std::string end = R"(; echo '{"end":true}')";
  for (const std::string& lines :
       {std::string("exit 1"), std::string("kill -SEGV $$"), good_answer, good_answer + "yes",
        good_answer + R"(echo '{"word":[0,2],"time":1}')" + end, R"(echo '{"heard":"a\u0007b","confidence":1}')" + end,
        R"(echo '{"heard":"a","confidence":2}')" + end, R"(echo '{"heard":"a"}')" + end,
        R"(echo '{"heard":"a","confidence":1}'; echo '{"audio":"AAABAAIA"}')" + end,
        R"(echo '{"heard":"a","confidence":1}'; echo '{"phoneme":"a","time":1600}')" + end,
        R"(echo '{"heard":["a"],"confidence":1}')" + end, std::string("sleep 100")}) {
    VoiceProgram program = answering(lines);
    program.wall_seconds = 2;
    const auto speech = heard_by(program, silent_file());
    ASSERT_TRUE(speech) << lines;
    EXPECT_TRUE(speech->text.empty() && speech->utterance.words.empty()) << lines;
    EXPECT_NE(speech->warnings.at(0).find("the recognizer failed: "), std::string::npos) << lines;
    EXPECT_EQ(speech->utterance.voice, "recording, heard by its sound");
  }
  // Places beyond the text are none, and do no harm.
  const auto beyond = heard_by(
      answering(R"(echo '{"heard":"a","confidence":1}'; echo '{"word":[900,7],"time":1}')" + end), silent_file());
  ASSERT_TRUE(beyond);
  EXPECT_TRUE(web_vtt(beyond->utterance, beyond->text).starts_with("WEBVTT"));
}

TEST(Recognizer, OfAnotherLanguage_OrNotSure_OrOfTooMuchSound_IsNotUsed) {
  const std::string end = R"(; echo '{"end":true}')";
  const auto warning = [](const Result<Speech>& speech) {
    return speech && speech->text.empty() ? speech->warnings.at(0) : std::string("it is used");
  };
  EXPECT_TRUE(warning(heard_by(answering(R"(echo '{"error":"no","of":"language"}')"), silent_file(), "pt-BR"))
                  .ends_with("no captions"));
  EXPECT_NE(warning(heard_by(answering(R"(echo '{"heard":"a","confidence":0.1}')" + end), silent_file())).find("sure"),
            std::string::npos);
  EXPECT_NE(warning(heard_by(answering(R"(echo '{"heard":"","confidence":0}')" + end), silent_file())).find("sure"),
            std::string::npos);
  Utterance minutes;
  minutes.sample_rate = 8'000;
  minutes.samples.resize(8'000 * 61);
  EXPECT_NE(warning(heard_by(answering(good_answer + end), wav(minutes))).find("up to 60 s"), std::string::npos);
}

#ifdef SEMBLANTE_RECOGNIZER

const VoiceProgram pocketsphinx = recognizer_at(SEMBLANTE_RECOGNIZER);

/// A recording of Debian's pocketsphinx-testdata; empty where the package or the model is not installed.
std::string recording(const std::string& name) {
  if (!std::filesystem::exists("/usr/share/pocketsphinx/model/en-us/en-us.lm.bin")) return {};
  std::ifstream in("/usr/share/pocketsphinx/test/data/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(RecognizerPocketsphinx, HearsEnglishOfPeople) {
  const std::string file = recording("cards/003.wav");
  if (file.empty()) GTEST_SKIP() << "pocketsphinx-testdata and pocketsphinx-en-us are not installed";
  const auto speech = heard_by(pocketsphinx, file);
  ASSERT_TRUE(speech) << speech.error().message;
  EXPECT_EQ(speech->text, "seven of clubs") << speech->warnings[0];
  EXPECT_EQ(speech->utterance.voice, "recording, heard by pocketsphinx");
  std::string sounds;
  double last = -1.0;
  for (const SpokenPhoneme& phoneme : speech->utterance.phonemes) {
    sounds += phoneme.symbol;
    EXPECT_GT(phoneme.time, last);
    last = phoneme.time;
  }
  EXPECT_EQ(sounds, "sɛvʌnʌvklʌbz");
  ASSERT_EQ(speech->utterance.words.size(), 3U);
  // Each word begins with its first sound.
  for (const auto& [word, symbol] : {std::pair{0, "s"}, std::pair{1, "ʌ"}, std::pair{2, "k"}}) {
    const double time = speech->utterance.words[static_cast<std::size_t>(word)].time;
    EXPECT_TRUE(std::any_of(
        speech->utterance.phonemes.begin(), speech->utterance.phonemes.end(),
        [&, symbol = symbol](const auto& phoneme) { return phoneme.time == time && phoneme.symbol == symbol; }))
        << word;
  }
  EXPECT_EQ(heard_by(pocketsphinx, file)->performance.cues.size(), speech->performance.cues.size())
      << "it is the same each time";
}

TEST(RecognizerPocketsphinx, OtherLanguages_Noise_AndHostileSounds_LeaveTheMouthToTheSound) {
  const std::string file = recording("cards/003.wav");
  if (file.empty()) GTEST_SKIP() << "pocketsphinx-testdata and pocketsphinx-en-us are not installed";
  EXPECT_TRUE(heard_by(pocketsphinx, file, "pt-BR")->warnings[0].ends_with("no captions"));
  Utterance noise;
  noise.sample_rate = 8'000;
  std::uint32_t state = 1;
  for (int i = 0; i < 16'000; ++i) {
    state = state * 1'664'525U + 1'013'904'223U;
    noise.samples.push_back(static_cast<std::int16_t>(state >> 16U));
  }
  for (const std::size_t length : {std::size_t{1}, std::size_t{100}, std::size_t{16'000}}) {
    noise.samples.resize(length);
    const auto speech = heard_by(pocketsphinx, wav(noise));
    ASSERT_TRUE(speech) << length;
    EXPECT_EQ(speech->utterance.voice, "recording, heard by its sound") << length << speech->text;
  }
}

#endif

}  // namespace
}  // namespace semblante::voice
