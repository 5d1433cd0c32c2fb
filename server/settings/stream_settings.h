#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "core/types/result.h"

namespace semblante::settings {

/// The settings of a stream.
struct StreamSettings {
  std::string title;                   ///< for display; default: the stream's id
  std::string model;                   ///< id of the model it is meant for; empty: none
  std::optional<double> viseme_share;  ///< of Eq. 5, 0..1; empty: clients use that of their model
  std::uint32_t batch_interval = 100;  ///< ms of frames in one message; 0: each frame is sent immediately
  double quantizer_scale = 1.0;        ///< ratio of its quantizer steps to the standard ones: one of quantizer_scales

  bool is_public = false;  ///< anyone may subscribe, and fetch its model's package, without a token

  bool operator==(const StreamSettings&) const = default;
};

/// Calls visit(name, member) for each setting. The name is that of the JSON member and of the store's column.
template <class Settings, class Visit>
void for_each_setting(Settings& settings, Visit&& visit) {
  visit(std::string_view("title"), settings.title);
  visit(std::string_view("model"), settings.model);
  visit(std::string_view("viseme_share"), settings.viseme_share);
  visit(std::string_view("batch_interval"), settings.batch_interval);
  visit(std::string_view("quantizer_scale"), settings.quantizer_scale);
  visit(std::string_view("is_public"), settings.is_public);
}

/// The name of a setting whose value no request may give; nullopt: there is none.
std::optional<std::string_view> invalid_setting(const StreamSettings& settings);

/// The settings among the members of `object`; other members are ignored. Absent settings get their defaults, the title
/// the stream's `id`. Errors: the first invalid setting, with a JSON pointer. The caller checks whether the model
/// exists.
Result<StreamSettings> read_stream_settings(const nlohmann::json& object, std::string_view id);

}  // namespace semblante::settings
