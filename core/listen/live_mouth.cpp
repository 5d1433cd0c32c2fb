#include "core/listen/live_mouth.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace semblante {
namespace {

constexpr std::size_t p_b_m = 1, first_vowel = 10;
/// Of the way to the newest probabilities, each step: steps * (1 - share) / share is the delay.
constexpr float share = static_cast<float>(VisemeListener::step_ms / (VisemeListener::step_ms + LiveMouth::delay_ms));
// Amplitude to the power 0.4, as for speech with a text (core/speech/segments.cpp), of the usual one of vowels.
constexpr float power_of_level = 0.4F * std::numbers::ln10_v<float> / 20.0F, least_open = 0.6F;
constexpr float louder = 0.05F, quieter = 0.005F;  // of the usual level: shares of the way, each step of a vowel

}  // namespace

const LiveMouth::Weights& LiveMouth::follow(const VisemeListener::Heard& heard) {
  float vowels = 0.0F;
  for (std::size_t v = 0; v < likely_.size(); ++v) {
    const bool closes = v == p_b_m && heard.probability[v] > likely_[v];
    likely_[v] += (closes ? 1.0F : share) * (heard.probability[v] - likely_[v]);
    if (v >= first_vowel) vowels += heard.probability[v];
  }
  if (vowels > 0.5F) {
    if (usual_ == 0.0F) usual_ = heard.level;
    usual_ += (heard.level > usual_ ? louder : quieter) * (heard.level - usual_);
  }
  const float open = std::clamp(std::exp((heard.level - usual_) * power_of_level), least_open, 1.0F);
  float sum = 0.0F;
  for (const float likely : likely_) sum += likely;  // lips that close at once make it more than 1
  weights_[0] = 1.0F;
  for (std::size_t v = 1; v < weights_.size(); ++v) {
    weights_[v] = likely_[v] / sum * (v >= first_vowel ? open : 1.0F);
    weights_[0] -= weights_[v];
  }
  weights_[0] = std::max(0.0F, weights_[0]);
  return weights_;
}

}  // namespace semblante
