#pragma once

#include <stdexcept>
#include <string>

#include "core/types/result.h"

namespace semblante {

/// Ends a subcommand: one line for stderr and the exit code.
class CommandFailure : public std::runtime_error {
 public:
  static constexpr int internal = 1;    ///< ours: a disk that is full, a fault that was caught
  static constexpr int has_errors = 1;  ///< `examine`: the head was examined, and it has errors
  static constexpr int bad_input = 2;   ///< theirs: options, files, what is in them

  CommandFailure(int exit_code, const std::string& line) : std::runtime_error(line), exit_code_(exit_code) {}
  [[nodiscard]] int exit_code() const { return exit_code_; }

 private:
  int exit_code_;
};

/// "<what>: <where>: <message>", with the exit code that belongs to the error's kind.
[[noreturn]] void fail(const std::string& what, const Error& error);

}  // namespace semblante
