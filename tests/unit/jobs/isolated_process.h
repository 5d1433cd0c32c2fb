#pragma once

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <unistd.h>

#include <gtest/gtest.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <sys/syscall.h>
#include <sys/wait.h>

#include "server/jobs/isolation.h"
#include "tests/unit/jobs/sanitized.h"

namespace semblante::jobs {

inline constexpr int possible = 0;  ///< what an attempt returns when it succeeded; else errno
inline constexpr int not_isolated = 250;

/// How a process ended: its exit code, or 1000 and its signal.
inline int ended(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFSIGNALED(status) ? 1000 + WTERMSIG(status) : WEXITSTATUS(status);
}
inline constexpr int killed = 1000 + SIGSYS;

inline int as_errno(bool succeeded) { return succeeded ? possible : errno; }

/// What the kernel itself says of its means.
inline int offered_landlock() {
  return static_cast<int>(
      std::max(0L, ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION)));
}
inline bool offers_seccomp() {
  const std::uint32_t action = SECCOMP_RET_KILL_PROCESS;
  return ::syscall(SYS_seccomp, SECCOMP_GET_ACTION_AVAIL, 0, &action) == 0;
}

class IsolationTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (testing::is_sanitized) GTEST_SKIP() << "workers are not isolated in a build with a sanitizer";
    std::string name = (std::filesystem::temp_directory_path() / "semblante-isolation-XXXXXX").string();
    top_ = mkdtemp(name.data());
    std::filesystem::create_directory(folder());
    std::ofstream(foreign()) << "of another job";
    std::ofstream(result()) << "written before";
  }
  void TearDown() override {
    if (!top_.empty()) std::filesystem::remove_all(top_);
  }
  [[nodiscard]] std::filesystem::path folder() const { return top_ / "job"; }
  [[nodiscard]] std::filesystem::path foreign() const { return top_ / "foreign"; }
  [[nodiscard]] std::filesystem::path result() const { return folder() / "result"; }

  /// What becomes of an attempt after isolation.
  int attempt(const std::function<int()>& deed, IsolationMeans means = {}) const {
    const Isolation wanted{means.system_calls, std::min(means.highest_landlock, offered_landlock())};
    const pid_t child = ::fork();
    if (child != 0) return ended(child);
    const auto isolated = isolate_this_process(folder(), means);
    if (!isolated || *isolated != wanted) ::_exit(not_isolated);
    ::_exit(deed());
  }

  std::filesystem::path top_;
};

}  // namespace semblante::jobs
