#include "server/jobs/isolation.h"

#include <cerrno>
#include <cstring>
#include <unistd.h>

#include <sys/prctl.h>
#include <sys/wait.h>

#include "protocol/hash/sha256.h"
#include "server/jobs/system_call_filter.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SEMBLANTE_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define SEMBLANTE_SANITIZED 1
#endif
#endif

namespace semblante::jobs {
namespace {

#ifdef SEMBLANTE_SANITIZED
constexpr bool is_sanitized = true;
#else
constexpr bool is_sanitized = false;
#endif

/// Exit code of the child of available_isolation().
constexpr int failed_code = 255;
constexpr int filter_bit = 64;  // above every version of Landlock known here
static_assert(newest_landlock < filter_bit);

}  // namespace

Result<Isolation> isolate_this_process(const std::filesystem::path& folder, IsolationMeans means) {
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0)
    return Error{ErrorCode::internal, "", std::string("PR_SET_NO_NEW_PRIVS: ") + std::strerror(errno)};
  Isolation isolation;
  if (is_sanitized) return isolation;
  // OpenSSL reads its configuration at the first use.
  sha256_hex("");
  if (means.highest_landlock > 0) {
    const auto version = restrict_files(folder, means.highest_landlock);
    if (!version) return version.error();
    isolation.landlock = *version;
  }
  if (means.system_calls) {
    const auto filtered = filter_system_calls();
    if (!filtered) return filtered.error();
    isolation.system_calls = *filtered;
  }
  return isolation;
}

Isolation available_isolation(const std::filesystem::path& folder) {
  const pid_t child = ::fork();
  if (child < 0) return {};
  if (child == 0) {
    const auto isolation = isolate_this_process(folder);
    ::_exit(isolation ? isolation->landlock + (isolation->system_calls ? filter_bit : 0) : failed_code);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) == failed_code) return {};
  return {WEXITSTATUS(status) >= filter_bit, WEXITSTATUS(status) % filter_bit};
}

std::string missing_isolation(const Isolation& isolation) {
  if (isolation.is_whole()) return {};
  if (is_sanitized) return "workers are not isolated in a build with a sanitizer";
  if (isolation.landlock > 0)
    return "this system forbids seccomp: a worker that a model takes over could use the network and start programs";
  if (isolation.system_calls)
    return "this system has no Landlock: a worker that a model takes over could create files wherever the server may";
  return "this system has neither seccomp nor Landlock: a worker that a model takes over could do all that the server "
         "may";
}

}  // namespace semblante::jobs
