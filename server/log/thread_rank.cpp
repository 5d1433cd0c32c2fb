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

/// As linux/sched/types.h has it, which cannot be included beside sched.h.
struct Attributes {
  std::uint32_t size, policy;
  std::uint64_t flags;
  std::int32_t nice;
  std::uint32_t priority;
  std::uint64_t runtime, deadline, period;
};

/// A thread keeps its processor for the rest of its turn, by default 3 ms, also when one of a higher rank wakes up: a
/// batch would wait for a handshake. Linux 6.12 and later; earlier ones ignore it.
void shorten_turns(int nice) {
  constexpr std::uint64_t turn = 100'000;  // ns, the shortest that there is
  Attributes attributes{};
  attributes.size = sizeof attributes;
  attributes.policy = SCHED_BATCH;
  attributes.nice = nice;
  attributes.runtime = turn;
  ::syscall(SYS_sched_setattr, 0, &attributes, 0U);
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
  if (errno != 0) return;
  const int wanted = std::min(now + behind(rank), lowest);
  ::setpriority(PRIO_PROCESS, thread, wanted);
  if (rank == ThreadRank::handshakes) shorten_turns(wanted);
}

}  // namespace semblante::log
