#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "core/types/result.h"

namespace semblante {

/// Limits of one JSON text. A document uses at most 256 bytes of memory per value, plus the bytes of its strings.
/// Values are scalars, arrays and objects, each counted once; member names are not counted.
struct JsonLimits {
  std::size_t max_bytes = std::numeric_limits<std::size_t>::max();
  std::size_t max_depth = 64;
  std::size_t max_values = 4'000'000;
};

/// Parses a text. Errors have the JSON pointer in `where` (empty for invalid JSON: the message then has the byte
/// offset): `malformed` for invalid JSON and duplicate members, `not_finite` for a number beyond the range of a double,
/// `too_large` for exceeded limits. Pointers are printable and at most 1000
/// bytes long.
Result<nlohmann::json> read_json(std::string_view text, const JsonLimits& limits = {});

/// Like read_json(), for a text that must be an object.
Result<nlohmann::json> read_json_object(std::string_view text, const JsonLimits& limits = {});

/// A member array of the outermost object whose elements are passed one by one to `take` and not kept, for documents
/// too large for memory. The array is empty in the resulting document.
struct JsonElements {
  std::string_view member;
  /// Called with each element and its index; an error ends the reading and becomes its result.
  std::function<Status(std::size_t index, const nlohmann::json& element)> take;
};

/// Like read_json_object(); `limits.max_values` bounds the values in memory at a time: those of the document so far and
/// of one element.
Result<nlohmann::json> read_json_object(std::string_view text, const JsonLimits& limits, const JsonElements& elements);

}  // namespace semblante
