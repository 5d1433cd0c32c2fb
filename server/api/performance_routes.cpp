#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/performance/performance.h"
#include "protocol/cpp/performance_document.h"
#include "server/api/common.h"
#include "server/api/generated/handlers.h"
#include "server/api/play_options.h"
#include "server/streams/performance_source.h"

namespace semblante::api {
namespace {

[[noreturn]] void refuse_document(const Error& error) {
  if (error.code == ErrorCode::too_large) refuse("content-too-large", error.message, error.where);
  const bool no_json = error.code == ErrorCode::malformed && error.where.empty();
  refuse(no_json ? "malformed-request" : "invalid-performance", error.message, error.where);
}

}  // namespace

http::Response play_performance(Context& context, http::Request& request) {
  const auto& stream = request.params.at("stream");
  const auto info = context.hub.info(stream);
  if (!info) refuse("not-found", "there is no stream " + stream);
  const auto options = play_options(request);
  auto script = read_performance(text_of_body(request));
  if (!script) refuse_document(script.error());
  auto performance = Performance::compile(*script);
  if (!performance) refuse_document(performance.error());
  auto source =
      streams::make_performance_source(std::move(*performance), scaled_quantizers(info->settings.quantizer_scale));
  return play_into(context, stream, std::move(source), options);
}

http::Response get_performance(Context& context, http::Request& request) {
  const auto info = context.hub.info(request.params.at("stream"));
  if (!info) refuse("not-found", "there is no stream " + request.params.at("stream"));
  const auto& id = request.params.at("performance");
  if (!info->playing || info->playing->id != id) refuse("not-found", "the stream does not play the performance " + id);
  return json_response(200, represent(*info->playing));
}

http::Response stop_performance(Context& context, http::Request& request) {
  const auto& stream = request.params.at("stream");
  if (!context.hub.info(stream)) refuse("not-found", "there is no stream " + stream);
  const auto& id = request.params.at("performance");
  if (!context.hub.stop(stream, id)) refuse("not-found", "the stream does not play the performance " + id);
  http::Response response;
  response.status = 204;
  return response;
}

}  // namespace semblante::api
