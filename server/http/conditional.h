#pragma once

#include <string_view>

#include "server/http/message.h"

namespace semblante::http {

/// The value of Cache-Control for content that never changes at its address.
inline constexpr std::string_view cache_forever = "public, max-age=31536000, immutable";

/// Whether a list of entity tags (`If-Match`, `If-None-Match`) contains this one. `weak`: W/"x" matches "x" too.
bool etag_matches(std::string_view list, std::string_view etag, bool weak);

/// Converts a full 200 answer with an ETag to 304 or 412 by the request's If-Match and If-None-Match (RFC 9110 section
/// 13.2). Other answers are not changed.
Response apply_preconditions(const Request& request, Response response);

/// For files: the same, and to 206 or 416 by If-Range and Range. One range is served; for several ranges the full
/// content, as the RFC allows.
Response apply_conditions(const Request& request, Response response);

}  // namespace semblante::http
