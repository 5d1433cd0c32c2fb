#include "server/api/routes.h"

#include <array>

namespace semblante::api {
namespace {

constexpr std::string_view json = "application/json";

constexpr auto table = std::to_array<Route>({
    {"GET", "/healthz", BodyKind::none, json, get_health, Runs::at_once},
    {"GET", "/readyz", BodyKind::none, json, get_ready},
    {"GET", "/version", BodyKind::none, json, get_version, Runs::at_once},
    {"GET", "/metrics", BodyKind::none, "text/plain", get_metrics},
    {"GET", "/openapi.json", BodyKind::none, json, get_openapi},
    {"GET", "/problems/{slug}", BodyKind::none, json, get_problem},
    {"GET", "/v1/models", BodyKind::none, json, list_models},
    {"POST", "/v1/models", BodyKind::upload, json, create_model},
    {"GET", "/v1/models/{model}", BodyKind::none, json, get_model},
    {"PATCH", "/v1/models/{model}", BodyKind::merge, json, patch_model},
    {"DELETE", "/v1/models/{model}", BodyKind::none, "", delete_model},
    {"GET", "/v1/models/{model}/feature-points", BodyKind::none, json, get_feature_points},
    {"PUT", "/v1/models/{model}/feature-points", BodyKind::json, json, put_feature_points},
    {"POST", "/v1/models/{model}/feature-points/proposals", BodyKind::json, json, create_proposals},
    {"POST", "/v1/models/{model}/parametrizations", BodyKind::json, json, create_parametrization},
    {"GET", "/v1/models/{model}/preview.glb", BodyKind::none, "*/*", get_model_artefact},
    {"GET", "/v1/models/{model}/mesh.drc", BodyKind::none, "*/*", get_model_artefact},
    {"GET", "/v1/models/{model}/weights", BodyKind::none, "*/*", get_model_artefact},
    {"GET", "/v1/models/{model}/rig.json", BodyKind::none, "*/*", get_model_artefact},
    {"GET", "/v1/models/{model}/face.glb", BodyKind::none, "*/*", get_model_artefact},
    {"GET", "/v1/models/{model}/report.json", BodyKind::none, json, get_model_artefact},
    {"GET", "/v1/artefacts/{sha256}", BodyKind::none, "*/*", get_artefact},
    {"GET", "/v1/jobs/{job}", BodyKind::none, json, get_job},
    {"DELETE", "/v1/jobs/{job}", BodyKind::none, json, cancel_job},
    {"GET", "/v1/jobs/{job}/events", BodyKind::none, "text/event-stream", get_job_events},
    {"GET", "/v1/expressions", BodyKind::none, json, list_expressions},
    {"POST", "/v1/expressions", BodyKind::example, json, create_expression},
    {"GET", "/v1/expressions/{expression}", BodyKind::none, json, get_expression},
    {"PUT", "/v1/expressions/{expression}", BodyKind::json, json, put_expression},
    {"DELETE", "/v1/expressions/{expression}", BodyKind::none, "", delete_expression},
    {"GET", "/v1/streams", BodyKind::none, json, list_streams},
    {"POST", "/v1/streams", BodyKind::json, json, create_stream},
    {"GET", "/v1/streams/{stream}", BodyKind::none, json, get_stream},
    {"DELETE", "/v1/streams/{stream}", BodyKind::none, "", delete_stream},
    {"POST", "/v1/streams/{stream}/frames", BodyKind::json, json, post_frames},
    {"POST", "/v1/streams/{stream}/fap", BodyKind::fap, json, post_fap},
    {"POST", "/v1/streams/{stream}/performances", BodyKind::performance, json, post_performance},
    {"GET", "/v1/streams/{stream}/performances/{performance}", BodyKind::none, json, get_performance},
    {"DELETE", "/v1/streams/{stream}/performances/{performance}", BodyKind::none, "", stop_performance},
    {"POST", "/v1/streams/{stream}/plays", BodyKind::json, json, post_play},
    {"GET", "/v1/streams/{stream}/recording", BodyKind::none, "*/*", get_newest_recording},
    {"GET", "/v1/streams/{stream}/recordings", BodyKind::none, json, list_stream_recordings},
    {"POST", "/v1/streams/{stream}/recordings", BodyKind::json, json, create_recording},
    {"GET", "/v1/recordings", BodyKind::none, json, list_recordings},
    {"GET", "/v1/recordings/{recording}", BodyKind::none, json, get_recording},
    {"DELETE", "/v1/recordings/{recording}", BodyKind::none, "", delete_recording},
    {"POST", "/v1/recordings/{recording}/stop", BodyKind::json, json, stop_recording},
    {"GET", "/v1/recordings/{recording}/content", BodyKind::none, "*/*", get_recording_content},
    {"GET", "/v1/recordings/{recording}/frames", BodyKind::none, json, get_recording_frames},
});

/// Takes one segment off the front: "/a/b" -> "a", leaving "/b".
std::string_view next_segment(std::string_view& path) {
  path.remove_prefix(1);
  const auto end = path.find('/');
  const auto segment = path.substr(0, end);
  path.remove_prefix(segment.size());
  return segment;
}

bool fits(std::string_view pattern, std::string_view path, std::map<std::string, std::string>& params) {
  params.clear();
  while (!pattern.empty() && !path.empty()) {
    const auto expected = next_segment(pattern);
    const auto actual = next_segment(path);
    if (expected.size() > 2 && expected.front() == '{') {
      if (actual.empty()) return false;
      params[std::string(expected.substr(1, expected.size() - 2))] = std::string(actual);
    } else if (expected != actual) {
      return false;
    }
  }
  return pattern.empty() && path.empty();
}

}  // namespace

std::span<const Route> routes() { return table; }

Match match_path(std::string_view path) {
  Match match;
  std::map<std::string, std::string> params;
  for (const auto& route : table) {
    if (!fits(route.pattern, path, params)) continue;
    match.routes.push_back(&route);
    match.params = params;
  }
  return match;
}

}  // namespace semblante::api
