#pragma once

#include "core/types/progress.h"

namespace semblante {

/// One line on stderr that is written over, and cleared at the end. Only for people, so only on a terminal.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine();

  /// Shows what it is told; never cancels. Empty where nothing is shown.
  [[nodiscard]] Progress progress() const;

 private:
  bool shown_;
};

}  // namespace semblante
