#include "server/cli/progress_line.h"

#include <iostream>
#include <unistd.h>

namespace semblante {

ProgressLine::ProgressLine(bool quiet) : shown_(!quiet && isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
  if (shown_) std::cerr << "\r\033[K" << std::flush;
}

Progress ProgressLine::progress() const {
  if (!shown_) return {};
  return [](double share, std::string_view stage) {
    std::cerr << "\r\033[K" << static_cast<int>(share * 100.0) << " % " << stage << std::flush;
    return true;
  };
}

}  // namespace semblante
