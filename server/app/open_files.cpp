#include "server/app/open_files.h"

#include <algorithm>
#include <string>

#include <sys/resource.h>

#include "server/app/serve_failure.h"
#include "server/log/log.h"

namespace semblante {
namespace {

/// Descriptors for the store, recordings, exports and pipes of workers.
constexpr std::uint64_t reserve = 512;
/// Left for files of bodies by any number of connections, if the process may open so many.
constexpr std::uint64_t least_bodies = 256;
/// The server itself has 15 files open. The others are for a request, a job and a voice at the same time.
constexpr std::uint64_t fewest = 64;
/// Bounds the memory when the system has no limit: about 8 KiB per connection.
constexpr std::uint64_t most = 65'536;

}  // namespace

OpenFiles divide_open_files(std::uint64_t may_open, std::uint64_t wanted) {
  const auto possible = may_open > 2 * reserve ? may_open - reserve : may_open / 2;
  // A connection that receives or sends a file has two descriptors. Who asks for many connections gets them, for most
  // of them may be subscribers, which have one.
  const auto for_bodies = wanted == 0 ? possible / 4 : std::min(least_bodies, possible / 4);
  const auto connections = std::min({wanted == 0 ? most : wanted, possible - for_bodies, std::uint64_t{UINT32_MAX}});
  const auto bodies = std::min(possible - connections, connections);
  return {static_cast<std::uint32_t>(std::max<std::uint64_t>(connections, 1)),
          static_cast<std::uint32_t>(std::max<std::uint64_t>(bodies, 1))};
}

OpenFiles open_files_to_serve(std::uint64_t wanted) {
  rlimit files{};
  std::uint64_t may_open = 1024;
  if (::getrlimit(RLIMIT_NOFILE, &files) == 0) {
    files.rlim_cur = files.rlim_max;
    if (::setrlimit(RLIMIT_NOFILE, &files) != 0) ::getrlimit(RLIMIT_NOFILE, &files);
    may_open = files.rlim_cur;
  }
  if (may_open < fewest)
    fail_serve("the process may have " + std::to_string(may_open) + " files open (ulimit -Hn), and a server needs " +
               std::to_string(fewest));
  const auto divided = divide_open_files(may_open, wanted);
  if (wanted > divided.connections)
    log::warning("--max-connections: the process may have " + std::to_string(may_open) +
                 " files open (ulimit -Hn): " + std::to_string(divided.connections) + " connections are served");
  return divided;
}

}  // namespace semblante
