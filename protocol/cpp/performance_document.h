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

/// Reads a performance document (protocol/schema/performance.schema.json) cue by cue: memory grows with the kept cues
/// and is bounded by their limit. Errors have the JSON pointer; unknown members, unknown targets and duplicate members
/// are errors. Performance::compile checks the relations between values.
Result<PerformanceScript> read_performance(std::string_view text);

/// The document of a script, one cue per line. read_performance() returns an equal script.
std::string write_performance(const PerformanceScript& script);

}  // namespace semblante
