#pragma once

#include <string>
#include <vector>

#include "server/app/serve.h"

namespace semblante {

/// What is private and lies within the web root, whose files everybody gets who asks: a sentence for each.
std::vector<std::string> private_files_in_web_root(const ServeOptions& options);

}  // namespace semblante
