#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/bridges/oculus.h"

namespace semblante::vmc {

/// One preset blend value of VRM avatars and its meaning: data/vrm_blends.json.
struct VrmPreset {
  std::string vrm0, vrm1;          ///< names of the preset
  std::vector<std::size_t> arkit;  ///< ARKit coefficients that it sets (arkit.h)
  std::optional<std::size_t> viseme;
  std::uint8_t expression = 0;  ///< expression of FAP 2; 0: none
  float amount = 0.0F;          ///< intensity of the expression at a value of 1
  bool send = true;
  std::array<float, oculus_count> shown{};  ///< by viseme: how much of the preset a mouth with this viseme shows
};

/// The file data/vrm_blends.json, embedded at compile time.
std::string_view vrm_blends_document();
/// The parsed file; asserts that it is valid.
const std::vector<VrmPreset>& vrm_presets();
/// Finds a preset by its VRM 0 or VRM 1 name, case-insensitive.
std::optional<std::size_t> find_vrm_preset(std::string_view name);
/// Finds an ARKit coefficient by name, case-insensitive ("EyeBlinkLeft", "eyeblinkleft").
std::optional<std::size_t> find_perfect_sync(std::string_view name);

}  // namespace semblante::vmc
