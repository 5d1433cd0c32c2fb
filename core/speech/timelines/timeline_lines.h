#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include "core/speech/timelines/timeline_builder.h"

namespace semblante {

/// Calls `take(line, where)` for each line that is not blank.
template <class Take>
void each_line(std::string_view file, const TimelineBuilder& builder, Take take) {
  std::size_t number = 0;
  while (!file.empty() && !builder.failed()) {
    const std::size_t end = std::min(file.find('\n'), file.size());
    std::string_view line = file.substr(0, end);
    file.remove_prefix(std::min(end + 1, file.size()));
    ++number;
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.find_first_not_of(" \t") != std::string_view::npos) take(line, "line " + std::to_string(number));
  }
}

/// ms of a number of seconds; NaN, which no check accepts, for anything else.
double ms_of_seconds(std::string_view text);

/// Lines of two or three columns between tabs: the begin in s, with three the end, and the symbol.
void read_table(std::string_view file, std::size_t column_count, TimelineBuilder& builder);

}  // namespace semblante
