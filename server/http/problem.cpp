#include "server/http/problem.h"

#include <algorithm>
#include <array>
#include <cassert>

#include <nlohmann/json.hpp>

#include "core/json/json_cursor.h"
#include "core/json/read_json.h"
#include "core/types/printable.h"

namespace semblante::http {
namespace {

constexpr std::string_view problem_media_type = "application/problem+json";
constexpr std::string_view end_of_document = "\n";

constexpr std::nullopt_t none = std::nullopt;
constexpr auto kinds = std::to_array<ProblemKind>({
    {"malformed-request", 400, "The request cannot be read", none},
    {"invalid-argument", 400, "A value of the request is invalid", none},
    {"unauthorized", 401, "The request needs an accepted token", Advice::sign_in},
    {"forbidden", 403, "The token does not allow this request", Advice::ask_for_token},
    {"forbidden-origin", 403, "Pages from this origin may not use the server", none},
    {"not-found", 404, "There is no resource at this address", none},
    {"method-not-allowed", 405, "The resource does not have this method", none},
    {"not-acceptable", 406, "None of the accepted media types is available", none},
    {"request-timeout", 408, "The request did not arrive in time", none},
    {"conflict", 409, "The state of the resource does not allow this", none},
    {"length-required", 411, "The request must carry a body", none},
    {"precondition-failed", 412, "The resource is not in the state that was expected", Advice::look_again},
    {"content-too-large", 413, "The body is over the limit", none},
    {"unsupported-media-type", 415, "The body's media type is not supported", none},
    {"range-not-satisfiable", 416, "The range lies outside the content", none},
    {"expectation-failed", 417, "The server does not meet the expectation", none},
    {"foreign-host", 421, "The server does not accept this host name", none},
    {"malformed-model", 422, "The model file cannot be read", Advice::export_again},
    {"unsupported-model", 422, "The model file needs something that is not supported", Advice::export_as_glb},
    {"empty-model", 422, "The model has nothing to work on", Advice::export_again},
    {"model-too-large", 422, "The model is over a documented limit", Advice::reduce_model},
    {"invalid-feature-point", 422, "A feature point has an impossible place", Advice::move_points},
    {"missing-feature-points", 422, "Feature points are missing", Advice::mark_points},
    {"invalid-frame", 422, "A frame of the stream cannot be read", none},
    {"invalid-performance", 422, "The performance cannot be played", none},
    {"invalid-fap-file", 422, "The .fap file cannot be read", none},
    {"invalid-field", 422, "A field of the body is wrong", none},
    {"idempotency-key-reused", 422, "The idempotency key was used for another request", none},
    {"upgrade-required", 426, "The resource is a WebSocket", none},
    {"precondition-required", 428, "The request must have a precondition", Advice::look_again},
    {"too-many-requests", 429, "Too many requests or jobs are waiting", Advice::wait},
    {"header-too-large", 431, "The header of the request is over the limit", none},
    {"worker-crashed", 500, "The worker of this job ended by a fault", none},
    {"worker-limit", 422, "The job exceeded a limit", Advice::reduce_model},
    {"cancelled", 409, "It was stopped on request", none},
    {"damaged-data", 500, "Stored bytes are missing or damaged", Advice::store_again},
    {"internal", 500, "A fault of the server", none},
    {"no-voice", 501, "No voice is installed", none},
    {"voice-failed", 502, "The voice cannot say this", none},
    {"overloaded", 503, "The server has reached its limit of connections", Advice::wait},
    {"stopping", 503, "The server is stopping", Advice::wait},
    {"storage-unavailable", 503, "The data folder cannot be read or written at the moment", Advice::wait},
    {"http-version", 505, "Only HTTP/1.1 and HTTP/1.0 are supported", none},
    {"limit-exceeded", 507, "A documented limit on the number of things is reached", Advice::delete_unused},
    {"quota-exceeded", 507, "The token has used up a limit", none},
    {"insufficient-storage", 507, "The disk is full", Advice::free_disk},
});

const ProblemKind& kind_of(std::string_view slug) {
  const auto* found = std::find_if(kinds.begin(), kinds.end(), [&](const auto& kind) { return kind.slug == slug; });
  assert(found != kinds.end());
  return *found;
}

std::string_view slug_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::malformed:
    case ErrorCode::truncated:
    case ErrorCode::out_of_range:
    case ErrorCode::not_finite:
      return "malformed-model";
    case ErrorCode::too_large:
      return "model-too-large";
    case ErrorCode::empty:
      return "empty-model";
    case ErrorCode::unsupported:
      return "unsupported-model";
    case ErrorCode::mismatch:
    case ErrorCode::invalid_argument:
      return "invalid-field";
    case ErrorCode::missing:
      return "missing-feature-points";
    case ErrorCode::cancelled:
      return "cancelled";
    case ErrorCode::io:
    case ErrorCode::internal:
      return "internal";
  }
  return "internal";
}

/// What a request names in a wrong place may be as long as its body, and must not come back as often as it is wrong.
constexpr std::size_t most_detail = 2000, most_pointer = 500;

std::string shortened(std::string_view text, std::size_t most) {
  const std::string_view beginning = beginning_of(text, most);
  return std::string(beginning) + (beginning.size() < text.size() ? "..." : "");
}

nlohmann::ordered_json document(const Problem& problem) {
  nlohmann::ordered_json json;
  json["type"] = "/problems/" + problem.slug;
  json["title"] = problem.title;
  json["status"] = problem.status;
  json["detail"] = shortened(problem.detail, most_detail);
  if (!problem.pointer.empty()) json["pointer"] = shortened(problem.pointer, most_pointer);
  if (!problem.faults.empty()) {
    auto& errors = json["errors"] = nlohmann::ordered_json::array();
    for (const auto& fault : problem.faults)
      errors.push_back(
          {{"pointer", shortened(fault.pointer, most_pointer)}, {"detail", shortened(fault.detail, most_detail)}});
  }
  if (problem.advice) json["advice"] = text_of(*problem.advice).name;
  if (problem.limit)
    json["limit"] = {{"name", problem.limit->name}, {"value", problem.limit->value}, {"used", problem.limit->used}};
  return json;
}

}  // namespace

std::vector<ProblemKind> problem_kinds() { return {kinds.begin(), kinds.end()}; }

Problem make_problem(std::string_view slug, std::string detail, std::string pointer) {
  const auto& kind = kind_of(slug);
  Problem problem{kind.status,       std::string(kind.slug), std::string(kind.title),
                  std::move(detail), std::move(pointer),     {}};
  problem.advice = kind.advice;
  return problem;
}

Problem problem_from(const Error& error) {
  // Every error at a feature point gets the problem of feature points.
  const bool about_point = error.where.rfind("/points", 0) == 0 && error.code != ErrorCode::missing;
  auto problem = make_problem(about_point ? "invalid-feature-point" : slug_of(error.code), error.message, error.where);
  if (error.advice) problem.advice = error.advice;
  return problem;
}

std::string to_json(const Problem& problem) {
  return document(problem).dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

Problem problem_from_json(std::string_view text) {
  const auto json = read_json_object(text, {.max_bytes = 1U << 20U, .max_depth = 8, .max_values = 10'000});
  if (!json) return make_problem("internal", "the reason was not recorded");
  JsonCursor::Report report;
  const JsonCursor root(json_view(*json), report);
  Problem problem;
  const auto type = root.text_or("type", "/problems/internal");
  problem.slug = type.substr(type.rfind('/') + 1);
  problem.title = root.text_or("title", "");
  problem.status = static_cast<int>(root.has("status") ? root.member("status").integer(100, 599) : 500);
  problem.detail = root.text_or("detail", "");
  problem.pointer = root.text_or("pointer", "");
  problem.advice = find_advice(root.text_or("advice", ""));
  for (std::size_t i = 0; i < root.size_of("errors"); ++i) {
    const JsonCursor fault = root.member("errors").element(i);
    problem.faults.push_back({fault.text_or("pointer", ""), fault.text_or("detail", "")});
  }
  if (report) return make_problem("internal", "the reason was not recorded");
  return problem;
}

Response to_response(const Problem& problem) {
  Response response;
  response.status = problem.status;
  response.headers["Content-Type"] = problem_media_type;
  response.headers["Cache-Control"] = "no-store";
  response.body = to_json(problem) + std::string(end_of_document);
  return response;
}

void add_request_id(Response& response, std::string_view id) {
  const auto type = response.headers.find("Content-Type");
  auto* document = std::get_if<std::string>(&response.body);
  if (type == response.headers.end() || type->second != problem_media_type || document == nullptr) return;
  const auto end = std::string("}").append(end_of_document);
  if (!document->ends_with(end)) return;
  document->resize(document->size() - end.size());
  document->append(",\"request\":").append(nlohmann::json(id).dump()).append(end);
}

}  // namespace semblante::http
