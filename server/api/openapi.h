#pragma once

#include <string_view>

namespace semblante::api {

/// openapi.json of this folder, compiled in.
std::string_view openapi_document();

}  // namespace semblante::api
