#pragma once

#include <stdexcept>
#include <string>

#include "core/types/result.h"

namespace semblante {

/// Ends a subcommand: one line for stderr and the exit code.
class CommandFailure : public std::runtime_error {
 public:
  static constexpr int internal = 1;    ///< internal: a full disk, a caught exception
  static constexpr int has_errors = 1;  ///< `examine`: the head was examined, and it has errors
  static constexpr int bad_input = 2;   ///< the caller's: options, files, contents of files

  CommandFailure(int exit_code, const std::string& line) : std::runtime_error(line), exit_code_(exit_code) {}
  [[nodiscard]] int exit_code() const { return exit_code_; }

 private:
  int exit_code_;
};

/// "<what>: <where>: <message>: <what helps>", as far as each is known, with the exit code that belongs to the error's
/// kind.
[[noreturn]] void fail(const std::string& what, const Error& error);

}  // namespace semblante
