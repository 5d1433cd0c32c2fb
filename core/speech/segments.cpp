#include "core/speech/segments.h"

#include <algorithm>
#include <cmath>

namespace semblante {
namespace {

constexpr Sound silence = {"", sounds::sil, sounds::sil, 1.0F, 1.0F, SoundKind::silence};
constexpr double primary = 1.08, secondary = 1.0, unstressed = 0.88;
constexpr double loudness_power = 0.4, least_loud = 0.75, most_loud = 1.15;

void add(std::vector<Segment>& segments, Segment segment) {
  if (segment.end <= segment.begin) return;
  if (segment.is_silence() && !segments.empty() && segments.back().is_silence())
    segments.back().end = segment.end;
  else
    segments.push_back(segment);
}

/// How loud the stronger vowels of an utterance are: what `strength` 1 means.
double usual_loudness(std::span<const Segment> segments, const Loudness& loudness) {
  std::vector<double> values;
  for (const Segment& segment : segments)
    if (segment.is_vowel()) values.push_back(loudness.between(segment.begin, segment.end));
  if (values.empty()) return 0.0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 2 / 3);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

std::vector<Segment> segments_of(const Utterance& utterance, const SoundTable& table, const Loudness& loudness) {
  std::vector<Segment> segments;
  const auto& phonemes = utterance.phonemes;
  const double first = phonemes.empty() ? utterance.duration : std::min(utterance.duration, phonemes.front().time);
  add(segments, {0.0, first, silence});
  for (std::size_t i = 0; i < phonemes.size(); ++i) {
    const double begin = std::min(utterance.duration, phonemes[i].time);
    const double end =
        i + 1 < phonemes.size() ? std::min(utterance.duration, phonemes[i + 1].time) : utterance.duration;
    if (phonemes[i].symbol.empty()) {
      add(segments, {begin, end, silence});
      continue;
    }
    const auto parts = sounds_of(table, phonemes[i].symbol);
    const double step = (end - begin) / static_cast<double>(parts.size());
    for (std::size_t k = 0; k < parts.size(); ++k)
      add(segments, {begin + step * static_cast<double>(k), begin + step * static_cast<double>(k + 1), parts[k],
                     phonemes[i].stress});
  }
  const double usual = usual_loudness(segments, loudness);
  for (Segment& segment : segments) {
    if (!segment.is_vowel()) continue;
    const double stress = segment.stress == Stress::primary     ? primary
                          : segment.stress == Stress::secondary ? secondary
                                                                : unstressed;
    const double loud = usual > 0.0 ? loudness.between(segment.begin, segment.end) / usual : 1.0;
    segment.strength = stress * std::clamp(std::pow(loud, loudness_power), least_loud, most_loud);
  }
  return segments;
}

std::vector<Phrase> phrases_of(std::span<const Segment> segments) {
  std::vector<Phrase> phrases;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (segments[i].is_silence()) continue;
    if (i == 0 || segments[i - 1].is_silence()) phrases.push_back({i, i});
    phrases.back().last = i + 1;
  }
  return phrases;
}

}  // namespace semblante
