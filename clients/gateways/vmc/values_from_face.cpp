#include <algorithm>

#include "clients/gateways/vmc/turn.h"
#include "clients/gateways/vmc/values.h"
#include "core/bridges/arkit_shapes.h"
#include "core/tables/mpeg4.h"

namespace semblante::vmc {
namespace {

double angle(const semblante_frame& frame, std::size_t fap) {
  return static_cast<double>(frame.fap[fap]) * mpeg4::radians_per_au;
}

/// Removes an expression from FAP 2 and returns its intensity.
float take_expression(semblante_frame& frame, std::uint8_t expression) {
  float amount = 0.0F;
  const auto take = [&](std::uint8_t select, std::uint8_t& intensity) {
    if (select != expression) return;
    amount += static_cast<float>(intensity) / SEMBLANTE_BLEND_MAX;
    intensity = 0;
  };
  take(frame.expression1, frame.intensity1);
  take(frame.expression2, frame.intensity2);
  return std::min(amount, 1.0F);
}

bool is_gaze(const VrmPreset& preset) {
  return std::any_of(preset.arkit.begin(), preset.arkit.end(), [](std::size_t shape) {
    return std::any_of(std::begin(arkit::eyes), std::end(arkit::eyes), [shape](const arkit::Eye& eye) {
      return shape == eye.look_down || shape == eye.look_in || shape == eye.look_out || shape == eye.look_up;
    });
  });
}

float mean_of(const ArkitCoefficients& coefficients, const std::vector<std::size_t>& shapes) {
  float sum = 0.0F;
  for (const std::size_t shape : shapes) sum += coefficients[shape];
  return sum / static_cast<float>(shapes.size());
}

}  // namespace

Values values_from_face(const semblante_frame& frame, bool presets, bool bones) {
  Values values;
  semblante_frame rest = frame;
  const OculusWeights spoken = oculus_from_frame(frame);
  for (std::size_t i = 0; presets && i < values.presets.size(); ++i) {
    const VrmPreset& preset = vrm_presets()[i];
    if (preset.send && preset.expression != 0) values.presets[i] = take_expression(rest, preset.expression);
  }
  values.perfect_sync = arkit_from_frame(rest);
  values.has_perfect_sync = true;
  for (std::size_t i = 0; presets && i < values.presets.size(); ++i) {
    const VrmPreset& preset = vrm_presets()[i];
    if (!preset.send) continue;
    for (std::size_t v = 0; v < oculus_count; ++v) values.presets[i] += spoken[v] * preset.shown[v];
    if (!preset.arkit.empty() && !(bones && is_gaze(preset))) {
      values.presets[i] = mean_of(values.perfect_sync, preset.arkit);
    }
    values.presets[i] = std::clamp(values.presets[i], 0.0F, 1.0F);
  }
  values.head = to_rotation({angle(frame, 49), angle(frame, 48), angle(frame, 50)});
  for (std::size_t side = 0; side < 2; ++side) {
    values.eyes[side] = to_rotation({angle(frame, arkit::eyes[side].yaw), angle(frame, arkit::eyes[side].pitch), 0.0});
  }
  values.eye_bones = true;
  return values;
}

}  // namespace semblante::vmc
