#include "server/api/api.h"

#include <algorithm>
#include <array>

#include "core/import/model_formats.h"
#include "protocol/cpp/performance_document.h"
#include "server/api/common.h"
#include "server/api/play_options.h"
#include "server/api/routes.h"
#include "server/api/storage_problems.h"
#include "server/http/media_type.h"
#include "server/http/problem.h"
#include "server/http/static_files.h"
#include "server/log/log.h"

namespace semblante::api {
namespace {

using http::make_problem;
using http::to_response;

/// Seconds after which a place may have become free.
constexpr unsigned connections_retry_after = 10;

bool is_safe(std::string_view method) { return method == "GET" || method == "HEAD" || method == "OPTIONS"; }

const Route* find_method(const Match& match, std::string_view method) {
  if (method == "HEAD") method = "GET";
  const auto found = std::find_if(match.routes.begin(), match.routes.end(),
                                  [&](const Route* route) { return route->method == method; });
  return found == match.routes.end() ? nullptr : *found;
}

std::string allowed_methods(const Match& match) {
  std::string list = "OPTIONS";
  for (const auto* route : match.routes) {
    list.append(", ").append(route->method);
    if (route->method == "GET") list.append(", HEAD");
  }
  return list;
}

/// What the body of a route may be sent as; a body without a Content-Type is taken for what it should be.
bool takes(BodyKind kind, std::string_view media_type) {
  if (media_type.empty() || kind == BodyKind::none) return true;
  if (kind == BodyKind::json || kind == BodyKind::performance) return media_type == "application/json";
  if (kind == BodyKind::fap) return media_type == "text/plain" || media_type == "application/octet-stream";
  if (kind == BodyKind::merge) return media_type == "application/json" || media_type == "application/merge-patch+json";
  if (kind == BodyKind::example) return media_type == "application/json" || media_type == "multipart/form-data";
  return media_type == "multipart/form-data" || is_model_media_type(media_type);
}

std::string_view taken_types(BodyKind kind) {
  if (kind == BodyKind::fap) return "text/plain or application/octet-stream";
  if (kind == BodyKind::upload) return "application/octet-stream, a type of the model's own, or multipart/form-data";
  if (kind == BodyKind::example) return "application/json or multipart/form-data";
  return "application/json";
}

bool is_page(const ApiConfig& config, std::string_view path) {
  return !config.web_root.empty() && path.substr(0, 4) != "/v1/";
}

http::Response to_response(const Refused& refused) {
  auto response = http::to_response(refused.problem);
  if (refused.retry_after > 0) response.headers["Retry-After"] = std::to_string(refused.retry_after);
  return response;
}

/// What requests are counted by: the routes in their order, then the rest.
std::vector<metrics::RequestKind> request_kinds() {
  std::vector<metrics::RequestKind> kinds;
  for (const auto& route : routes()) kinds.push_back({std::string(route.method), std::string(route.pattern)});
  kinds.push_back({"GET", "page"});
  kinds.push_back({"other", "other"});
  return kinds;
}

/// Index into request_kinds(). HEAD counts as the GET it stands for.
std::size_t kind_of(const ApiConfig& config, const http::Request& head) {
  const auto match = match_path(head.path);
  if (const auto* route = find_method(match, head.method)) return static_cast<std::size_t>(route - routes().data());
  const bool page = match.routes.empty() && is_page(config, head.path) && is_safe(head.method);
  return routes().size() + (page ? 0 : 1);
}

}  // namespace

Api::Api(Context context) : context_(std::move(context)) {
  context_.requests = std::make_shared<metrics::RequestCounts>(request_kinds());
  context_.idempotency_keys = std::make_shared<KeyLocks>();
}

std::variant<http::BodyPlan, http::Response> Api::plan(const http::Request& head) {
  const auto& access = context_.config.access;
  if (auto problem = is_safe(head.method) ? access.refuse_reading(head) : access.refuse_changing(head))
    return to_response(*problem);
  const auto match = match_path(head.path);
  if (match.routes.empty()) {
    if (is_page(context_.config, head.path) && is_safe(head.method)) return http::BodyPlan{};
    return to_response(make_problem("not-found", "there is no route " + head.path));
  }
  if (head.method == "OPTIONS") {
    http::Response response;
    response.status = 204;
    response.headers["Allow"] = allowed_methods(match);
    if (access.origin_allowed(head)) {
      response.headers["Access-Control-Allow-Methods"] = allowed_methods(match);
      response.headers["Access-Control-Allow-Headers"] =
          "Content-Type, Content-Disposition, If-Match, If-None-Match, Idempotency-Key, Range";
      response.headers["Access-Control-Max-Age"] = "600";
    }
    return response;
  }
  const auto* route = find_method(match, head.method);
  if (route == nullptr) {
    auto response = to_response(make_problem("method-not-allowed", head.path + " knows " + allowed_methods(match)));
    response.headers["Allow"] = allowed_methods(match);
    return response;
  }
  if (!route->produces.empty() && route->produces != "*/*" &&
      !http::accepts(head.header("Accept").value_or(""), route->produces))
    return to_response(make_problem("not-acceptable", "the answer here is " + std::string(route->produces)));
  const auto content_type = http::essence(head.header("Content-Type").value_or(""));
  if (!takes(route->body, content_type))
    return to_response(make_problem(
        "unsupported-media-type",
        content_type + " is not read here; send it with Content-Type: " + std::string(taken_types(route->body))));

  const auto& limits = context_.config.limits;
  switch (route->body) {
    case BodyKind::none:
      return http::BodyPlan{limits.max_json_bytes, false, false, route->runs == Runs::at_once};
    case BodyKind::json:
    case BodyKind::merge:
      return http::BodyPlan{limits.max_json_bytes, false, route->method != "POST"};
    case BodyKind::performance:
      return http::BodyPlan{max_performance_bytes, true, true};
    case BodyKind::fap:
      return http::BodyPlan{max_fap_body_bytes, true, true};
    case BodyKind::example:
      if (content_type != "multipart/form-data") return http::BodyPlan{limits.max_json_bytes, false, true};
      [[fallthrough]];
    case BodyKind::upload:
      return http::BodyPlan{limits.max_upload_bytes, true, true};
  }
  return http::BodyPlan{};
}

http::Response Api::handle(http::Request& request) {
  auto match = match_path(request.path);
  const auto* route = find_method(match, request.method);
  if (route == nullptr) return http::static_file(context_.config.web_root, request);
  request.params = std::move(match.params);
  try {
    return route->handler(context_, request);
  } catch (const Refused& refused) {
    return to_response(refused);
  } catch (const store::StoreError& fault) {
    return to_response(refuse(request.method + " " + request.path, fault));
  }
}

http::Problem Api::refuse(const std::string& request, const store::StoreError& fault) {
  log::error(request + ": " + fault.what());
  context_.pending.note(fault);
  return problem_of(fault);
}

http::Problem Api::unwritten_body(int error_number) {
  try {
    store::throw_store_error("a body", error_number);
  } catch (const store::StoreError& fault) {
    return refuse("an upload", fault);
  }
}

std::variant<std::shared_ptr<http::WebSocketPeer>, http::Response> Api::open_websocket(const http::Request& head) {
  if (auto problem = context_.config.access.refuse_changing(head)) return to_response(*problem);
  const auto match = match_path(head.path);
  if (match.routes.empty() || match.routes.front()->pattern != "/v1/streams/{stream}")
    return to_response(make_problem("not-found", head.path + " is no stream"));
  const auto& id = match.params.at("stream");
  auto connected = context_.hub.connect(id, head.header("Sec-WebSocket-Protocol").value_or(""));
  if (auto* peer = std::get_if<std::shared_ptr<http::WebSocketPeer>>(&connected)) return std::move(*peer);
  if (std::get<streams::Refusal>(connected) == streams::Refusal::too_many)

    return to_response(Refused{make_problem("too-many-requests", "the stream has as many connections as it takes"),
                               connections_retry_after});
  return to_response(make_problem("not-found", "there is no stream " + id));
}

void Api::decorate(const http::Request& head, http::Response& response) {
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - head.received;
  context_.requests->count(kind_of(context_.config, head), response.status, took.count());
  response.headers.try_emplace("X-Content-Type-Options", "nosniff");
  const auto origin = head.header("Origin");
  if (!origin) return;
  response.headers["Vary"] = "Origin";
  if (!context_.config.access.origin_allowed(head)) return;
  response.headers["Access-Control-Allow-Origin"] = std::string(*origin);
  response.headers["Access-Control-Expose-Headers"] = "ETag, Location, Retry-After, Content-Range, Allow";
}

}  // namespace semblante::api
