#pragma once

#include <string_view>

#include "server/api/api.h"
#include "server/store/records.h"

namespace semblante::api {

/// A file of the store: with its ETag, in ranges, JSON packed for who takes that. Throws DamagedBlob.
http::Response file_response(Context& context, const http::Request& request, const store::ArtefactRecord& artefact,
                             std::string_view cache_control);

}  // namespace semblante::api
