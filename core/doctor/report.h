#pragma once

#include <cstddef>
#include <vector>

#include "core/doctor/finding.h"

namespace semblante {

struct FindingCounts {
  std::size_t errors = 0, warnings = 0, notes = 0;

  bool operator==(const FindingCounts&) const = default;
};

/// The findings of the fit doctor for one head, errors first.
struct Report {
  std::vector<Finding> findings;

  [[nodiscard]] FindingCounts counts() const;
};

}  // namespace semblante
