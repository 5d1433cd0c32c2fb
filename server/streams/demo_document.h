#pragma once

#include <string_view>

namespace semblante::streams {

/// The text of protocol/examples/performances/minute.json, embedded at compile time.
std::string_view demo_document();

}  // namespace semblante::streams
