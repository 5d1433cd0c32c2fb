#include "server/jobs/process_limits.h"

#include <csignal>
#include <fstream>
#include <string>
#include <unistd.h>

#include <sys/prctl.h>
#include <sys/resource.h>

#include "server/log/thread_rank.h"

namespace semblante::jobs {
namespace {

void limit(pid_t process, int what, std::uint64_t value, std::uint64_t grace = 0) {
  if (value == 0) return;
  const rlimit limits{value, value + grace};
  ::prlimit(process, static_cast<__rlimit_resource>(what), &limits, nullptr);
}

}  // namespace

void limit_process(pid_t process, const WorkerLimits& limits) {
  limit(process, RLIMIT_AS, limits.memory_bytes);
  // SIGXCPU tells the reason; at the hard limit the kernel sends SIGKILL, and would at once if both were equal.
  limit(process, RLIMIT_CPU, limits.cpu_seconds, 1);
  limit(process, RLIMIT_FSIZE, limits.file_bytes);
  const rlimit none{0, 0};
  ::prlimit(process, RLIMIT_CORE, &none, nullptr);
}

void end_before_the_server(pid_t process) {
  constexpr int first_of_all = 1000;
  std::ofstream("/proc/" + std::to_string(process) + "/oom_score_adj") << first_of_all;
}

void limit_this_process(const WorkerLimits& limits) {
  // The kernel kills the worker when its server is killed.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  log::set_thread_rank(log::ThreadRank::jobs);
  limit_process(0, limits);
}

}  // namespace semblante::jobs
