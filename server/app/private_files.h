#pragma once

#include <string>
#include <vector>

#include "server/app/serve.h"

namespace semblante {

/// A sentence for each private file or folder that lies within the web root, whose files anybody can read.
std::vector<std::string> private_files_in_web_root(const ServeOptions& options);

}  // namespace semblante
