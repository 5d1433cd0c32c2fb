#include "core/speech/hearing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/listen/viseme_listener.h"
#include "core/speech/timelines/viseme_symbols.h"

namespace semblante {
namespace {

constexpr float least_probability = 1e-4F;  // surer of nothing than the network can be

/// The visemes of each step of the sound by their probabilities.
std::vector<std::array<float, VisemeNetwork::visemes>> probabilities_of(const Recording& sound) {
  VisemeListener listener(sound.sample_rate);
  std::vector<std::array<float, VisemeNetwork::visemes>> found;
  std::array<float, 1024> part{};
  // Silence behind the sound brings the last steps out.
  const std::size_t count = sound.samples.size();
  const std::size_t whole = count + static_cast<std::size_t>(VisemeListener::delay_ms * sound.sample_rate / 1000.0) + 1;
  const auto steps =
      static_cast<std::size_t>(1000.0 * static_cast<double>(count) / sound.sample_rate / VisemeListener::step_ms);
  found.reserve(steps);
  for (std::size_t first = 0; first < whole; first += part.size()) {
    const std::size_t here = std::min(part.size(), whole - first);
    for (std::size_t i = 0; i < here; ++i)
      part[i] = first + i < count ? static_cast<float>(sound.samples[first + i]) / 32768.0F : 0.0F;
    std::size_t taken = 0;
    for (std::size_t at = 0; at < here && found.size() < steps; at += taken)
      if (const auto heard = listener.push(std::span(part).subspan(at, here - at), taken))
        found.push_back(heard->probability);
  }
  return found;
}

/// The path of least cost through all visemes at all steps.
std::vector<std::uint8_t> likeliest(const std::vector<std::array<float, VisemeNetwork::visemes>>& probabilities) {
  std::array<double, VisemeNetwork::visemes> cost{};
  std::vector<std::array<std::uint8_t, VisemeNetwork::visemes>> before(probabilities.size());
  for (std::size_t n = 0; n < probabilities.size(); ++n) {
    const auto best = static_cast<std::size_t>(std::min_element(cost.begin(), cost.end()) - cost.begin());
    const double least = cost[best];
    for (std::size_t v = 0; v < VisemeNetwork::visemes; ++v) {
      const bool changes = least + change_cost < cost[v];
      before[n][v] = static_cast<std::uint8_t>(changes ? best : v);
      cost[v] = (changes ? least + change_cost : cost[v]) - least -
                std::log(static_cast<double>(std::max(least_probability, probabilities[n][v])));
    }
  }
  std::vector<std::uint8_t> path(probabilities.size());
  auto at = static_cast<std::size_t>(std::min_element(cost.begin(), cost.end()) - cost.begin());
  for (std::size_t n = path.size(); n-- > 0; at = before[n][at]) path[n] = static_cast<std::uint8_t>(at);
  return path;
}

}  // namespace

Utterance hear(Recording sound) {
  const auto path = likeliest(probabilities_of(sound));
  Utterance heard;
  heard.voice = "recording, heard by its sound";
  heard.sample_rate = sound.sample_rate;
  heard.duration = 1000.0 * static_cast<double>(sound.samples.size()) / sound.sample_rate;
  heard.samples = std::move(sound.samples);
  for (std::size_t n = 0; n < path.size(); ++n)
    if (n == 0 || path[n] != path[n - 1])
      heard.phonemes.push_back({VisemeListener::step_ms * static_cast<double>(n),
                                std::string(visemes::oculus.rows[path[n]].ipa), Stress::none});
  return heard;
}

}  // namespace semblante
