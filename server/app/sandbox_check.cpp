#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <sched.h>
#include <string>
#include <unistd.h>

#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>

#include "server/app/installation_check.h"

namespace semblante {
namespace {

using Level = InstallationFinding::Level;

/// The version of Landlock's interface; 0 without Landlock. The call's number is the same on all architectures.
long landlock_version() {
  constexpr long create_ruleset = 444;
  constexpr unsigned ask_version = 1;
  const long version = ::syscall(create_ruleset, nullptr, std::size_t{0}, ask_version);
  return version < 0 ? 0 : version;
}

/// Whether a process without rights may put itself in namespaces of its own, without network.
bool may_make_namespaces() {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(::unshare(CLONE_NEWUSER | CLONE_NEWNET) == 0 ? 0 : 1);
  int status = 0;
  return child > 0 && ::waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

InstallationFindings check_sandbox() {
  InstallationFindings findings;
  std::string actions;
  std::getline(std::ifstream("/proc/sys/kernel/seccomp/actions_avail"), actions);
  const bool has_filters = ::prctl(PR_GET_SECCOMP) >= 0 && actions.find("kill_process") != std::string::npos;
  if (has_filters)
    findings.push_back({Level::ok, "seccomp", "this kernel filters system calls", ""});
  else
    findings.push_back({Level::warning, "seccomp", "this kernel, or the container, has no filter of system calls",
                        "Use a kernel with CONFIG_SECCOMP_FILTER; models are still read in a process with limits."});
  const auto landlock = landlock_version();
  findings.push_back({Level::ok, "Landlock",
                      landlock > 0 ? "version " + std::to_string(landlock) : "not offered by this kernel (optional)",
                      ""});
  findings.push_back(
      {Level::ok, "namespaces",
       may_make_namespaces() ? "this account may make its own" : "this account may not make its own (optional)", ""});
  return findings;
}

}  // namespace semblante
