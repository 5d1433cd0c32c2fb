#include <cstdint>
#include <cstdlib>

#include <nlohmann/json.hpp>

#include "core/json/read_json.h"
#include "server/settings/stream_settings.h"

// What is accepted is within its bounds, and accepted again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace semblante;
  const auto document = read_json_object({reinterpret_cast<const char*>(data), size});
  if (!document) return 0;
  const auto settings = settings::read_stream_settings(*document, "hello");
  if (!settings) {
    if (settings.error().message.empty()) std::abort();
    return 0;
  }
  if (settings->batch_interval > 1000 || !(settings->quantizer_scale > 0.0)) std::abort();
  if (settings->viseme_share && !(*settings->viseme_share >= 0.0 && *settings->viseme_share <= 1.0)) std::abort();
  nlohmann::json object = {{"title", settings->title},
                           {"batch_interval", settings->batch_interval},
                           {"quantizer_scale", settings->quantizer_scale},
                           {"is_public", settings->is_public}};
  if (!settings->model.empty()) object["model"] = settings->model;
  if (settings->viseme_share) object["viseme_share"] = *settings->viseme_share;
  const auto again = settings::read_stream_settings(object, "hello");
  if (!again || !(*again == *settings)) std::abort();
  return 0;
}
