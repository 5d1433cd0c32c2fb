// How well a recording is aligned with its text (core/speech/alignment.h): against the times that another synthesizer,
// flite, gives of its own sounds, and by the mouth's step with the sound on people's recordings, those of Debian's
// pocketsphinx-testdata. Prints a line for each; parts that are not installed are left out.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/speech/alignment.h"
#include "core/speech/loudness.h"
#include "core/speech/sounds.h"
#include "server/voice/voice_process.h"
#include "tests/bench/speech/speech_figures.h"

namespace semblante::bench {
namespace {

namespace fs = std::filesystem;

constexpr const char* sentences[] = {
    "Maybe my baby brother Bob bumped the big piano.",
    "The quick brown fox jumps over the lazy dog, and five wizards vow to jump quickly.",
    "She thought about the measure of a small blue ocean.",
    "Please tell Peter to bring me some apples, a pumpkin pie, and a map of the campus.",
};

/// Phonemes of flite (the CMU set) in IPA.
const std::map<std::string, std::string> cmu = {
    {"aa", "ɑː"}, {"ae", "æ"},  {"ah", "ʌ"},  {"ao", "ɔː"}, {"aw", "aʊ"}, {"ax", "ə"},  {"ay", "aɪ"}, {"b", "b"},
    {"ch", "tʃ"}, {"d", "d"},   {"dh", "ð"},  {"eh", "ɛ"},  {"er", "ɜː"}, {"ey", "eɪ"}, {"f", "f"},   {"g", "ɡ"},
    {"hh", "h"},  {"ih", "ɪ"},  {"iy", "iː"}, {"jh", "dʒ"}, {"k", "k"},   {"l", "l"},   {"m", "m"},   {"n", "n"},
    {"ng", "ŋ"},  {"ow", "oʊ"}, {"oy", "ɔɪ"}, {"p", "p"},   {"r", "ɹ"},   {"s", "s"},   {"sh", "ʃ"},  {"t", "t"},
    {"th", "θ"},  {"uh", "ʊ"},  {"uw", "uː"}, {"v", "v"},   {"w", "w"},   {"y", "j"},   {"z", "z"},   {"zh", "ʒ"}};

/// A sound begins; 0 is silence.
struct Event {
  double time = 0.0;  ///< ms
  int viseme = 0;
};

int viseme_of(const std::string& ipa) { return ipa.empty() ? 0 : sounds_of(sound_table("en"), ipa).front().viseme; }
bool is_vowel(int viseme) { return viseme >= sounds::a; }

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
  std::string text(65'536, '\0');
  text.resize(pipe ? std::fread(text.data(), 1, text.size(), pipe.get()) : 0);
  return text;
}

/// "pau:0.224 m:0.252 ...": each with its end, s.
std::vector<Event> events_of_flite(const std::string& text) {
  std::vector<Event> events;
  double begin = 0.0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_of(" \n", at), text.size());
    const std::string pair = text.substr(at, end - at);
    at = end + 1;
    const std::size_t colon = pair.find(':');
    if (colon == std::string::npos) continue;
    const auto found = cmu.find(pair.substr(0, colon));
    events.push_back({begin, found == cmu.end() ? 0 : viseme_of(found->second)});
    begin = 1000.0 * std::atof(pair.c_str() + colon + 1);
  }
  return events;
}

std::vector<Event> events_of(const Utterance& said) {
  std::vector<Event> events;
  for (const SpokenPhoneme& phoneme : said.phonemes) events.push_back({phoneme.time, viseme_of(phoneme.symbol)});
  return events;
}

/// The pairs of one sound each, by the least edits between the two: dictionaries differ in how a word is said.
std::vector<std::pair<Event, Event>> pairs_of(const std::vector<Event>& a, const std::vector<Event>& b) {
  constexpr double alone = 1.1, most = 2.0;
  const auto cost = [](int x, int y) {
    if (x == y) return 0.0;
    if (x == 0 || y == 0) return 3.0;
    return is_vowel(x) == is_vowel(y) ? 1.0 : most;
  };
  std::vector<std::vector<double>> sums(a.size() + 1, std::vector<double>(b.size() + 1, 0.0));
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i + j == 0) continue;
      double best = 1e9;
      if (i > 0) best = std::min(best, sums[i - 1][j] + alone);
      if (j > 0) best = std::min(best, sums[i][j - 1] + alone);
      if (i > 0 && j > 0) best = std::min(best, sums[i - 1][j - 1] + cost(a[i - 1].viseme, b[j - 1].viseme));
      sums[i][j] = best;
    }
  std::vector<std::pair<Event, Event>> pairs;
  for (std::size_t i = a.size(), j = b.size(); i > 0 && j > 0;) {
    const double here = cost(a[i - 1].viseme, b[j - 1].viseme);
    if (sums[i][j] == sums[i - 1][j - 1] + here) {
      --i, --j;
      if (a[i].viseme != 0 && b[j].viseme != 0 && here < most) pairs.emplace_back(a[i], b[j]);
    } else if (sums[i][j] == sums[i - 1][j] + alone) {
      --i;
    } else {
      --j;
    }
  }
  return pairs;
}

int at(const std::vector<Event>& events, double ms) {
  const auto next = std::upper_bound(events.begin(), events.end(), ms,
                                     [](double time, const Event& event) { return time < event.time; });
  return next == events.begin() ? 0 : std::prev(next)->viseme;
}

Utterance spoken(const char* program, const std::string& text) {
  voice::VoiceRequest request;
  request.text = text;
  request.language = "en";
  auto said = voice::speak({.command = {program}}, request);
  if (!said) std::abort();
  return *std::move(said);
}

void against_flite(const char* program, const fs::path& folder) {
  std::printf("%-8s %9s %10s %10s %10s %10s %10s %10s\n", "voice", "phonemes", "median ms", "p90 ms", "< 50 ms %",
              "p b m, ms", "p90 ms", "frames %");
  for (const char* const name : {"awb", "rms", "slt"}) {
    std::vector<double> errors, lips;
    double right = 0.0, frames = 0.0;
    for (const char* const sentence : sentences) {
      const std::string file = (folder / "flite.wav").string();
      const auto truth = events_of_flite(output_of(std::string("flite -voice ") + name + " -psdur -t \"" + sentence +
                                                   "\" -o " + file + " 2>/dev/null"));
      const auto sound = read_wav(bytes_of(file));
      if (truth.empty() || !sound) continue;
      const auto aligned = align(spoken(program, sentence), *sound);
      if (!aligned) continue;
      const auto found = events_of(aligned->utterance);
      for (const auto& [expected, got] : pairs_of(truth, found)) {
        errors.push_back(std::abs(expected.time - got.time));
        if (expected.viseme == sounds::p_b_m) lips.push_back(errors.back());
      }
      for (double ms = 5.0; ms < aligned->utterance.duration; ms += 10.0, frames += 1.0)
        right += at(truth, ms) == at(found, ms) ? 1.0 : 0.0;
    }
    if (errors.empty() || lips.empty()) continue;
    std::sort(errors.begin(), errors.end());
    std::sort(lips.begin(), lips.end());
    const auto share = [](const std::vector<double>& values, std::size_t tenths) {
      return values[(values.size() - 1) * tenths / 10];
    };
    const auto near = std::lower_bound(errors.begin(), errors.end(), 50.0) - errors.begin();
    std::printf("%-8s %9zu %10.0f %10.0f %10.0f %10.0f %10.0f %10.0f\n", name, errors.size(), share(errors, 5),
                share(errors, 9), 100.0 * static_cast<double>(near) / static_cast<double>(errors.size()),
                share(lips, 5), share(lips, 9), 100.0 * right / frames);
  }
}

void on_people(const char* program) {
  const fs::path folder = "/usr/share/pocketsphinx/test/data/librivox";
  std::ifstream transcription(folder / "transcription");
  std::printf("\n%-48s %6s %9s %10s %12s\n", "recording", "s", "distance", "lag, ms", "correlation");
  for (std::string line; std::getline(transcription, line);) {
    // "<s> words </s> (name)"
    const std::size_t end = line.find(" </s>"), name = line.find('(');
    if (!line.starts_with("<s> ") || end == std::string::npos || name == std::string::npos) continue;
    const std::string file = line.substr(name + 1, line.find(')') - name - 1);
    const auto sound = read_wav(bytes_of(folder / (file + ".wav")));
    if (!sound) continue;
    const auto aligned = align(spoken(program, line.substr(4, end - 4)), *sound);
    if (!aligned) continue;
    const Utterance& said = aligned->utterance;
    const Step step = in_step(speakers().front(), said, "en", face_of(said, "en"));
    std::printf("%-48s %6.1f %9.2f %+10.0f %12.2f\n", file.c_str(), said.duration / 1000.0, aligned->distance, step.lag,
                step.correlation);
  }
}

}  // namespace
}  // namespace semblante::bench

int main() {
  const auto folder = std::filesystem::temp_directory_path();
  semblante::bench::against_flite(SEMBLANTE_VOICE_ESPEAK, folder);
  semblante::bench::on_people(SEMBLANTE_VOICE_ESPEAK);
}
