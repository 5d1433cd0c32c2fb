#pragma once

#include <string_view>

#include "server/http/message.h"

namespace semblante::http {

/// Whether a list of entity tags (`If-Match`, `If-None-Match`) names this one. `weak`: W/"x" matches "x" too.
bool etag_matches(std::string_view list, std::string_view etag, bool weak);

/// Turns a full 200 answer that carries an ETag into 304, 412, 206 or 416 as the request's If-Match, If-None-Match,
/// If-Range and Range ask (RFC 9110 section 13.2). Answers other than 200 pass unchanged. One range is served; of
/// several, as the RFC allows, the whole.
Response apply_conditions(const Request& request, Response response);

}  // namespace semblante::http
