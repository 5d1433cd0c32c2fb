#pragma once

#include <cstdint>

namespace semblante {

/// What the descriptors of the process are divided into, beside those of the store, recordings and workers.
struct OpenFiles {
  std::uint32_t connections = 1;
  std::uint32_t bodies = 1;  ///< files that connections receive or send
};

/// Divides `may_open` descriptors. `wanted` connections: 0 for the maximum; fewer if they cannot be reached.
OpenFiles divide_open_files(std::uint64_t may_open, std::uint64_t wanted);

/// Raises the limit of open files to its hard limit, and divides it. Warns if not all `wanted` connections are served.
/// Throws CommandFailure if the limit is too low for a server.
OpenFiles open_files_to_serve(std::uint64_t wanted);

}  // namespace semblante
