#pragma once

#include <exception>
#include <functional>
#include <iostream>

#include <CLI/CLI.hpp>

#include "clients/native/tools/files.h"
#include "core/types/result.h"

namespace semblante::tools {

/// The end of a program's main: reads the command line, calls `run` and returns the exit status. An error is printed to
/// standard error after the name of `app`.
inline int run_tool(CLI::App& app, int argc, char** argv, const std::function<Status()>& run) {
  CLI11_PARSE(app, argc, argv);
  try {
    const auto done = run();
    if (done) return 0;
    std::cerr << app.get_name() << ": " << to_text(done.error()) << '\n';
  } catch (const std::exception& fault) {
    std::cerr << app.get_name() << ": internal error: " << fault.what() << '\n';
  }
  return 1;
}

}  // namespace semblante::tools
