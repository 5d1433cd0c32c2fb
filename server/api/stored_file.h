#pragma once

#include <string_view>

#include "server/api/api.h"
#include "server/store/records.h"

namespace semblante::api {

/// The response with a stored file: ETag, ranges, and compressed JSON for clients that accept it. Throws DamagedBlob.
http::Response file_response(Context& context, const http::Request& request, const store::ArtefactRecord& artefact,
                             std::string_view cache_control);

}  // namespace semblante::api
