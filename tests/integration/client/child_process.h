#pragma once

#include <chrono>
#include <string>
#include <vector>

#include <sys/types.h>

namespace semblante::testing {

/// A program of ours as a child: its standard output can be read, its standard error is the test's own. Killed when it
/// outlives the object.
class ChildProcess {
 public:
  explicit ChildProcess(const std::vector<std::string>& command);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// The next line of its output, without the line's end; what there is when it ends or the time is up.
  std::string read_line(std::chrono::milliseconds timeout);
  void interrupt() const;
  /// Its exit status; 128 + signal when a signal ended it; -1 when it is still running after `timeout`.
  int wait(std::chrono::milliseconds timeout);

 private:
  pid_t pid_ = -1;
  int output_ = -1;
  std::string pending_;
};

}  // namespace semblante::testing
