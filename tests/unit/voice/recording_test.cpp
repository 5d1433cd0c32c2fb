// Somebody's recording of a text: its file, and the face that says it.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>
#include <tuple>
#include <unistd.h>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#ifdef SEMBLANTE_SOUND
#include <sndfile.h>
#endif

#include "core/speech/loudness.h"
#include "core/speech/segments.h"
#include "core/speech/sounds.h"
#include "server/voice/speech_maker.h"
#include "server/voice/voice_process.h"

namespace semblante::voice {
namespace {

#ifdef SEMBLANTE_SOUND

const VoiceProgram reader = {.command = {SEMBLANTE_SOUND}};

/// 1.5 s of 440 Hz on two channels as a file of this format of libsndfile.
std::string tone_file(int format, int rate) {
  // Tests of this program run at the same time, each in a process of its own.
  const std::string path = testing::TempDir() + "semblante-tone-" + std::to_string(::getpid());
  SF_INFO info{};
  info.samplerate = rate;
  info.channels = 2;
  info.format = format;
  SNDFILE* const file = sf_open(path.c_str(), SFM_WRITE, &info);
  if (file == nullptr) return {};
  std::vector<float> samples;
  for (int i = 0; i < rate * 3 / 2; ++i) {
    const auto value = static_cast<float>(0.5 * std::sin(2.0 * std::numbers::pi * 440.0 * i / rate));
    samples.insert(samples.end(), {value, value});
  }
  sf_writef_float(file, samples.data(), rate * 3 / 2);
  sf_close(file);
  std::ifstream in(path, std::ios::binary);
  std::string content{std::istreambuf_iterator<char>(in), {}};
  std::filesystem::remove(path);
  return content;
}

TEST(SoundReader, ReadsTheFilesThatPeopleHave) {
  for (const auto& [name, format, rate, heard] :
       {std::tuple{"FLAC", SF_FORMAT_FLAC | SF_FORMAT_PCM_24, 96'000, 48'000U},
        std::tuple{"Ogg/Vorbis", SF_FORMAT_OGG | SF_FORMAT_VORBIS, 44'100, 44'100U},
        std::tuple{"Ogg/Opus", SF_FORMAT_OGG | SF_FORMAT_OPUS, 48'000, 48'000U},
        std::tuple{"MP3", SF_FORMAT_MPEG | SF_FORMAT_MPEG_LAYER_III, 44'100, 44'100U},
        std::tuple{"AIFF", SF_FORMAT_AIFF | SF_FORMAT_PCM_16, 4'000, 8'000U}}) {
    const std::string file = tone_file(format, rate);
    ASSERT_FALSE(file.empty()) << name;
    const auto sound = read_sound(reader, file);
    ASSERT_TRUE(sound) << name << ": " << sound.error().message;
    EXPECT_EQ(sound->sample_rate, heard) << name;
    EXPECT_NEAR(static_cast<double>(sound->samples.size()) / heard, 1.5, 0.06) << name;
    int rises = 0;
    for (std::size_t i = heard / 4 + 1; i < heard / 4 + heard; ++i)  // one second
      rises += sound->samples[i - 1] < 0 && sound->samples[i] >= 0 ? 1 : 0;
    EXPECT_NEAR(rises, 440, 2) << name;
    const auto cut = read_sound(reader, std::string_view(file).substr(0, file.size() / 2));
    if (cut) {
      EXPECT_LT(cut->samples.size(), sound->samples.size()) << name;
    }
  }
}

TEST(SoundReader, OggStreamsOneAfterAnother_AreOneSound) {
  const std::string opus = tone_file(SF_FORMAT_OGG | SF_FORMAT_OPUS, 48'000);
  const std::string vorbis = tone_file(SF_FORMAT_OGG | SF_FORMAT_VORBIS, 44'100);
  const auto sound = read_sound(reader, opus + vorbis + opus);
  ASSERT_TRUE(sound) << sound.error().message;
  EXPECT_EQ(sound->sample_rate, 48'000U);
  EXPECT_NEAR(static_cast<double>(sound->samples.size()) / 48'000, 4.5, 0.18);
  const auto cut = read_sound(reader, opus + vorbis.substr(0, 40));
  ASSERT_TRUE(cut) << cut.error().message;
  EXPECT_NEAR(static_cast<double>(cut->samples.size()) / 48'000, 1.5, 0.06);
}

TEST(SoundReader, OfASmallFile_NeedsLittleMemory) {
  VoiceProgram small = reader;
  small.memory_bytes = std::uint64_t{200} << 20U;  // less than the largest file
  EXPECT_TRUE(read_sound(small, tone_file(SF_FORMAT_FLAC | SF_FORMAT_PCM_16, 48'000)));
}

TEST(SoundReader, OtherBytes_AreAnError) {
  EXPECT_NE(read_sound(reader, "no sound").error().message.find("is no sound file"), std::string::npos);
  EXPECT_FALSE(read_sound(reader, ""));
  EXPECT_FALSE(read_sound(reader, std::string("fLaC") + std::string(5000, '\xFF')));
  EXPECT_FALSE(read_sound(reader, std::string("OggS") + std::string(5000, '\0')));
}

#endif

TEST(SoundReader, Missing_LeavesWav) {
  const auto refused = read_sound({}, "fLaC").error();
  EXPECT_EQ(refused.code, ErrorCode::unsupported);
  EXPECT_NE(refused.message.find("semblante-sound"), std::string::npos);
  Utterance silence;
  silence.sample_rate = 8'000;
  silence.samples.resize(80);
  EXPECT_EQ(read_sound({}, wav(silence))->samples.size(), 80U);
}

TEST(SoundReader, ThatTakesTooLong_IsNoFaultOfTheFile_ThatCrashesIs) {
  const auto by = [](const char* line) {
    VoiceProgram program;
    program.command = {"/bin/sh", "-c", line};
    program.wall_seconds = 1;
    return read_sound(program, "fLaC").error();
  };
  const Error slow = by("sleep 20"), crashed = by("cat > /dev/null; kill -SEGV $$");
  EXPECT_EQ(slow.code, ErrorCode::io);
  EXPECT_EQ(slow.message, "semblante-sound took longer than 1 s");
  EXPECT_EQ(crashed.code, ErrorCode::malformed);
  EXPECT_EQ(by("cat > /dev/null; echo nonsense; sleep 20").code, ErrorCode::malformed);
  EXPECT_EQ(read_sound({.command = {"/nonexistent"}}, "fLaC").error().code, ErrorCode::io);
}

#ifdef SEMBLANTE_VOICE_ESPEAK

const VoiceProgram own_voice = {.command = {SEMBLANTE_VOICE_ESPEAK}};

/// The text said by another throat, slower: its own times are the truth.
struct Reading {
  const char* text;
  const char* language;
  const char* voice;
};
const std::vector<Reading> readings = {{"Maybe my brother bought the big piano, and a pepper plant.", "en", "en-us+f2"},
                                       {"Minha mãe comprou um pão bom, e o bebê bebeu água.", "pt-BR", "pt-br+m3"}};

TEST(RecordingOfSpeech, WithItsText_IsSaidWhenItIsSaid) {
  for (const auto& [text, language, voice] : readings) {
    VoiceRequest slower;
    slower.text = text;
    slower.language = language;
    slower.voice = voice;
    slower.rate = 0.8;
    slower.pitch = 1.3;
    const auto truth = speak(own_voice, slower);
    ASSERT_TRUE(truth) << truth.error().message;
    const std::string file = wav(*truth);
    SaidRequest request;
    request.sound = file;
    request.text = std::string("[joy]") + text + "[/joy]";
    request.language = language;
    const auto speech = make_speech(own_voice, request);
    ASSERT_TRUE(speech) << speech.error().message;
    EXPECT_TRUE(speech->warnings.empty());
    EXPECT_EQ(speech->text, text);
    EXPECT_EQ(speech->utterance.samples, truth->samples);
    EXPECT_EQ(speech->utterance.words.size(), truth->words.size());
    std::vector<double> begins, expected;
    for (const auto& phoneme : speech->utterance.phonemes)
      if (!phoneme.symbol.empty()) begins.push_back(phoneme.time);
    for (const auto& phoneme : truth->phonemes)
      if (!phoneme.symbol.empty()) expected.push_back(phoneme.time);
    ASSERT_EQ(begins.size(), expected.size());
    std::vector<double> errors;
    for (std::size_t i = 0; i < begins.size(); ++i) errors.push_back(std::abs(begins[i] - expected[i]));
    std::sort(errors.begin(), errors.end());
    EXPECT_LT(errors[errors.size() / 2], 20.0) << text;
    EXPECT_LT(errors[errors.size() * 9 / 10], 60.0) << text;
  }
}

/// The viseme that is said at each 10 ms: -1 where the mouth is that of its neighbours.
std::vector<int> visemes_of(const Utterance& said, const char* language) {
  std::vector<int> visemes;
  const Loudness loudness(said);
  for (const Segment& segment : segments_of(said, sound_table(language), loudness))
    while (5.0 + 10.0 * static_cast<double>(visemes.size()) < segment.end)
      visemes.push_back(segment.sound.kind == SoundKind::throat ? -1 : segment.sound.viseme);
  return visemes;
}

TEST(RecordingOfSpeech, WithoutItsText_IsHeard) {
  for (const auto& [text, language, voice] : readings) {
    VoiceRequest wish;
    wish.text = text;
    wish.language = language;
    wish.voice = voice;
    const auto truth = speak(own_voice, wish);
    ASSERT_TRUE(truth) << truth.error().message;
    const std::string file = wav(*truth);
    SaidRequest request;
    request.sound = file;
    request.language = "und";
    request.expression = 1;
    const auto speech = make_speech({}, request);  // no voice is needed
    ASSERT_TRUE(speech) << speech.error().message;
    EXPECT_EQ(speech->text, "");
    EXPECT_TRUE(speech->utterance.words.empty());
    EXPECT_EQ(speech->utterance.samples, truth->samples);
    EXPECT_EQ(speech->warnings.size(), 1U);
    EXPECT_TRUE(std::any_of(speech->performance.cues.begin(), speech->performance.cues.end(), [](const Cue& cue) {
      const auto* const expression = std::get_if<ExpressionTarget>(&cue.target);
      return expression != nullptr && expression->expression == 1;
    })) << "the emotion of the request is shown";
    const auto heard = visemes_of(speech->utterance, "en"), said = visemes_of(*truth, language);
    double right = 0.0, frames = 0.0, lips = 0.0, closed = 0.0;
    for (std::size_t n = 0; n < std::min(heard.size(), said.size()); ++n) {
      if (said[n] < 0) continue;
      frames += 1.0;
      right += heard[n] == said[n] ? 1.0 : 0.0;
    }
    EXPECT_GT(right / frames, 0.65) << text;         // by chance: 0.07
    for (std::size_t n = 0; n < said.size(); ++n) {  // each p, b, m: closed within it or two frames beside it
      if (said[n] != sounds::p_b_m || (n > 0 && said[n - 1] == sounds::p_b_m)) continue;
      std::size_t end = n;
      while (end < said.size() && said[end] == sounds::p_b_m) ++end;
      lips += 1.0;
      for (std::size_t k = n < 2 ? 0 : n - 2; k < std::min(end + 2, heard.size()); ++k)
        if (heard[k] == sounds::p_b_m) {
          closed += 1.0;
          break;
        }
    }
    EXPECT_GT(closed / lips, 0.35) << text;  // closed lips are silent, and this voice has little before and after them
  }
}

TEST(RecordingOfSpeech, OfSilence_HasAMouthAtRest) {
  Utterance silence;
  silence.sample_rate = 16'000;
  silence.samples.resize(32'000);
  const std::string file = wav(silence);
  SaidRequest request;
  request.sound = file;
  request.language = "und";
  const auto speech = make_speech({}, request);
  ASSERT_TRUE(speech) << speech.error().message;
  ASSERT_EQ(speech->utterance.phonemes.size(), 1U);
  EXPECT_EQ(speech->utterance.phonemes.front().symbol, "");
}

TEST(RecordingOfSpeech, ErrorsSayWhere) {
  Utterance silence;
  silence.sample_rate = 8'000;
  silence.samples.resize(16'000);
  const std::string silent = wav(silence);
  SaidRequest request;
  request.sound = silent;
  request.language = "en";
  request.text = "Hello.";
  EXPECT_EQ(make_speech(own_voice, request).error().where, "audio");
  request.text = std::string(1, '\x01');
  EXPECT_EQ(make_speech(own_voice, request).error().where, "text");
  request.text = "Hello.";
  request.sound = "what is this?";
  EXPECT_EQ(make_speech(own_voice, request).error().where, "audio");
  request.language = "not a tag";
  EXPECT_EQ(make_speech(own_voice, request).error().where, "language");
}

#endif

}  // namespace
}  // namespace semblante::voice
