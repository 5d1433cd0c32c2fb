// What the listener hears of sound files, and what is said in them, for train.py: README.md.
//   semblante-listen-features OUT FILE.wav...
// Beside each FILE.wav lies FILE.txt, a label track; names with "_pt" are read by the table of Portuguese. OUT has for
// each file the number of its frames (int32), their features (float32, SoundFeatures::count each) and their visemes
// (int8; -1: of no viseme, or unknown).
#include <cstdio>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

#include "core/listen/sound_features.h"
#include "core/speech/sounds.h"
#include "core/speech/voice_timeline.h"
#include "core/speech/wav.h"

namespace semblante {
namespace {

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

constexpr std::int8_t unknown = -1;

std::vector<std::int8_t> visemes_of(const VoiceTimeline& timeline, const SoundTable& table, std::size_t frames) {
  std::vector<std::int8_t> visemes(frames, sounds::sil);
  const auto set = [&](double begin, double end, std::int8_t viseme) {
    for (std::size_t n = 0; n < frames; ++n) {
      const double ms = (static_cast<double>(n) + 0.5) * SoundFeatures::step_ms;
      if (begin <= ms && ms < end) visemes[n] = viseme;
    }
  };
  for (std::size_t i = 0; i < timeline.phonemes.size(); ++i) {
    const SpokenPhoneme& phoneme = timeline.phonemes[i];
    const double end = i + 1 < timeline.phonemes.size() ? timeline.phonemes[i + 1].time : timeline.end;
    if (phoneme.symbol.empty()) continue;
    if (phoneme.symbol == "?") {
      set(phoneme.time, end, unknown);
      continue;
    }
    const auto parts = sounds_of(table, phoneme.symbol);
    const double step = (end - phoneme.time) / static_cast<double>(parts.size());
    for (std::size_t k = 0; k < parts.size(); ++k)
      set(phoneme.time + step * static_cast<double>(k), phoneme.time + step * static_cast<double>(k + 1),
          parts[k].kind == SoundKind::throat ? unknown : static_cast<std::int8_t>(parts[k].viseme));
  }
  return visemes;
}

int run(std::span<char*> arguments) {
  std::ofstream out(arguments[1], std::ios::binary);
  for (char* const path : arguments.subspan(2)) {
    const std::string name = path;
    const auto sound = read_wav(bytes_of(name));
    const auto timeline =
        read_voice_timeline(bytes_of(name.substr(0, name.rfind('.')) + ".txt"), TimelineFormat::phonemes);
    if (!sound || !timeline) {
      std::cerr << name << ": " << (sound ? timeline.error() : sound.error()).message << "\n";
      return 1;
    }
    std::vector<float> samples(sound->samples.begin(), sound->samples.end());
    for (float& sample : samples) sample /= 32768.0F;
    SoundFeatures listener(sound->sample_rate);
    std::vector<float> features;
    std::int32_t frames = 0;
    for (std::size_t at = 0, taken = 0; at < samples.size(); at += taken)
      if (const auto frame = listener.push(std::span(samples).subspan(at), taken)) {
        features.insert(features.end(), frame->features.begin(), frame->features.end());
        ++frames;
      }
    const auto visemes = visemes_of(*timeline, sound_table(name.find("_pt") == std::string::npos ? "en" : "pt"),
                                    static_cast<std::size_t>(frames));
    out.write(reinterpret_cast<const char*>(&frames), sizeof(frames));
    out.write(reinterpret_cast<const char*>(features.data()),
              static_cast<std::streamsize>(features.size() * sizeof(float)));
    out.write(reinterpret_cast<const char*>(visemes.data()), static_cast<std::streamsize>(visemes.size()));
  }
  return out ? 0 : 1;
}

}  // namespace
}  // namespace semblante

int main(int count, char** arguments) {
  if (count < 3) {
    std::cerr << "usage: semblante-listen-features OUT FILE.wav...\n";
    return 2;
  }
  return semblante::run({arguments, static_cast<std::size_t>(count)});
}
