#include <nlohmann/json.hpp>

#include "server/api/common.h"
#include "server/api/openapi.h"
#include "server/api/routes.h"
#include "server/hash/sha256.h"
#include "server/http/conditional.h"

namespace semblante::api {
namespace {

void metric(std::string& text, const std::string& name, std::string_view type, std::uint64_t value) {
  text.append("# TYPE semblante_").append(name).append(" ").append(type).append("\n");
  text.append("semblante_").append(name).append(" ").append(std::to_string(value)).append("\n");
}

}  // namespace

http::Response get_health(Context&, http::Request&) { return json_response(200, {{"status", "ok"}}); }

http::Response get_ready(Context& context, http::Request&) {
  if (!context.store.healthy()) refuse("overloaded", "the store does not answer");
  return json_response(200, {{"status", "ok"}});
}

http::Response get_version(Context& context, http::Request&) {
  return json_response(200, {{"name", "semblante"}, {"version", context.config.version}, {"api", "v1"}});
}

http::Response get_openapi(Context&, http::Request& request) {
  static const std::string etag = "\"sha256-" + sha256_hex(openapi_document()) + "\"";
  http::Response response;
  response.headers["Content-Type"] = "application/json";
  response.headers["Cache-Control"] = "no-cache";
  response.headers["ETag"] = etag;
  response.body = std::string(openapi_document());
  return http::apply_conditions(request, std::move(response));
}

http::Response get_problem(Context&, http::Request& request) {
  const auto& slug = request.params.at("slug");
  for (const auto& kind : http::problem_kinds())
    if (kind.slug == slug)
      return json_response(
          200, {{"type", "/problems/" + slug}, {"title", std::string(kind.title)}, {"status", kind.status}});
  refuse("not-found", "there is no problem " + slug);
}

http::Response get_metrics(Context& context, http::Request&) {
  std::string text;
  if (context.net_metrics)
    for (const auto& [name, value] : context.net_metrics())
      metric(text, name, name.ends_with("_total") ? "counter" : "gauge", value);
  metric(text, "models", "gauge", context.store.model_count());
  metric(text, "expressions", "gauge", context.store.set_count());
  metric(text, "jobs_waiting", "gauge", context.jobs.waiting());
  metric(text, "jobs_running", "gauge", context.jobs.running());
  const auto streams = context.hub.list();
  std::uint64_t subscribers = 0;
  for (const auto& stream : streams) subscribers += stream.subscribers;
  metric(text, "streams", "gauge", streams.size());
  metric(text, "stream_subscribers", "gauge", subscribers);
  const auto counts = context.hub.counts();
  metric(text, "stream_frames_total", "counter", counts.frames);
  metric(text, "stream_messages_sent_total", "counter", counts.messages_sent);
  metric(text, "stream_messages_replaced_total", "counter", counts.messages_replaced);
  metric(text, "stream_closed_slow_total", "counter", counts.closed_slow);
  metric(text, "stream_refused_total", "counter", counts.refused);
  metric(text, "stream_clamped_values_total", "counter", counts.clamped_values);
  http::Response response;
  response.headers["Content-Type"] = "text/plain; version=0.0.4; charset=utf-8";
  response.headers["Cache-Control"] = "no-store";
  response.body = std::move(text);
  return response;
}

}  // namespace semblante::api
