#pragma once

#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

#include "tests/bench/fanout/loopback.h"

namespace semblante::bench {

/// What a process has used so far, seconds. `total` is the scheduler's own count, to the ns; user and system are the
/// kernel's, in ticks, and add up to it only roughly.
struct ProcessorTime {
  double total = 0.0, user = 0.0, system = 0.0;
};

ProcessorTime processor_time(pid_t process);
/// Resident memory of a process, bytes; 0 when it is gone.
std::size_t resident_bytes(pid_t process);

/// A server as a process of its own, which ends with the object. It must print a line with its address, http:// or
/// https://.
class ServerProcess {
 public:
  /// Nothing, when the program ends without such a line; what it says on standard error is the bench's own.
  static std::optional<ServerProcess> start(const std::vector<std::string>& command);
  ~ServerProcess();
  ServerProcess(ServerProcess&& other) noexcept;
  ServerProcess& operator=(ServerProcess&&) = delete;

  [[nodiscard]] pid_t pid() const { return pid_; }
  [[nodiscard]] const Endpoint& endpoint() const { return endpoint_; }
  [[nodiscard]] bool alive() const;

 private:
  ServerProcess(pid_t pid, int output, const Endpoint& endpoint) : pid_(pid), output_(output), endpoint_(endpoint) {}
  pid_t pid_;
  int output_;  ///< kept open: a server that logs there must not meet a closed pipe
  Endpoint endpoint_;
};

}  // namespace semblante::bench
