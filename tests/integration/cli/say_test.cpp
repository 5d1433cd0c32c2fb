// `semblante say`: a text to a face, its sound and its captions.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/performance/performance.h"
#include "protocol/cpp/performance_document.h"
#include "tests/integration/cli/program.h"

namespace semblante::test {
namespace {

constexpr const char* beeps = SEMBLANTE_SOURCE_DIR "/server/voice/examples/beeps.py";

TEST(Say, AnyVoice_GivesAPerformanceSoundAndCaptions) {
  const Workspace work;
  const auto done =
      run_semblante({"say", "Mamma mia! :)", "--language", "en", "--voice-program", beeps, "--out", work.path("a.json"),
                     "--audio", work.path("a.wav"), "--captions", work.path("a.vtt")});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const auto script = read_performance(read_text(work.path("a.json")));
  ASSERT_TRUE(script.ok()) << script.error().message;
  const auto face = Performance::compile(*script);
  ASSERT_TRUE(face.ok()) << face.error().where << face.error().message;
  const std::string sound = read_text(work.path("a.wav"));
  EXPECT_EQ(sound.substr(0, 4), "RIFF");
  // One clock: the face is as long as the sound.
  EXPECT_NEAR(face->duration(), static_cast<double>(sound.size() - 44) / 16.0, 50.0);
  bool smiles = false;
  for (double ms = 0; ms < face->duration(); ms += 40) smiles |= face->frame_at(ms).expression1 == 1;
  EXPECT_TRUE(smiles);
  const std::string captions = read_text(work.path("a.vtt"));
  EXPECT_EQ(captions.find("WEBVTT\n\n00:00:00.120 --> 00:00:0"), 0U) << captions;
  EXPECT_NE(captions.find("\nMamma <00:00:00.7"), std::string::npos) << captions;
  EXPECT_NE(captions.find(">mia!\n"), std::string::npos) << captions;
}

TEST(Say, TimelineOfAnotherVoice_NeedsNoVoice) {
  const Workspace work;
  const auto hi = work.write("hi.tsv", "0.00\tX\n0.50\tA\n0.60\tD\n0.90\tX\n1.50\tX\n");
  const auto done =
      run_semblante({"say", "--timeline", hi, "--language", "en", "--out", work.path("a.json"), "--emotion", "joy"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_NE(done.err.find("no captions"), std::string::npos) << done.err;
  const auto script = read_performance(read_text(work.path("a.json")));
  ASSERT_TRUE(script.ok());
  const auto face = Performance::compile(*script);
  ASSERT_TRUE(face.ok());
  const auto closed = face->frame_at(550);
  EXPECT_TRUE(closed.viseme1 == 1 || closed.viseme2 == 1) << "at the shape A";
  EXPECT_EQ(face->frame_at(700).expression1, 1) << "joy";

  const auto fails = [&](std::vector<std::string> arguments, const char* reason) {
    arguments.insert(arguments.begin(), {"say", "--language", "en", "--out", work.path("b.json")});
    const auto refused = run_semblante(arguments);
    EXPECT_NE(refused.exit_code, 0) << reason;
    EXPECT_NE(refused.err.find(reason), std::string::npos) << refused.err;
  };
  fails({}, "give a text, --timeline or --sound");
  fails({"--timeline", work.write("bad.tsv", "0.0\tX\n0.1\tQ\n")}, "line 2");
  fails({"--timeline", hi, "--audio", work.path("b.wav")}, "--audio-in");
  fails({"--timeline", hi, "--audio-in", hi}, "audio: is no ");
  fails({"--timeline", hi, "--timeline-format", "smoke"}, "--timeline-format");
}

TEST(Say, ARecordingOfTheText_IsSaidOnItsClock) {
  const Workspace work;
  ASSERT_EQ(run_semblante({"say", "Mamma mia!", "--language", "en", "--voice-program", beeps, "--rate", "0.8",
                           "--audio", work.path("said.wav")})
                .exit_code,
            0);
  const auto done =
      run_semblante({"say", "[joy]Mamma mia![/joy]", "--language", "en", "--voice-program", beeps, "--sound",
                     work.path("said.wav"), "--out", work.path("a.json"), "--audio", work.path("a.wav")});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(read_text(work.path("a.wav")), read_text(work.path("said.wav"))) << "the recording as it is";
  const auto script = read_performance(read_text(work.path("a.json")));
  ASSERT_TRUE(script.ok());
  EXPECT_TRUE(Performance::compile(*script).ok());
}

TEST(Say, ARecordingWithoutItsText_IsHeard) {
  const Workspace work;
  ASSERT_EQ(run_semblante(
                {"say", "Mamma mia!", "--language", "en", "--voice-program", beeps, "--audio", work.path("said.wav")})
                .exit_code,
            0);
  const auto done = run_semblante({"say", "--sound", work.path("said.wav"), "--emotion", "joy", "--voice-program",
                                   "/nonexistent", "--out", work.path("a.json"), "--captions", work.path("a.vtt")});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_NE(done.err.find("no captions"), std::string::npos) << done.err;
  EXPECT_EQ(read_text(work.path("a.vtt")), "WEBVTT\n");
  const auto script = read_performance(read_text(work.path("a.json")));
  ASSERT_TRUE(script.ok());
  EXPECT_TRUE(Performance::compile(*script).ok());
}

TEST(Say, ListsVoices) {
  const auto done = run_semblante({"say", "--list-voices", "--voice-program", beeps});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(done.out, "beeps\ten\tmeasured\tTones\n");
  EXPECT_EQ(run_semblante({"say", "--list-voices", "--language", "pt", "--voice-program", beeps}).out, "");
}

TEST(Say, WithoutAVoiceOrWithHostileText_SaysWhatIsWrong) {
  const Workspace work;
  const auto fails = [&](std::vector<std::string> arguments, const char* reason) {
    arguments.insert(arguments.begin(), "say");
    arguments.insert(arguments.end(), {"--language", "en", "--out", work.path("a.json")});
    const auto done = run_semblante(arguments);
    EXPECT_NE(done.exit_code, 0) << reason;
    EXPECT_NE(done.err.find(reason), std::string::npos) << done.err;
  };
  fails({"a", "--voice-program", "/nonexistent"}, "cannot start");
  fails({"a\x02", "--voice-program", beeps}, "control character");
  fails({std::string(20'001, 'a'), "--voice-program", beeps}, "longer than");
  fails({"[joy]a", "--voice-program", beeps}, "not closed");
  fails({"<!DOCTYPE x>", "--ssml", "--voice-program", beeps}, "declarations");
  fails({"a", "--rate", "9", "--voice-program", beeps}, "--rate");
}

#ifdef SEMBLANTE_VOICE_ESPEAK
TEST(Say, InPortuguese_IsAnAnimatedHead) {
  const Workspace work;
  const auto done = run_semblante({"say", "Olá!", "--language", "pt-BR", "--voice-program", SEMBLANTE_VOICE_ESPEAK,
                                   "--out", work.path("a.json"), "--seed", "7"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const auto again = run_semblante({"say", "Olá!", "--language", "pt-BR", "--voice-program", SEMBLANTE_VOICE_ESPEAK,
                                    "--out", work.path("b.json"), "--seed", "7"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(read_text(work.path("a.json")), read_text(work.path("b.json")));
  EXPECT_NE(read_text(work.path("a.json")).find("\"a\""), std::string::npos);
}
#endif

}  // namespace
}  // namespace semblante::test
