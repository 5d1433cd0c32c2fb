#include "core/listen/viseme_network.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace semblante {
namespace {

#include "core/listen/generated/viseme_network_weights.h"

/// output = scale (weights input) + bias, a row of weights for each output.
void layer(std::span<const std::int8_t> weights, std::span<const float> scales, std::span<const float> input,
           std::span<float> output) {
  const std::int8_t* row = weights.data();
  for (std::size_t o = 0; o < output.size(); ++o) {
    float sum = 0.0F;
    for (const float value : input) sum += static_cast<float>(*row++) * value;
    output[o] = sum * scales[o];
  }
}

void add(std::span<const float> biases, std::span<float> output) {
  for (std::size_t o = 0; o < output.size(); ++o) output[o] += biases[o];
}

float sigmoid(float x) { return 1.0F / (1.0F + std::exp(-x)); }
float hyperbolic_tangent(float x) { return 2.0F * sigmoid(2.0F * x) - 1.0F; }

constexpr std::size_t inputs = VisemeNetwork::stacked * SoundFeatures::count, units = VisemeNetwork::units;
static_assert(std::size(dense_weights) == inputs * units && std::size(dense_biases) == units);
static_assert(std::size(input_weights) == 3 * units * units && std::size(input_biases) == 3 * units);
static_assert(std::size(state_weights) == 3 * units * units && std::size(state_biases) == units);
static_assert(std::size(output_weights) == VisemeNetwork::visemes * units);

}  // namespace

std::array<float, VisemeNetwork::visemes> VisemeNetwork::step(std::span<const float, SoundFeatures::count> features) {
  std::move(input_.begin() + SoundFeatures::count, input_.end(), input_.begin());
  std::copy(features.begin(), features.end(), input_.end() - SoundFeatures::count);
  std::array<float, units> dense{};
  layer(dense_weights, dense_scales, input_, dense);
  add(dense_biases, dense);
  for (float& value : dense) value = std::max(0.0F, value);

  // Of each unit its reset gate, its update gate and its candidate, by the input and by the state before.
  std::array<float, 3 * units> by_input{}, by_state{};
  layer(input_weights, input_scales, dense, by_input);
  add(input_biases, by_input);
  layer(state_weights, state_scales, state_, by_state);
  for (std::size_t i = 0; i < units; ++i) {
    const float reset = sigmoid(by_input[i] + by_state[i]);
    const float update = sigmoid(by_input[units + i] + by_state[units + i]);
    const float candidate =
        hyperbolic_tangent(by_input[2 * units + i] + reset * (by_state[2 * units + i] + state_biases[i]));
    state_[i] = candidate + update * (state_[i] - candidate);
  }
  std::array<float, visemes> likely{};
  layer(output_weights, output_scales, state_, likely);
  add(output_biases, likely);
  const float most = *std::max_element(likely.begin(), likely.end());
  float sum = 0.0F;
  for (float& value : likely) sum += value = std::exp(value - most);
  for (float& value : likely) value /= sum;
  return likely;
}

}  // namespace semblante
