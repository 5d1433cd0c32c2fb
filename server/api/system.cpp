#include <nlohmann/json.hpp>

#include "protocol/hash/sha256.h"
#include "server/api/common.h"
#include "server/api/documents.h"
#include "server/api/generated/handlers.h"
#include "server/api/storage_problems.h"
#include "server/http/conditional.h"

namespace semblante::api {
namespace {

/// A document of documents.h with its header fields.
http::Response document(std::string_view text, std::string_view content_type, std::string_view cache_control) {
  http::Response response;
  response.headers["Content-Type"] = content_type;
  response.headers["Cache-Control"] = cache_control;
  response.headers["ETag"] = "\"sha256-" + sha256_hex(text) + "\"";
  response.body = std::string(text);
  return response;
}

}  // namespace

http::Response get_health(Context&, http::Request&) { return json_response(200, answer::Status{}); }

http::Response get_ready(Context& context, http::Request&) {
  if (*context.stopping) refuse("stopping", "the server finishes what has begun and ends");
  if (!context.store.healthy()) refuse("storage-unavailable", "the store does not answer");
  if (const auto status = context.pending.status(); !status.writable) {
    const std::string why = status.disk_full ? "the disk is full" : "the data folder cannot be written";
    const auto pending = pending_in_words(status);
    refuse("storage-unavailable", pending.empty() ? why : why + "; " + pending);
  }
  return json_response(200, answer::Status{});
}

http::Response get_version(Context& context, http::Request&) {
  return json_response(200, answer::Version{.version = context.config.version});
}

http::Response get_openapi(Context&, http::Request& request) {
  static const auto response = document(openapi_document(), "application/json", "no-cache");
  return http::apply_preconditions(request, response);
}

http::Response get_protocol_specification(Context&, http::Request& request) {
  static const auto response = document(protocol_specification(), "text/markdown; charset=utf-8", "no-cache");
  return http::apply_preconditions(request, response);
}

http::Response get_packed_tables(Context&, http::Request& request) {
  static const auto response = document(packed_tables_document(), "application/json", http::cache_forever);
  return http::apply_preconditions(request, response);
}

http::Response get_problem(Context&, http::Request& request) {
  const auto& slug = request.params.at("slug");
  for (const auto& kind : http::problem_kinds())
    if (kind.slug == slug)
      return json_response(200, answer::ProblemKind{.type = "/problems/" + slug,
                                                    .title = std::string(kind.title),
                                                    .status = static_cast<std::uint64_t>(kind.status)});
  refuse("not-found", "there is no problem " + slug);
}

}  // namespace semblante::api
