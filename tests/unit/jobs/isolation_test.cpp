// What an isolated process can do, each attempt in a process of its own.
#include "server/jobs/isolation.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <functional>
#include <memory>
#include <seccomp.h>
#include <stdexcept>
#include <thread>
#include <unistd.h>
#include <vector>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <sys/mman.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/wait.h>

#include "protocol/hash/sha256.h"
#include "server/jobs/input_files.h"
#include "tests/unit/jobs/isolated_process.h"

namespace semblante::jobs {
namespace {

int open_file(const std::filesystem::path& path, int flags) { return as_errno(::open(path.c_str(), flags, 0600) >= 0); }

constexpr IsolationMeans filter_alone{true, 0};
constexpr IsolationMeans landlock_alone(int version) { return {false, version}; }

class SystemCallFilter : public IsolationTest {
 protected:
  void SetUp() override {
    if (!offers_seccomp()) GTEST_SKIP() << "no seccomp here";
    IsolationTest::SetUp();
  }
};

class LandlockTest : public IsolationTest {
 protected:
  void SetUp() override {
    if (offered_landlock() == 0) GTEST_SKIP() << "no Landlock here";
    IsolationTest::SetUp();
  }
};

TEST_F(SystemCallFilter, NetworkProcessesAndPrivileges_Kill) {
  const struct {
    const char* name;
    std::function<int()> deed;
  } deeds[] = {
      {"socket of IPv4", [] { return as_errno(::socket(AF_INET, SOCK_STREAM, 0) >= 0); }},
      {"local socket", [] { return as_errno(::socket(AF_UNIX, SOCK_STREAM, 0) >= 0); }},
      {"socketpair",
       [] {
         int ends[2];
         return as_errno(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends) == 0);
       }},
      {"fork", [] { return as_errno(::fork() >= 0); }},
      {"vfork", [] { return as_errno(::syscall(SYS_vfork) >= 0); }},
      {"clone3", [] { return as_errno(::syscall(SYS_clone3, nullptr, 0) >= 0); }},
      {"execve", [] { return as_errno(::execl("/bin/true", "true", nullptr) == 0); }},
      {"ptrace", [] { return as_errno(::ptrace(PTRACE_ATTACH, ::getppid(), nullptr, nullptr) == 0); }},
      {"process_vm_readv", [] { return as_errno(::process_vm_readv(::getppid(), nullptr, 0, nullptr, 0, 0) >= 0); }},
      {"pidfd_open", [] { return as_errno(::syscall(SYS_pidfd_open, ::getpid(), 0) >= 0); }},
      {"kill", [] { return as_errno(::kill(::getpid(), 0) == 0); }},
      {"tgkill of another", [] { return as_errno(::syscall(SYS_tgkill, 1, 1, 0) == 0); }},
      {"prctl", [] { return as_errno(::prctl(PR_SET_PDEATHSIG, 0) == 0); }},
      {"setrlimit",
       [] {
         rlimit limit{1, 1};
         return as_errno(::setrlimit(RLIMIT_CPU, &limit) == 0);
       }},
      {"setuid", [] { return as_errno(::setuid(0) == 0); }},
      {"mount", [] { return as_errno(::mount("none", "/tmp", "tmpfs", 0, nullptr) == 0); }},
      {"unshare", [] { return as_errno(::syscall(SYS_unshare, 0) == 0); }},
      {"chroot", [] { return as_errno(::chroot("/") == 0); }},
      {"bpf", [] { return as_errno(::syscall(SYS_bpf, 0, nullptr, 0) >= 0); }},
      {"io_uring_setup", [] { return as_errno(::syscall(SYS_io_uring_setup, 1, nullptr) >= 0); }},
      {"userfaultfd", [] { return as_errno(::syscall(SYS_userfaultfd, 0) >= 0); }},
      {"memfd_create", [] { return as_errno(::syscall(SYS_memfd_create, "", 0) >= 0); }},
      {"shmget", [] { return as_errno(::syscall(SYS_shmget, 1, 4096, 0) >= 0); }},
      {"keyctl", [] { return as_errno(::syscall(SYS_keyctl, 0, 0) >= 0); }},
      {"no call at all", [] { return as_errno(::syscall(100'000) >= 0); }},
  };
  for (const auto& [name, deed] : deeds) EXPECT_EQ(attempt(deed, filter_alone), killed) << name;
}

TEST_F(SystemCallFilter, Threads_Kill) {
  EXPECT_EQ(attempt([] {
              std::thread([] {}).join();
              return possible;
            }),
            killed);
}

TEST_F(SystemCallFilter, ExecutableMemory_Kills) {
  constexpr std::size_t page = 4096;
  const auto map = [](int protection) { return ::mmap(nullptr, page, protection, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0); };
  EXPECT_EQ(attempt([&] { return as_errno(map(PROT_READ | PROT_WRITE | PROT_EXEC) != MAP_FAILED); }), killed);
  EXPECT_EQ(
      attempt([&] { return as_errno(::mprotect(map(PROT_READ | PROT_WRITE), page, PROT_READ | PROT_EXEC) == 0); }),
      killed);
  EXPECT_EQ(attempt([&] { return as_errno(::mprotect(map(PROT_READ | PROT_WRITE), page, PROT_READ) == 0); }), possible);
}

#ifdef __x86_64__
/// The numbers of system calls are others there: getpid of 64 bit, 39, is mkdir of 32 bit.
TEST_F(SystemCallFilter, CallsOfThe32BitKind_Kill) {
  const auto deed = [] {
    long number = 20;  // getpid
    asm volatile("int $0x80" : "+a"(number) : : "memory");
    return possible;
  };
  EXPECT_GE(attempt(deed, filter_alone), 1000) << "a kernel without them raises another signal";
  EXPECT_EQ(attempt([] { return as_errno(::syscall(0x40000000 | SYS_getpid) > 0); }, filter_alone), killed) << "x32";
}
#endif

/// Without Landlock too: by the flags of openat alone.
TEST_F(SystemCallFilter, ExistingFiles_AreNotOpened) {
  for (const auto& path : {foreign(), result(), std::filesystem::path("/etc/passwd"),
                           std::filesystem::path("/proc/self/mem"), std::filesystem::path("/dev/null")}) {
    for (const int flags :
         {O_RDONLY, O_WRONLY, O_RDWR, O_PATH, O_WRONLY | O_TRUNC, O_WRONLY | O_CREAT, O_RDWR | O_CREAT,
          O_RDONLY | O_CREAT | O_EXCL, O_RDWR | O_CREAT | O_EXCL, O_WRONLY | O_APPEND, O_WRONLY | O_CREAT | O_TRUNC,
          O_RDONLY | O_DIRECTORY, O_RDONLY | O_CLOEXEC, O_WRONLY | O_CREAT | O_EXCL | O_TMPFILE})
      EXPECT_EQ(attempt([&] { return open_file(path, flags); }, filter_alone), EACCES) << path << " " << flags;
    EXPECT_EQ(attempt([&] { return open_file(path, O_WRONLY | O_CREAT | O_EXCL); }, filter_alone), EEXIST) << path;
  }
  // Its upper half is not looked at by the kernel.
  EXPECT_EQ(attempt(
                [&] {
                  const auto flags = (std::uint64_t{1} << 40U) | O_RDONLY;
                  return as_errno(::syscall(SYS_openat, AT_FDCWD, foreign().c_str(), flags, 0) >= 0);
                },
                filter_alone),
            EACCES);
}

TEST_F(SystemCallFilter, FactsOfFiles_AreRefused) {
  struct stat facts {};
  char text[64];
  EXPECT_EQ(attempt([&] { return as_errno(::stat("/etc/passwd", &facts) == 0); }), EACCES);
  EXPECT_EQ(attempt([&] { return as_errno(::access("/etc/passwd", F_OK) == 0); }), EACCES);
  EXPECT_EQ(attempt([&] { return as_errno(::readlink("/proc/self/exe", text, sizeof text) > 0); }), EACCES);
  EXPECT_EQ(attempt([&] { return as_errno(::getcwd(text, sizeof text) != nullptr); }), EACCES);
}

TEST_F(SystemCallFilter, ChangesOfFiles_Kill) {
  const auto path = foreign().string();
  EXPECT_EQ(attempt([&] { return as_errno(::unlink(path.c_str()) == 0); }, filter_alone), killed);
  EXPECT_EQ(attempt([&] { return as_errno(::rename(path.c_str(), (path + "2").c_str()) == 0); }, filter_alone), killed);
  EXPECT_EQ(attempt([&] { return as_errno(::truncate(path.c_str(), 0) == 0); }, filter_alone), killed);
  EXPECT_EQ(attempt([&] { return as_errno(::chmod(path.c_str(), 0777) == 0); }, filter_alone), killed);
  EXPECT_EQ(attempt([&] { return as_errno(::link(path.c_str(), (path + "2").c_str()) == 0); }, filter_alone), killed);
  EXPECT_EQ(attempt([&] { return as_errno(::mkdir((path + "2").c_str(), 0700) == 0); }, filter_alone), killed);
  std::string content;
  std::getline(std::ifstream(path), content);
  EXPECT_EQ(content, "of another job");
}

/// What jobs do stays possible with all means.
TEST_F(IsolationTest, Work_IsPossible) {
  const InputFiles inputs({foreign().string()});
  EXPECT_EQ(attempt([&] {
              const auto bytes = inputs.read(foreign().string());
              return bytes && bytes->size() == 14 ? possible : 1;
            }),
            possible);
  EXPECT_EQ(attempt([&] {
              const int file = ::open((folder() / "new").c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
              return as_errno(file >= 0 && ::write(file, "x", 1) == 1 && ::close(file) == 0);
            }),
            possible);
  EXPECT_TRUE(std::filesystem::exists(folder() / "new"));
  EXPECT_EQ(attempt([] { return sha256_hex("a").size() == 64 ? possible : 1; }), possible);
  EXPECT_EQ(attempt([] {
              std::vector<std::unique_ptr<char[]>> pieces;
              for (std::size_t size = 1; size < (std::size_t{64} << 20U); size *= 2) {
                pieces.push_back(std::make_unique<char[]>(size));
                pieces.back()[size - 1] = 1;
              }
              return possible;
            }),
            possible);
  EXPECT_EQ(attempt([] {
              try {
                throw std::runtime_error("caught");
              } catch (const std::exception&) {
                return possible;
              }
            }),
            possible);
  EXPECT_EQ(attempt([]() -> int { std::abort(); }), 1000 + SIGABRT);
}

/// Each version that a kernel may have: Debian 12 has 2, Debian 13 has 6.
TEST_F(LandlockTest, EveryVersion_ForbidsFilesOutsideTheFolder) {
  for (int version = 1; version <= std::min(offered_landlock(), newest_landlock); ++version) {
    const auto means = landlock_alone(version);
    for (const int flags : {O_RDONLY, O_WRONLY, O_RDWR})
      EXPECT_EQ(attempt([&] { return open_file(foreign(), flags); }, means), EACCES) << version;
    EXPECT_EQ(attempt([] { return open_file("/etc/passwd", O_RDONLY); }, means), EACCES) << version;
    EXPECT_EQ(attempt([&] { return open_file(folder(), O_RDONLY | O_DIRECTORY); }, means), EACCES) << version;
    EXPECT_EQ(attempt([&] { return open_file(result(), O_RDONLY); }, means), EACCES) << version;
    EXPECT_EQ(attempt([&] { return open_file(top_ / "new", O_WRONLY | O_CREAT | O_EXCL); }, means), EACCES) << version;
    EXPECT_EQ(attempt([&] { return open_file(folder() / "../new", O_WRONLY | O_CREAT | O_EXCL); }, means), EACCES);
    EXPECT_EQ(attempt([&] { return as_errno(::unlink(foreign().c_str()) == 0); }, means), EACCES) << version;
    EXPECT_EQ(attempt([&] { return as_errno(::execl("/bin/true", "true", nullptr) == 0); }, means), EACCES) << version;
    const auto name = folder() / ("new" + std::to_string(version));
    EXPECT_EQ(attempt([&] { return open_file(name, O_WRONLY | O_CREAT | O_EXCL); }, means), possible) << version;
  }
}

TEST_F(LandlockTest, FromVersion4_ForbidsTcp_AndFrom6_SignalsToOthers) {
  const auto connect = [] {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(9);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    return as_errno(::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
  };
  const auto signal = [] { return as_errno(::kill(::getppid(), 0) == 0); };
  if (offered_landlock() < 6) GTEST_SKIP() << "Landlock " << offered_landlock();
  EXPECT_EQ(attempt(connect, landlock_alone(3)), ECONNREFUSED);
  EXPECT_EQ(attempt(connect, landlock_alone(4)), EACCES);
  EXPECT_EQ(attempt(signal, landlock_alone(5)), possible);
  EXPECT_EQ(attempt(signal, landlock_alone(6)), EPERM);
}

TEST_F(IsolationTest, Privileges_AreGivenUpWithoutAnyMeans) {
  EXPECT_EQ(attempt([] { return ::prctl(PR_GET_NO_NEW_PRIVS, 0, 0, 0, 0) == 1 ? possible : 1; }, {false, 0}), possible);
}

TEST_F(IsolationTest, Available_IsWhatTheKernelOffers_AndLeavesThisProcessAsItIs) {
  EXPECT_EQ(available_isolation(folder()),
            (Isolation{offers_seccomp(), std::min(offered_landlock(), newest_landlock)}));
  EXPECT_EQ(open_file(foreign(), O_RDONLY), possible);
  EXPECT_EQ(::prctl(PR_GET_NO_NEW_PRIVS, 0, 0, 0, 0), 0);
}

/// Makes the system refuse the means to this process, as the filter of a container may.
bool forbid_means() {
  auto* const filter = seccomp_init(SCMP_ACT_ALLOW);
  bool is_good = filter != nullptr;
  for (const char* const name : {"seccomp", "landlock_create_ruleset", "landlock_add_rule", "landlock_restrict_self"})
    is_good = is_good && seccomp_rule_add(filter, SCMP_ACT_ERRNO(EPERM), seccomp_syscall_resolve_name(name), 0) == 0;
  return is_good && seccomp_load(filter) == 0;
}

TEST_F(SystemCallFilter, ForbiddenMeans_AreLeftOut) {
  const pid_t child = ::fork();
  if (child == 0) {
    const bool is_forbidden = forbid_means();
    const auto isolated = isolate_this_process(folder());
    ::_exit(is_forbidden && isolated && *isolated == Isolation{} ? 0 : 1);
  }
  EXPECT_EQ(ended(child), 0);
}

TEST(Isolation_Words, SayWhatIsMissing) {
  if (testing::is_sanitized) GTEST_SKIP();
  EXPECT_EQ(missing_isolation({true, 1}), "");
  EXPECT_NE(missing_isolation({true, 0}).find("no Landlock"), std::string::npos);
  EXPECT_NE(missing_isolation({false, 6}).find("seccomp"), std::string::npos);
  EXPECT_NE(missing_isolation({}).find("neither"), std::string::npos);
}

}  // namespace
}  // namespace semblante::jobs
