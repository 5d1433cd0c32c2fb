#include "server/log/thread_rank.h"

#include <algorithm>
#include <cerrno>
#include <sched.h>
#include <unistd.h>

#include <sys/resource.h>

namespace semblante::log {
namespace {

/// By how many steps of nice.
int behind(ThreadRank rank) {
  switch (rank) {
    case ThreadRank::live:
      return 0;
    case ThreadRank::requests:
      return 10;
    case ThreadRank::jobs:
      return 15;
    case ThreadRank::handshakes:
      return 19;
  }
  return 0;
}

}  // namespace

void set_thread_rank(ThreadRank rank) noexcept {
  // On Linux both are of the thread. Batch: when it wakes up it does not take the processor from another one.
  const sched_param none{};
  ::sched_setscheduler(0, SCHED_BATCH, &none);
  const auto thread = static_cast<id_t>(::gettid());
  errno = 0;
  const int now = ::getpriority(PRIO_PROCESS, thread);
  constexpr int lowest = 19;
  if (errno == 0) ::setpriority(PRIO_PROCESS, thread, std::min(now + behind(rank), lowest));
}

}  // namespace semblante::log
