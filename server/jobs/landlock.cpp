#include "server/jobs/landlock.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <unistd.h>

#include <linux/landlock.h>
#include <sys/syscall.h>

namespace semblante::jobs {
namespace {

/// The structure of the newest kernel: the system's header may be older than the kernel. An older kernel takes its
/// beginning.
struct Handled {
  std::uint64_t files, network, scopes;
};

constexpr std::uint64_t bits(unsigned count) { return (std::uint64_t{1} << count) - 1; }

/// What is forbidden unless a rule allows it.
Handled handled_by(int version) {
  unsigned files = 13;           // up to LANDLOCK_ACCESS_FS_MAKE_SYM
  if (version >= 2) files = 14;  // REFER
  if (version >= 3) files = 15;  // TRUNCATE
  if (version >= 5) files = 16;  // IOCTL_DEV
  return {bits(files), version >= 4 ? bits(2) : 0, version >= 6 ? bits(2) : 0};
}

std::size_t size_of(int version) {
  if (version >= 6) return sizeof(Handled);
  return version >= 4 ? 2 * sizeof(std::uint64_t) : sizeof(std::uint64_t);
}

Error failed(const char* step) {
  return {ErrorCode::internal, "", std::string("Landlock: ") + step + ": " + std::strerror(errno)};
}

class Descriptor {
 public:
  explicit Descriptor(long number) : number_(static_cast<int>(number)) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int number() const { return number_; }

 private:
  const int number_;
};

}  // namespace

Result<int> restrict_files(const std::filesystem::path& folder, int highest_version) {
  const long offered = ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  if (offered <= 0) return 0;  // not compiled in, not enabled at boot, or forbidden by a container
  const int version = std::min({static_cast<int>(offered), highest_version, newest_landlock});

  const auto handled = handled_by(version);
  const Descriptor rules(::syscall(SYS_landlock_create_ruleset, &handled, size_of(version), 0));
  if (rules.number() < 0) return failed("landlock_create_ruleset");
  const Descriptor opened(::open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  if (opened.number() < 0)
    return Error{ErrorCode::io, "", "the folder of a job's results: " + std::string(std::strerror(errno))};
  const landlock_path_beneath_attr may_create{LANDLOCK_ACCESS_FS_MAKE_REG | LANDLOCK_ACCESS_FS_WRITE_FILE,
                                              opened.number()};
  if (::syscall(SYS_landlock_add_rule, rules.number(), LANDLOCK_RULE_PATH_BENEATH, &may_create, 0) != 0)
    return failed("landlock_add_rule");
  if (::syscall(SYS_landlock_restrict_self, rules.number(), 0) != 0) return failed("landlock_restrict_self");
  return version;
}

}  // namespace semblante::jobs
