#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/api/api.h"

namespace semblante::api {

enum class BodyKind {
  none,         ///< a body is read and ignored
  json,         ///< application/json, may be left out
  merge,        ///< application/json or application/merge-patch+json
  performance,  ///< application/json of a performance's size
  fap,          ///< text/plain or application/octet-stream: a .fap file
  upload,       ///< a model: raw or multipart, to disk
  example,      ///< application/json, or multipart with files, to disk
};

/// Where a route is handled. `at_once`: on the connection's strand, so that it answers when every worker is busy; its
/// handler must not wait for a lock, the disk or the store.
enum class Runs { on_worker, at_once };

using Handler = http::Response (*)(Context& context, http::Request& request);

/// One operation. The table of these is what the server does, and openapi.json must list exactly it.
struct Route {
  std::string_view method;
  std::string_view pattern;  ///< "/v1/models/{model}": a {name} takes one segment
  BodyKind body;
  std::string_view produces;  ///< media type of the good answer; "" for none, "*/*" for what the artefact is
  Handler handler;
  Runs runs = Runs::on_worker;
};

std::span<const Route> routes();

/// The routes whose pattern fits a path, whatever their method, and what the names stand for.
struct Match {
  std::vector<const Route*> routes;
  std::map<std::string, std::string> params;
};
Match match_path(std::string_view path);

// The handlers, by file.
// system.cpp
http::Response get_health(Context&, http::Request&);
http::Response get_ready(Context&, http::Request&);
http::Response get_version(Context&, http::Request&);
http::Response get_openapi(Context&, http::Request&);
http::Response get_problem(Context&, http::Request&);
// metrics_routes.cpp
http::Response get_metrics(Context&, http::Request&);
// models.cpp
http::Response list_models(Context&, http::Request&);
http::Response get_model(Context&, http::Request&);
http::Response patch_model(Context&, http::Request&);
http::Response delete_model(Context&, http::Request&);
// upload.cpp
http::Response create_model(Context&, http::Request&);
// feature_points.cpp
http::Response get_feature_points(Context&, http::Request&);
http::Response put_feature_points(Context&, http::Request&);
// job_routes.cpp
http::Response create_parametrization(Context&, http::Request&);
http::Response create_proposals(Context&, http::Request&);
http::Response get_job(Context&, http::Request&);
http::Response cancel_job(Context&, http::Request&);
http::Response get_job_events(Context&, http::Request&);
// artefacts.cpp
http::Response get_model_artefact(Context&, http::Request&);
http::Response get_artefact(Context&, http::Request&);
// expressions.cpp
http::Response list_expressions(Context&, http::Request&);
http::Response get_expression(Context&, http::Request&);
http::Response put_expression(Context&, http::Request&);
http::Response delete_expression(Context&, http::Request&);
// new_expression.cpp
http::Response create_expression(Context&, http::Request&);
// stream_routes.cpp
http::Response list_streams(Context&, http::Request&);
http::Response create_stream(Context&, http::Request&);
http::Response get_stream(Context&, http::Request&);
http::Response delete_stream(Context&, http::Request&);
http::Response post_frames(Context&, http::Request&);
// recording_routes.cpp
http::Response create_recording(Context&, http::Request&);
http::Response list_recordings(Context&, http::Request&);
http::Response list_stream_recordings(Context&, http::Request&);
http::Response get_recording(Context&, http::Request&);
http::Response stop_recording(Context&, http::Request&);
http::Response delete_recording(Context&, http::Request&);
http::Response post_play(Context&, http::Request&);
// recording_content.cpp
http::Response get_recording_content(Context&, http::Request&);
http::Response get_recording_frames(Context&, http::Request&);
http::Response get_newest_recording(Context&, http::Request&);
// fap_routes.cpp
http::Response post_fap(Context&, http::Request&);
// performance_routes.cpp
http::Response post_performance(Context&, http::Request&);
http::Response get_performance(Context&, http::Request&);
http::Response stop_performance(Context&, http::Request&);

}  // namespace semblante::api
