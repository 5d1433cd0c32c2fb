#pragma once

#include <functional>
#include <string_view>

#include "core/types/result.h"

namespace semblante {

/// A callback with the progress of an operation (0..1, never decreasing) and its stage. Returning false cancels the
/// operation, which then fails with `cancelled`. May be empty.
using Progress = std::function<bool(double share, std::string_view stage)>;

/// Reports progress; fails with `cancelled` if the callback returns false.
inline Status report_progress(const Progress& progress, double share, std::string_view stage) {
  if (!progress || progress(share, stage)) return Unit{};
  return Error{ErrorCode::cancelled, "", "stopped on request"};
}

/// The progress callback of a part that covers `from` to `to` of the whole operation.
inline Progress part_of(const Progress& whole, double from, double to) {
  if (!whole) return {};
  return [whole, from, to](double share, std::string_view stage) { return whole(from + (to - from) * share, stage); };
}

}  // namespace semblante
