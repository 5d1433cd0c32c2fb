#pragma once

#include <string>
#include <string_view>

/// What voices, recognizers and readers of sound have in common: programs that answer on standard output, line by line
/// (README.md).
namespace semblante::voice {

void say(std::string_view line);

/// Answers with an error and returns the exit status. `member`: of the request, if it is at fault.
int refuse(const std::string& message, std::string_view member = "");

/// Writes the line of the end. Returns the exit status: 1 if the answer could not be written.
int finish_answer();

/// The `main` of such a program: the exit status of `run`; 1, with the reason on standard error, if it throws.
int run_program(int (*run)());

}  // namespace semblante::voice
