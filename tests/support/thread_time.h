#pragma once

#include <ctime>

namespace semblante::test {

/// Processor time of this thread so far, in ms: it does not depend on what else the machine does, though other programs
/// still use the cache.
inline double thread_cpu_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

}  // namespace semblante::test
