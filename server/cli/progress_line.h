#pragma once

#include "core/types/progress.h"

namespace semblante {

/// A progress line on stderr that each update overwrites and the destructor clears. Shown only on a terminal.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine();

  /// The callback that updates the line; never cancels. Empty when nothing is shown.
  [[nodiscard]] Progress progress() const;

 private:
  bool shown_;
};

}  // namespace semblante
