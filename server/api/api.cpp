#include "server/api/api.h"

#include <algorithm>

#include "core/types/letter_case.h"
#include "protocol/cpp/performance_document.h"
#include "server/api/authorization.h"
#include "server/api/common.h"
#include "server/api/generated/handlers.h"
#include "server/api/motion_body.h"
#include "server/api/quota.h"
#include "server/api/routes.h"
#include "server/api/storage_problems.h"
#include "server/http/content_coding.h"
#include "server/http/media_type.h"
#include "server/http/problem.h"
#include "server/http/request_id.h"
#include "server/http/security_headers.h"
#include "server/http/static_files.h"
#include "server/log/log.h"

namespace semblante::api {
namespace {

using http::make_problem;
using http::to_response;

/// Seconds until a retry, when another connection may have closed.
constexpr unsigned connections_retry_after = 10;
/// Seconds that a restart takes.
constexpr unsigned stopping_retry_after = 5;

bool is_safe(std::string_view method) { return method == "GET" || method == "HEAD" || method == "OPTIONS"; }

/// JSON is UTF-8 (RFC 8259, 8.1), and has no parameter; some clients write what they send nevertheless.
bool is_utf8_if_json(std::string_view content_type) {
  const auto charset = http::parameter(content_type, "charset");
  return http::essence(content_type) != "application/json" || charset.empty() ||
         equal_ignoring_case(charset, "utf-8") || equal_ignoring_case(charset, "us-ascii");
}

bool takes(const RouteBody& body, std::string_view media_type) {
  // A body without a Content-Type is taken to have the right one.
  if (media_type.empty() || body.kind == BodyKind::none) return true;
  return std::find(body.types.begin(), body.types.end(), media_type) != body.types.end();
}

/// "a", "a or b", "a, b or c", with `last` for " or ".
std::string in_words(std::span<const std::string_view> words, std::string_view last = " or ") {
  std::string text;
  for (const auto& word : words) text.append(text.empty() ? "" : &word == &words.back() ? last : ", ").append(word);
  return text;
}

/// Refuses a query parameter that the route does not have, and one that is given twice: a proxy may decide by the
/// other value. `?ticket` is for all routes (access::Tickets). Probes and scrapers, which ask outside of /v1/, may add
/// their own.
std::optional<http::Response> refuse_wrong_query(const Route& route, const http::Request& head) {
  if (!route.pattern.starts_with("/v1/")) return std::nullopt;
  if (!head.repeated.empty())
    return to_response(make_problem("invalid-argument", "the parameter \"" + head.repeated + "\" is given twice",
                                    "?" + head.repeated));
  const auto is_unknown = [&](const auto& parameter) {
    return parameter.first != "ticket" && std::ranges::find(route.query, parameter.first) == route.query.end();
  };
  const auto unknown = std::ranges::find_if(head.query, is_unknown);
  if (unknown == head.query.end()) return std::nullopt;
  const auto known =
      route.query.empty() ? std::string("this route has none") : "this route has " + in_words(route.query, " and ");
  return to_response(make_problem("invalid-argument", "there is no parameter \"" + unknown->first + "\" here; " + known,
                                  "?" + unknown->first));
}

http::BodyPlan plan_body(const Route& route, std::string_view media_type, const ApiLimits& limits) {
  const auto& body = route.body;
  switch (body.kind) {
    case BodyKind::none:
      return {limits.max_json_bytes, false, false, route.runs == Runs::at_once};
    case BodyKind::json:
    case BodyKind::json_or_models:
      if (media_type == "multipart/form-data") break;
      return {limits.max_json_bytes, false, body.announced};
    case BodyKind::performance:
      return {max_performance_bytes, true, body.announced};
    case BodyKind::fap:
      return {max_fap_body_bytes, true, body.announced};
    case BodyKind::upload:
      break;
  }
  // A form of another kind has no model that could be reduced.
  const auto if_too_large = body.kind == BodyKind::json ? std::nullopt : std::optional(Advice::reduce_model);
  return {limits.max_upload_bytes, true, body.announced, false, if_too_large};
}

bool is_page(const ApiConfig& config, std::string_view path) {
  return !config.web_root.empty() && path.substr(0, 4) != "/v1/";
}

http::Response to_response(const Refused& refused) {
  auto response = http::to_response(refused.problem);
  if (refused.retry_after > 0) response.headers["Retry-After"] = std::to_string(refused.retry_after);
  return response;
}

http::Response stopping_response() {
  return to_response(Refused{make_problem("stopping", "nothing new is begun: try again when the server has started"),
                             stopping_retry_after});
}

/// The kinds by which requests are counted: the routes in their order, then the rest.
std::vector<metrics::RequestKind> request_kinds() {
  std::vector<metrics::RequestKind> kinds;
  for (const auto& route : routes()) kinds.push_back({std::string(route.method), std::string(route.pattern)});
  kinds.push_back({"GET", "page"});
  kinds.push_back({"other", "other"});
  return kinds;
}

/// Index into request_kinds() of requests without a route.
std::size_t page_kind() { return routes().size(); }
std::size_t other_kind() { return routes().size() + 1; }

bool is_upgrade(const http::Request& head) {
  return equal_ignoring_case(head.header("Upgrade").value_or(""), "websocket");
}

/// The route that find_route() has found, or null.
const Route* route_of(const http::Request& request) {
  return request.route < routes().size() ? &routes()[request.route] : nullptr;
}

}  // namespace

Api::Api(Context context) : context_(std::move(context)) {
  context_.requests = std::make_shared<metrics::RequestCounts>(request_kinds());
  context_.idempotency_keys = std::make_shared<KeyLocks>();
  context_.stopping = std::make_shared<std::atomic<bool>>(false);
  context_.quota_turns = std::make_shared<KeyLocks>();
  context_.stream_changes = std::make_shared<KeyLocks>();
  context_.voices = std::make_shared<ExportSlots>(context_.config.limits.max_voices);
  context_.known_voices = std::make_shared<KnownVoices>();
  context_.speakers = std::make_shared<Speakers>(context_.config.limits.max_voices);
  if (!context_.exports) context_.exports = std::make_shared<ExportSlots>(context_.config.limits.max_exports);
}

void Api::find_route(http::Request& head) {
  auto match = match_route(head.method, head.path);
  const bool reads = head.method == "GET" || head.method == "HEAD";
  const bool page = match.allow.empty() && is_page(context_.config, head.path) && reads;
  // A look at the disk, which is left to a worker where there is a file to send.
  if (match.allow.empty() && is_page(context_.config, head.path) && !reads &&
      http::has_static_file(context_.config.web_root, head.path))
    match.allow = "OPTIONS, GET, HEAD";
  if (match.route != nullptr)
    head.route = static_cast<std::size_t>(match.route - routes().data());
  else
    head.route = page ? page_kind() : other_kind();
  head.allow = std::move(match.allow);
  head.params = std::move(match.params);
  // Of the hop before this server, so that one id leads through the logs of both.
  if (const auto given = head.header(http::request_id_header);
      given && http::is_request_id(*given) && http::any_contains(context_.config.security.proxies, head.peer))
    head.id = *given;
  head.requester = ask(context_.config.security, head, is_upgrade(head));
}

std::variant<http::BodyPlan, http::Response> Api::plan(const http::Request& head) {
  const auto& access = context_.config.access;
  const auto& security = context_.config.security;
  if (auto problem = is_safe(head.method) ? access.refuse_reading(head) : access.refuse_changing(head))
    return to_response(*problem);
  if (auto refusal = refuse_entry(security, head)) return std::move(*refusal);
  if (*context_.stopping && !is_safe(head.method)) return stopping_response();
  if (head.route == page_kind()) return http::BodyPlan{};
  if (head.allow.empty()) return to_response(make_problem("not-found", "there is no route " + head.path));
  if (head.method == "OPTIONS") {
    http::Response response;
    response.status = 204;
    response.headers["Allow"] = head.allow;
    if (access.origin_allowed(head)) {
      response.headers["Access-Control-Allow-Methods"] = head.allow;
      response.headers["Access-Control-Allow-Headers"] =
          "Authorization, Content-Type, Content-Disposition, If-Match, If-None-Match, Idempotency-Key, Range";
      response.headers["Access-Control-Max-Age"] = "600";
    }
    return response;
  }
  const auto* route = route_of(head);
  if (route == nullptr) {
    auto response = to_response(make_problem("method-not-allowed", head.path + " knows " + head.allow));
    response.headers["Allow"] = head.allow;
    return response;
  }
  if (auto refusal = refuse_access(security, context_.hub, head, route->scope)) return std::move(*refusal);
  if (auto refusal = refuse_wrong_query(*route, head)) return std::move(*refusal);
  if (!route->produces.empty() && route->produces != "*/*" &&
      !http::accepts(head.header("Accept").value_or(""), route->produces))
    return to_response(make_problem("not-acceptable", "the answer here is " + std::string(route->produces)));
  const auto content_type = http::essence(head.header("Content-Type").value_or(""));
  if (!takes(route->body, content_type))
    return to_response(make_problem(
        "unsupported-media-type",
        content_type + " is not accepted here; send the body with Content-Type: " + in_words(route->body.types)));
  if (!is_safe(head.method) && !is_utf8_if_json(head.header("Content-Type").value_or("")))
    return to_response(make_problem("unsupported-media-type", "JSON is accepted in UTF-8 only"));
  // A compressed body would be stored as it came, and fail later as a file of no format.
  if (const auto coding = head.header("Content-Encoding").value_or("");
      !is_safe(head.method) && !coding.empty() && !equal_ignoring_case(coding, "identity")) {
    auto response = to_response(make_problem("unsupported-media-type",
                                             "bodies with Content-Encoding are not accepted: send the body as it is"));
    response.headers["Accept-Encoding"] = "identity";
    return response;
  }
  auto body = plan_body(*route, content_type, context_.config.limits);
  if (!body.to_file) return body;
  auto share = take_upload(security, head);
  if (auto* refusal = std::get_if<http::Response>(&share)) return std::move(*refusal);
  body.held = std::get<std::shared_ptr<const void>>(std::move(share));
  return body;
}

http::Response Api::handle(http::Request& request) {
  const auto* route = route_of(request);
  if (route == nullptr) return http::static_file(context_.config.web_root, request);
  if (auto refusal = refuse_ended_token(request)) return std::move(*refusal);
  try {
    refuse_foreign_resource(context_, request);
    auto response = route->handler(context_, request);
    tell_quota(request, response);
    return response;
  } catch (const Refused& refused) {
    return to_response(refused);
  } catch (const store::StoreError& fault) {
    return to_response(refuse(request.method + " " + request.path, fault));
  } catch (const store::DamagedBlob& fault) {
    log::error(request.method + " " + request.path + ": " + fault.what());
    return to_response(problem_of(fault));
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
  // The URL of a stream's WebSocket is that of the stream.
  const auto* route = route_of(head);
  if (route == nullptr || route->handler != get_stream)
    return to_response(make_problem("not-found", head.path + " is no stream"));
  const auto& security = context_.config.security;
  if (auto refusal = refuse_entry(security, head)) return std::move(*refusal);
  if (auto refusal = refuse_access(security, context_.hub, head, access::Scope::read)) return std::move(*refusal);
  if (auto refusal = refuse_wrong_query(*route, head)) return std::move(*refusal);
  if (*context_.stopping) return stopping_response();
  const auto& rights = asking_of(head).rights;
  const auto& id = head.params.at("stream");
  auto connected = context_.hub.connect(id, head.header("Sec-WebSocket-Protocol").value_or(""),
                                        {rights.scope >= access::Scope::publish, rights.ended});
  if (auto* peer = std::get_if<std::shared_ptr<http::WebSocketPeer>>(&connected)) return std::move(*peer);
  if (std::get<streams::Refusal>(connected) == streams::Refusal::too_many)
    return to_response(Refused{make_problem("too-many-requests", "the stream has reached its limit of connections"),
                               connections_retry_after});
  return to_response(make_problem("not-found", "there is no stream " + id));
}

void Api::decorate(const http::Request& head, http::Response& response) {
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - head.received;
  // A request that could not be parsed has no route.
  const auto kind = head.route == http::no_route ? other_kind() : head.route;
  context_.requests->count(kind, response.status, took.count());
  for (const auto& [name, value] : http::security_headers()) response.headers.try_emplace(name, value);
  if (head.route == page_kind()) http::allow_frames(response, context_.config.access.frame_origins);
  // Browsers keep to https after this; from an address without a name they ignore it.
  if (asking_of(head).from.secure) response.headers["Strict-Transport-Security"] = "max-age=31536000";
  const auto origin = head.header("Origin");
  if (!origin) return;
  http::vary_by(response, "Origin");
  if (!context_.config.access.origin_allowed(head)) return;
  response.headers["Access-Control-Allow-Origin"] = std::string(*origin);
  response.headers["Access-Control-Expose-Headers"] =
      "ETag, Location, Retry-After, Content-Range, Allow, WWW-Authenticate, X-Quota-Warning, X-Request-Id";
}

}  // namespace semblante::api
