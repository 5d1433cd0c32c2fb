#include <string>
#include <utility>

#include "server/api/common.h"
#include "server/api/generated/handlers.h"
#include "server/api/motion_body.h"
#include "server/api/play_options.h"
#include "server/streams/performance_source.h"

namespace semblante::api {

http::Response play_performance(Context& context, http::Request& request) {
  const auto& stream = request.params.at("stream");
  const auto info = context.hub.info(stream);
  if (!info) refuse("not-found", "there is no stream " + stream);
  const auto options = play_options(request);
  auto source =
      streams::make_performance_source(performance_of_body(request), scaled_quantizers(info->settings.quantizer_scale));
  return play_into(context, stream, std::move(source), options);
}

http::Response get_performance(Context& context, http::Request& request) {
  const auto info = context.hub.info(request.params.at("stream"));
  if (!info) refuse("not-found", "there is no stream " + request.params.at("stream"));
  const auto& id = request.params.at("performance");
  for (const auto* play : {&info->playing, &info->failed})
    if (*play && (*play)->id == id) return json_response(200, represent(**play));
  refuse("not-found", "the stream does not play the performance " + id);
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
