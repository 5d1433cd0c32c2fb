#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/access/scope.h"
#include "server/api/api.h"

namespace semblante::api {

/// The limit of a body, and where it is buffered while it arrives.
enum class BodyKind {
  none,            ///< a body is read and discarded
  json,            ///< in memory; a form (multipart/form-data) of the size of an upload, to disk
  json_or_models,  ///< likewise, whose form has models
  upload,          ///< a model: to disk
  performance,     ///< a performance: to disk
  fap,             ///< a .fap file, to disk
};

/// The body that a route accepts.
struct RouteBody {
  BodyKind kind = BodyKind::none;
  std::span<const std::string_view> types = {};  ///< accepted media types
  bool announced = false;                        ///< refused with 411 without Content-Length or chunked encoding
};

/// Where a handler runs. `at_once`: on the connection's strand, so that it answers even when every worker is busy; such
/// a handler must not wait for a lock, the disk or the store.
enum class Runs { on_worker, at_once };

using Handler = http::Response (*)(Context& context, http::Request& request);

/// One operation. The table is generated from openapi.json (codegen/README.md); handlers.h declares the handlers.
struct Route {
  std::string_view method;
  std::string_view pattern;                 ///< "/v1/models/{model}": a {name} matches one segment
  std::span<const std::string_view> query;  ///< names of its query parameters
  RouteBody body;
  std::string_view produces;  ///< media type of the successful answer; "" for none, "*/*" for that of the artefact
  Handler handler;
  Runs runs;
  access::Scope scope;  ///< what a request needs
};

std::span<const Route> routes();

/// The route of a request.
struct Match {
  const Route* route = nullptr;               ///< null: no route has this path, or none has it with this method
  std::string allow;                          ///< the methods of the path, as in Allow; empty: unknown path
  std::map<std::string, std::string> params;  ///< values of the pattern's {names}
};
/// HEAD finds the route of GET.
Match match_route(std::string_view method, std::string_view path);

}  // namespace semblante::api
