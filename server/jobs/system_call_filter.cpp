#include "server/jobs/system_call_filter.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <memory>
#include <seccomp.h>
#include <string>
#include <unistd.h>

#include <linux/seccomp.h>
#include <sys/mman.h>
#include <sys/syscall.h>

namespace semblante::jobs {
namespace {

// Names, because a call that this C library or architecture does not have must not stop the build. Different
// architectures, kernels and versions of the C library use different ones of those with the same meaning.
constexpr const char* allowed[] = {
    // open descriptors: input files, the pipes to the server, results
    "read", "pread64", "readv", "write", "pwrite64", "writev", "close", "fstat", "lseek", "fsync", "fdatasync",
    // memory
    "brk", "munmap", "mremap", "madvise",
    // time
    "clock_gettime", "gettimeofday", "clock_getres", "clock_nanosleep", "nanosleep", "restart_syscall",
    // what the C library asks about the process and the machine; sysinfo: qsort, for the memory
    "getpid", "gettid", "getrusage", "sysinfo", "sched_getaffinity", "sched_yield", "futex", "getrandom",
    // the end, and abort()
    "exit", "exit_group", "rt_sigaction", "rt_sigprocmask", "rt_sigreturn"};

// Questions about files. Libraries ask them for optional ones, and go on without.
constexpr const char* refused[] = {"open",  "openat2",  "access",     "faccessat", "faccessat2", "stat",
                                   "lstat", "readlink", "readlinkat", "getcwd",    "statx"};

/// How result_files creates a file. O_EXCL: an existing one is never opened.
constexpr int creating = O_WRONLY | O_CREAT | O_EXCL;
/// Flags that change nothing about what is opened.
constexpr int harmless = O_CLOEXEC | O_NOFOLLOW | O_LARGEFILE | O_NOCTTY;

struct Release {
  void operator()(void* filter) const { seccomp_release(filter); }
};
using Filter = std::unique_ptr<void, Release>;

/// The first error of several rules.
class Rules {
 public:
  explicit Rules(scmp_filter_ctx filter) : filter_(filter) {}
  template <class... Conditions>
  void add(std::uint32_t action, const char* name, Conditions... conditions) {
    const int number = seccomp_syscall_resolve_name(name);
    if (number == __NR_SCMP_ERROR || number < 0) return;  // not on this architecture
    const scmp_arg_cmp list[] = {conditions..., scmp_arg_cmp{}};
    const int code = seccomp_rule_add_array(filter_, action, number, sizeof...(conditions), list);
    if (code != 0 && error_ == 0) error_ = code;
  }
  [[nodiscard]] int error() const { return error_; }

 private:
  scmp_filter_ctx filter_;
  int error_ = 0;
};

scmp_arg_cmp masked(unsigned argument, scmp_datum_t mask, scmp_datum_t value) {
  return {argument, SCMP_CMP_MASKED_EQ, mask, value};
}

int add_rules(scmp_filter_ctx filter) {
  Rules rules(filter);
  for (const char* const name : allowed) rules.add(SCMP_ACT_ALLOW, name);
  for (const char* const name : refused) rules.add(SCMP_ACT_ERRNO(EACCES), name);
  rules.add(SCMP_ACT_ERRNO(ENOTTY), "ioctl");
  // Data, never code.
  rules.add(SCMP_ACT_ALLOW, "mmap", masked(2, PROT_EXEC, 0));
  rules.add(SCMP_ACT_ALLOW, "mprotect", masked(2, PROT_EXEC, 0));
  // fstat() of newer C libraries, and a path too if a library asks for one: facts of a file, not its content.
  rules.add(SCMP_ACT_ALLOW, "newfstatat", masked(3, AT_EMPTY_PATH, AT_EMPTY_PATH));
  rules.add(SCMP_ACT_ERRNO(EACCES), "newfstatat", masked(3, AT_EMPTY_PATH, 0));
  // Each bit of the flags that is not harmless must be as in `creating`; otherwise it is refused, one rule for each
  // such bit, for a filter has no "not equal" under a mask.
  constexpr auto all_flags = static_cast<scmp_datum_t>(0xFFFFFFFFU);
  constexpr auto looked_at = all_flags & ~static_cast<scmp_datum_t>(harmless);
  rules.add(SCMP_ACT_ALLOW, "openat", masked(2, looked_at, creating));
  for (unsigned bit = 0; bit < 32; ++bit) {
    const auto flag = scmp_datum_t{1} << bit;
    if ((flag & looked_at) != 0) rules.add(SCMP_ACT_ERRNO(EACCES), "openat", masked(2, flag, flag & ~creating));
  }
  // abort() sends its signal to the own thread.
  const auto self = static_cast<scmp_datum_t>(::getpid());
  rules.add(SCMP_ACT_ALLOW, "tgkill", scmp_arg_cmp{0, SCMP_CMP_EQ, self, 0});
  return rules.error();
}

/// Whether the kernel offers what the filter needs, and lets this process use it.
bool is_offered() {
  const std::uint32_t action = SECCOMP_RET_KILL_PROCESS;
  return ::syscall(SYS_seccomp, SECCOMP_GET_ACTION_AVAIL, 0, &action) == 0;
}

Error failed(const char* step, int code) {
  return {ErrorCode::internal, "", std::string("the filter of system calls: ") + step + ": " + std::strerror(-code)};
}

}  // namespace

Result<bool> filter_system_calls() {
  if (!is_offered()) return false;
  const Filter filter(seccomp_init(SCMP_ACT_KILL_PROCESS));
  if (!filter) return failed("seccomp_init", -ENOMEM);
  // Calls in the manner of another architecture (32 bit) would pass by the rules.
  if (const int code = seccomp_attr_set(filter.get(), SCMP_FLTATR_ACT_BADARCH, SCMP_ACT_KILL_PROCESS); code != 0)
    return failed("seccomp_attr_set", code);
  // The kernel's own errors instead of one that stands for all.
  if (const int code = seccomp_attr_set(filter.get(), SCMP_FLTATR_API_SYSRAWRC, 1); code != 0)
    return failed("seccomp_attr_set", code);
  // Threads that a library has started before.
  if (const int code = seccomp_attr_set(filter.get(), SCMP_FLTATR_CTL_TSYNC, 1); code != 0)
    return failed("seccomp_attr_set", code);
  if (const int code = add_rules(filter.get()); code != 0) return failed("seccomp_rule_add", code);
  if (const int code = seccomp_load(filter.get()); code != 0) {
    // A container's own filter may refuse the call that loads it.
    if (code == -EPERM || code == -EACCES || code == -ENOSYS) return false;
    return failed("seccomp_load", code);
  }
  return true;
}

}  // namespace semblante::jobs
