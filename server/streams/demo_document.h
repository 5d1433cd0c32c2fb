#pragma once

#include <string_view>

namespace semblante::streams {

/// The text of protocol/examples/performances/minute.json, compiled in.
std::string_view demo_document();

}  // namespace semblante::streams
