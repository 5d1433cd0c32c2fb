#include <nlohmann/json.hpp>

#include "protocol/hash/sha256.h"
#include "server/api/common.h"
#include "server/api/generated/handlers.h"
#include "server/api/openapi.h"
#include "server/api/storage_problems.h"
#include "server/http/conditional.h"

namespace semblante::api {

http::Response get_health(Context&, http::Request&) { return json_response(200, answer::Status{}); }

http::Response get_ready(Context& context, http::Request&) {
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
      return json_response(200, answer::ProblemKind{.type = "/problems/" + slug,
                                                    .title = std::string(kind.title),
                                                    .status = static_cast<std::uint64_t>(kind.status)});
  refuse("not-found", "there is no problem " + slug);
}

}  // namespace semblante::api
