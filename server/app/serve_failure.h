#pragma once

#include <string>

#include "server/cli/command_failure.h"

namespace semblante {

/// Ends `serve` because of what its caller gave: an option, or what it names.
[[noreturn]] inline void fail_serve(const std::string& message) {
  throw CommandFailure(CommandFailure::bad_input, "serve: " + message);
}

}  // namespace semblante
