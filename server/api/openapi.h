#pragma once

#include <string_view>

namespace semblante::api {

/// openapi.json of this folder, embedded at compile time.
std::string_view openapi_document();

}  // namespace semblante::api
