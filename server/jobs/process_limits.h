#pragma once

#include <cstdint>

#include <sys/types.h>

namespace semblante::jobs {

/// The limits of a worker process, in force before it reads a stranger's byte. 0: no limit.
struct WorkerLimits {
  std::uint64_t memory_bytes = std::uint64_t{4} << 30U;
  std::uint64_t cpu_seconds = 300;
  std::uint64_t file_bytes = std::uint64_t{1} << 30U;
};

/// Sets the limits of this process, and its death signal on the parent's end. To be called before a byte of a model is
/// read.
void limit_this_process(const WorkerLimits& limits);

/// Sets the limits of a child that does not limit itself.
void limit_process(pid_t process, const WorkerLimits& limits);

/// Where the memory of the machine, or of the container, is used up, the kernel ends this child and not the server.
/// Without /proc it stays the kernel's choice.
void end_before_the_server(pid_t process);

}  // namespace semblante::jobs
