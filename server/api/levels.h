#pragma once

#include <cstddef>

#include "server/http/message.h"
#include "server/store/records.h"

namespace semblante::api {

/// The level of detail that a request for an artefact of the package selects: `?lod=1`, or `?max_vertices=8000` for the
/// largest level with no more vertices; the smallest level, when all have more. Without either 0, the full mesh.
/// Refuses both together, a value that is not a number, and a level that does not exist.
std::size_t level_of(const http::Request& request, const store::PackageRecord& package);

}  // namespace semblante::api
