#include "clients/gateways/vmc/vrm_blends.h"

#include <algorithm>
#include <cassert>

#include <nlohmann/json.hpp>

#include "core/bridges/arkit.h"
#include "core/tables/mpeg4.h"
#include "core/types/letter_case.h"

namespace semblante::vmc {
namespace {

/// Looks up a value in a table of this program: a missing one is a mistake in the file.
template <class Value>
Value known(std::optional<Value> found) {
  assert(found);
  return *found;
}

std::uint8_t expression_number(std::string_view name) {
  std::uint8_t number = 0;
  while (number < mpeg4::expressions.size() && mpeg4::expressions[number].name != name) ++number;
  assert(number < mpeg4::expressions.size());
  return number;
}

VrmPreset read_preset(const nlohmann::json& from) {
  VrmPreset preset;
  preset.vrm0 = from.at("vrm0");
  preset.vrm1 = from.at("vrm1");
  preset.send = from.value("send", true);
  for (const std::string& shape : from.value("arkit", std::vector<std::string>())) {
    preset.arkit.push_back(known(find_arkit(shape)));
  }
  if (from.contains("viseme")) preset.viseme = known(find_oculus(from.at("viseme").get<std::string>()));
  if (from.contains("expression")) {
    preset.expression = expression_number(from.at("expression").get<std::string>());
    preset.amount = from.at("amount");
  }
  return preset;
}

std::vector<VrmPreset> read_presets() {
  const auto document = nlohmann::json::parse(vrm_blends_document());
  std::vector<VrmPreset> presets;
  for (const auto& preset : document.at("presets")) presets.push_back(read_preset(preset));
  for (const auto& [viseme, vowels] : document.at("vowels").items()) {
    for (const auto& [name, share] : vowels.items()) {
      const auto preset =
          std::find_if(presets.begin(), presets.end(), [&name = name](const auto& p) { return p.vrm0 == name; });
      assert(preset != presets.end());
      preset->shown[known(find_oculus(viseme))] = share;
    }
  }
  return presets;
}

}  // namespace

const std::vector<VrmPreset>& vrm_presets() {
  static const std::vector<VrmPreset> presets = read_presets();
  return presets;
}

std::optional<std::size_t> find_vrm_preset(std::string_view name) {
  const auto& presets = vrm_presets();
  for (std::size_t i = 0; i < presets.size(); ++i) {
    if (equal_ignoring_case(presets[i].vrm0, name) || equal_ignoring_case(presets[i].vrm1, name)) return i;
  }
  return std::nullopt;
}

std::optional<std::size_t> find_perfect_sync(std::string_view name) {
  for (std::size_t i = 0; i < arkit_count; ++i) {
    if (equal_ignoring_case(arkit_name(i), name)) return i;
  }
  return std::nullopt;
}

}  // namespace semblante::vmc
