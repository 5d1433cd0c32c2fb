#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/performance/cue.h"
#include "core/types/result.h"

namespace semblante {

inline constexpr std::string_view performance_format = "semblante.performance";
inline constexpr int performance_version = 1;
inline constexpr std::size_t max_performance_bytes = std::size_t{16} << 20;

/// A performance document (protocol/schema/performance.schema.json). Read cue by cue: memory grows with the cues that
/// are kept, and stops at the first one too many. Errors carry the JSON pointer; what no member may be, what no target
/// is, and a member named twice are errors. What the numbers must be to each other is Performance::compile's to check.
Result<PerformanceScript> read_performance(std::string_view text);

/// The document of a script, one cue a line. read_performance() gives the script back.
std::string write_performance(const PerformanceScript& script);

}  // namespace semblante
