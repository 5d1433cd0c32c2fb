#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/api/api.h"

namespace semblante::api {

/// Whose limit holds for a body, and where it is kept while it arrives.
enum class BodyKind {
  none,         ///< a body is read and ignored
  json,         ///< in memory; a form (multipart/form-data) as an upload
  upload,       ///< a model: to disk
  performance,  ///< of a performance's size, to disk
  fap,          ///< a .fap file, to disk
};

/// What the body of a route may be.
struct RouteBody {
  BodyKind kind = BodyKind::none;
  std::span<const std::string_view> types = {};  ///< media types that are read
  bool announced = false;                        ///< without its length, or chunks, it is refused with 411
};

/// Where a route is handled. `at_once`: on the connection's strand, so that it answers when every worker is busy; its
/// handler must not wait for a lock, the disk or the store.
enum class Runs { on_worker, at_once };

using Handler = http::Response (*)(Context& context, http::Request& request);

/// One operation. The table is generated from openapi.json (codegen/README.md); handlers.h declares the handlers.
struct Route {
  std::string_view method;
  std::string_view pattern;  ///< "/v1/models/{model}": a {name} takes one segment
  RouteBody body;
  std::string_view produces;  ///< media type of the good answer; "" for none, "*/*" for what the artefact is
  Handler handler;
  Runs runs;
};

std::span<const Route> routes();

/// What a request is for.
struct Match {
  const Route* route = nullptr;               ///< none: the path is of no route, or of none with this method
  std::string allow;                          ///< the methods of the path, as in Allow; empty: there is no such path
  std::map<std::string, std::string> params;  ///< what the names of the pattern stand for
};
/// HEAD finds the route of GET.
Match match_route(std::string_view method, std::string_view path);

}  // namespace semblante::api
