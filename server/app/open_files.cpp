#include "server/app/open_files.h"

#include <algorithm>
#include <string>

#include <sys/resource.h>

#include "server/log/log.h"

namespace semblante {
namespace {

/// Descriptors for the store, blobs in transfer, and pipes of workers.
constexpr std::uint64_t reserve = 512;
/// Bounds the memory when the system has no limit: about 8 KiB per connection.
constexpr std::uint64_t most = 65'536;

}  // namespace

std::uint32_t connections_to_serve(std::uint64_t wanted) {
  rlimit files{};
  std::uint64_t may_open = 1024;
  if (::getrlimit(RLIMIT_NOFILE, &files) == 0) {
    files.rlim_cur = files.rlim_max;
    if (::setrlimit(RLIMIT_NOFILE, &files) != 0) ::getrlimit(RLIMIT_NOFILE, &files);
    may_open = files.rlim_cur;
  }
  const auto possible = may_open > 2 * reserve ? may_open - reserve : std::max<std::uint64_t>(may_open / 2, 1);
  if (wanted == 0) return static_cast<std::uint32_t>(std::min(possible, most));
  if (wanted > possible)
    log::warning("--max-connections: the process may have " + std::to_string(may_open) +
                 " files open (ulimit -Hn): " + std::to_string(possible) + " connections are served");
  return static_cast<std::uint32_t>(std::min(wanted, possible));
}

}  // namespace semblante
