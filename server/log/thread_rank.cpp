#include "server/log/thread_rank.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <sched.h>
#include <unistd.h>

#include <sys/resource.h>
#include <sys/syscall.h>

namespace semblante::log {
namespace {

/// By how many steps of nice.
int behind(ThreadRank rank) {
  switch (rank) {
    case ThreadRank::batches:
    case ThreadRank::live:
      return 0;
    case ThreadRank::requests:
      return 10;
    case ThreadRank::jobs:
      return 15;
  }
  return 0;
}

/// The first version of the kernel's struct sched_attr, for which the C library has no declaration.
struct SchedulingAttributes {
  std::uint32_t size, policy;
  std::uint64_t flags;
  std::int32_t nice;
  std::uint32_t priority;
  std::uint64_t runtime, deadline, period;
};

/// From Linux 6.12 on, a thread with shorter turns takes the processor when it wakes up, where it would wait for the
/// end of another one's turn of some milliseconds; its share stays the same. Earlier kernels ignore it.
void set_short_turns(int nice) {
  constexpr std::uint64_t keep_policy = 0x08;  // SCHED_FLAG_KEEP_POLICY
  constexpr std::uint64_t turn_ns = 100'000;   // the shortest there is
  SchedulingAttributes attributes{sizeof attributes, SCHED_OTHER, keep_policy, nice, 0, turn_ns, 0, 0};
  ::syscall(SYS_sched_setattr, 0, &attributes, 0);
}

}  // namespace

void set_thread_rank(ThreadRank rank) noexcept {
  // On Linux all of this is of the thread.
  const auto thread = static_cast<id_t>(::gettid());
  errno = 0;
  const int now = ::getpriority(PRIO_PROCESS, thread);
  if (errno != 0) return;
  if (rank == ThreadRank::batches) return set_short_turns(now);
  // Batch: when it wakes up it does not take the processor from another one.
  const sched_param none{};
  ::sched_setscheduler(0, SCHED_BATCH, &none);
  constexpr int lowest = 19;
  ::setpriority(PRIO_PROCESS, thread, std::min(now + behind(rank), lowest));
}

}  // namespace semblante::log
