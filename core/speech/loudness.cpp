#include "core/speech/loudness.h"

#include <algorithm>
#include <cmath>

namespace semblante {

Loudness::Loudness(const Utterance& utterance) {
  const double per_ms = utterance.sample_rate / 1000.0;
  const auto size = static_cast<double>(utterance.samples.size());
  const auto steps = static_cast<std::size_t>(std::ceil(std::max(0.0, utterance.duration) / step_ms));
  for (std::size_t step = 0; step < steps; ++step) {
    const double ms = static_cast<double>(step) * step_ms;
    const auto first = static_cast<std::size_t>(std::clamp((ms - window_ms / 2) * per_ms, 0.0, size));
    const auto last = static_cast<std::size_t>(std::clamp((ms + window_ms / 2) * per_ms, 0.0, size));
    double sum = 0.0;
    for (std::size_t i = first; i < last; ++i) {
      const double value = utterance.samples[i] / 32768.0;
      sum += value * value;
    }
    steps_.push_back(last > first ? std::sqrt(sum / static_cast<double>(last - first)) : 0.0);
  }
}

double Loudness::between(double begin, double end) const {
  if (steps_.empty()) return 0.0;
  const auto last = steps_.size() - 1;
  const auto from = std::min(last, static_cast<std::size_t>(std::max(0.0, begin / step_ms)));
  const auto to = std::clamp(static_cast<std::size_t>(std::max(0.0, end / step_ms)), from, last);
  double sum = 0.0;
  for (std::size_t i = from; i <= to; ++i) sum += steps_[i];
  return sum / static_cast<double>(to - from + 1);
}

Utterance with_silence(Utterance utterance, double before, double after) {
  const auto samples = [&](double ms) {
    return static_cast<std::size_t>(std::lround(ms * utterance.sample_rate / 1000.0));
  };
  utterance.samples.insert(utterance.samples.begin(), samples(before), 0);
  utterance.samples.insert(utterance.samples.end(), samples(after), 0);
  for (auto& phoneme : utterance.phonemes) phoneme.time += before;
  for (auto& word : utterance.words) word.time += before;
  for (auto& sentence : utterance.sentences) sentence.time += before;
  for (auto& mark : utterance.marks) mark.time += before;
  utterance.duration = 1000.0 * static_cast<double>(utterance.samples.size()) / utterance.sample_rate;
  return utterance;
}

}  // namespace semblante
