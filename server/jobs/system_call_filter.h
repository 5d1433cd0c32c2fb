#pragma once

#include "core/types/result.h"

namespace semblante::jobs {

/// Limits this process, all its threads, and all that it starts, to the system calls that a worker needs to compute, to
/// read and write descriptors that are open, and to create files (seccomp, an allow list). A library's attempt to read
/// another file fails with EACCES; every other call kills the process with SIGSYS: sockets, processes, ptrace,
/// executable memory. An existing file cannot be opened at all, neither for reading nor for writing. Cannot be taken
/// back.
///
/// False if the system has no seccomp or forbids it (some containers). Error `internal`: it should have worked.
Result<bool> filter_system_calls();

}  // namespace semblante::jobs
