#pragma once

#include <string_view>

namespace semblante::streams {

/// protocol/examples/performances/minute.json.
std::string_view demo_document();

}  // namespace semblante::streams
