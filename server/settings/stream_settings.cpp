#include "server/settings/stream_settings.h"

#include <nlohmann/json.hpp>

#include "protocol/cpp/quantizers.h"
#include "server/settings/text.h"

namespace semblante::settings {
namespace {

using nlohmann::json;

constexpr std::size_t max_title_bytes = 200;
constexpr std::size_t max_model_bytes = 64;
constexpr std::uint32_t max_batch_interval = 1000;  ///< ms

bool is_share(double number) { return number >= 0.0 && number <= 1.0; }

Status read_text(const json& value, std::size_t max_bytes, std::string& text) {
  if (!value.is_string()) return Error{ErrorCode::malformed, "", "must be a string"};
  text = value.get<std::string>();
  return check_text(text, max_bytes);
}

Status read_viseme_share(const json& value, std::optional<double>& share) {
  const double number = value.is_number() ? value.get<double>() : -1.0;
  if (!is_share(number)) return Error{ErrorCode::out_of_range, "", "must be a number from 0 to 1"};
  share = number;
  return Unit{};
}

Status read_batch_interval(const json& value, std::uint32_t& interval) {
  const double number = value.is_number_integer() ? value.get<double>() : -1.0;
  if (!(number >= 0.0 && number <= max_batch_interval))
    return Error{ErrorCode::out_of_range, "", "must be a whole number from 0 to " + std::to_string(max_batch_interval)};
  interval = static_cast<std::uint32_t>(number);
  return Unit{};
}

Status read_quantizer_scale(const json& value, double& scale) {
  scale = value.is_number() ? value.get<double>() : 0.0;
  if (!is_quantizer_scale(scale)) return Error{ErrorCode::out_of_range, "", "must be 1, 0.5, 0.25 or 0.125"};
  return Unit{};
}

Status read_flag(const json& value, bool& flag) {
  if (!value.is_boolean()) return Error{ErrorCode::malformed, "", "must be true or false"};
  flag = value.get<bool>();
  return Unit{};
}

Status read_setting(std::string_view name, const json& value, StreamSettings& settings) {
  if (name == "title") return read_text(value, max_title_bytes, settings.title);
  if (name == "model") return value.is_null() ? Unit{} : read_text(value, max_model_bytes, settings.model);
  if (name == "viseme_share") return value.is_null() ? Unit{} : read_viseme_share(value, settings.viseme_share);
  if (name == "batch_interval") return read_batch_interval(value, settings.batch_interval);
  if (name == "quantizer_scale") return read_quantizer_scale(value, settings.quantizer_scale);
  if (name == "is_public") return read_flag(value, settings.is_public);
  return Error{ErrorCode::internal, "", "this setting cannot be read"};
}

}  // namespace

std::optional<std::string_view> invalid_setting(const StreamSettings& settings) {
  if (settings.viseme_share && !is_share(*settings.viseme_share)) return "viseme_share";
  if (settings.batch_interval > max_batch_interval) return "batch_interval";
  if (!is_quantizer_scale(settings.quantizer_scale)) return "quantizer_scale";
  return std::nullopt;
}

Result<StreamSettings> read_stream_settings(const json& object, std::string_view id) {
  StreamSettings settings;
  settings.title = id;
  std::optional<Error> wrong;
  for_each_setting(settings, [&](std::string_view name, const auto&) {
    const auto found = object.find(name);
    if (wrong || found == object.end()) return;
    auto read = read_setting(name, *found, settings);
    if (!read) wrong = Error{read.error().code, std::string("/").append(name), read.error().message};
  });
  if (wrong) return std::move(*wrong);
  return settings;
}

}  // namespace semblante::settings
