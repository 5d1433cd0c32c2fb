#pragma once

#include <cstddef>

#include "server/http/message.h"
#include "server/store/records.h"

namespace semblante::api {

/// Which level of the package a request for one of its artefacts means: `?lod=1`, or `?max_vertices=8000` for the
/// largest level that has no more; the smallest, when all have more. Without either the full mesh, 0. Refuses both
/// together, what is no number, and a level that is not there.
std::size_t level_of(const http::Request& request, const store::PackageRecord& package);

}  // namespace semblante::api
