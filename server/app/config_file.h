#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/types/result.h"

namespace semblante {

/// One `key = value` of a configuration file. A value that is no array is one text.
struct ConfigEntry {
  std::string key;
  std::vector<std::string> values;
  bool is_array = false;
  unsigned line = 0;  ///< of the key, from 1
};

/// Reads the part of TOML that options need: `key = value` at top level, comments; values are strings ("with \"
/// escapes" or 'literal'), integers, decimal fractions, true, false, and arrays of these, also over several lines.
/// Numbers stay text, without TOML's underscores. Errors have the line as their place: `malformed`; `unsupported` for
/// tables, dates and multi-line strings; `invalid_argument` for a key that is there twice.
Result<std::vector<ConfigEntry>> parse_config(std::string_view text);

}  // namespace semblante
