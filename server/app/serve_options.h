#pragma once

#include "server/app/serve.h"

namespace CLI {
class App;
}

namespace semblante {

/// Declares the options of `serve` for a subcommand, with their environment variables and ranges. `options` must
/// outlive the command line.
void declare_serve_options(CLI::App& command, ServeOptions& options);

}  // namespace semblante
