#pragma once

#include <functional>
#include <string_view>

#include "core/types/result.h"

namespace semblante {

/// Told how far a piece of work is (0..1, never falling) and at what. False cancels it: the function that was given the
/// progress then fails with `cancelled`. May be empty.
using Progress = std::function<bool(double share, std::string_view stage)>;

/// Reports, and fails with `cancelled` when the answer is no.
inline Status report_progress(const Progress& progress, double share, std::string_view stage) {
  if (!progress || progress(share, stage)) return Unit{};
  return Error{ErrorCode::cancelled, "", "stopped on request"};
}

/// The progress of a part of some work, which takes the whole from share `from` to share `to`.
inline Progress part_of(const Progress& whole, double from, double to) {
  if (!whole) return {};
  return [whole, from, to](double share, std::string_view stage) { return whole(from + (to - from) * share, stage); };
}

}  // namespace semblante
