#include "tests/bench/fanout/server_process.h"

#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <fstream>
#include <sstream>
#include <unistd.h>
#include <utility>

#include <sys/prctl.h>
#include <sys/wait.h>

namespace semblante::bench {
namespace {

constexpr int patience_to_end_ms = 120'000;

/// The next line with an address; empty when the output ends first.
std::string line_with_address(int output) {
  std::string line;
  for (char c = 0; read(output, &c, 1) == 1;) {
    if (c != '\n') {
      line.push_back(c);
    } else if (line.find("://") != std::string::npos) {
      return line;
    } else {
      line.clear();
    }
  }
  return {};
}

}  // namespace

ProcessorTime processor_time(pid_t process) {
  ProcessorTime time;
  clockid_t clock{};
  timespec used{};
  if (clock_getcpuclockid(process, &clock) == 0 && clock_gettime(clock, &used) == 0)
    time.total = static_cast<double>(used.tv_sec) + static_cast<double>(used.tv_nsec) * 1e-9;
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string text((std::istreambuf_iterator<char>(file)), {});
  const auto after_name = text.rfind(')');  // the name may hold anything
  if (after_name == std::string::npos) return time;
  std::istringstream fields(text.substr(after_name + 2));
  std::string skipped;
  for (int i = 0; i < 11; ++i) fields >> skipped;
  const auto ticks = static_cast<double>(sysconf(_SC_CLK_TCK));
  fields >> time.user >> time.system;
  time.user /= ticks;
  time.system /= ticks;
  return time;
}

std::size_t resident_bytes(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/statm");
  std::size_t size = 0, resident = 0;
  file >> size >> resident;
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

std::optional<ServerProcess> ServerProcess::start(const std::vector<std::string>& command) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) give_up(std::string("pipe: ") + std::strerror(errno));
  std::vector<char*> arguments;
  for (const auto& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t pid = fork();
  if (pid == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    dup2(ends[1], STDOUT_FILENO);
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  close(ends[1]);
  const auto line = line_with_address(ends[0]);
  if (line.empty()) {
    close(ends[0]);
    kill(pid, SIGKILL);
    waitpid(pid, nullptr, 0);
    return std::nullopt;
  }
  return ServerProcess(pid, ends[0], parse_endpoint(line));
}

ServerProcess::ServerProcess(ServerProcess&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)), output_(std::exchange(other.output_, -1)), endpoint_(other.endpoint_) {}

ServerProcess::~ServerProcess() {
  if (pid_ > 0) {
    kill(pid_, SIGTERM);
    int waited = 0;
    for (; waited < patience_to_end_ms && waitpid(pid_, nullptr, WNOHANG) == 0; waited += 10) usleep(10'000);
    if (waited >= patience_to_end_ms) {
      std::fprintf(stderr, "bench_fanout: the server did not stop within %d s\n", patience_to_end_ms / 1000);
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
  }
  if (output_ >= 0) close(output_);
}

bool ServerProcess::alive() const { return waitpid(pid_, nullptr, WNOHANG) == 0; }

}  // namespace semblante::bench
