#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "core/types/result.h"

namespace semblante {

/// Limits of one JSON text. A document takes at most 256 bytes of memory a value, beside the bytes of its texts. Values
/// are scalars, arrays and objects, each counted once; names of members are not counted.
struct JsonLimits {
  std::size_t max_bytes = std::numeric_limits<std::size_t>::max();
  std::size_t max_depth = 64;
  std::size_t max_values = 4'000'000;
};

/// The document of a text. Errors carry the JSON pointer of the place in `where` (empty where the text
/// is not JSON at all: the message says the byte): `malformed` for that or a member named twice, `not_finite` for a
/// number beyond the range of a double, `too_large` for what is over a limit. Pointers are printable and at most 1000
/// bytes long.
Result<nlohmann::json> read_json(std::string_view text, const JsonLimits& limits = {});

/// As read_json(), of a text that must be an object.
Result<nlohmann::json> read_json_object(std::string_view text, const JsonLimits& limits = {});

/// An array among the members of the outermost object whose elements are handed over one by one and not kept, for
/// documents that are too large to be held at once. In the document the array is left empty.
struct JsonElements {
  std::string_view member;
  /// Takes the element with this index; an error ends the reading and becomes its result.
  std::function<Status(std::size_t index, const nlohmann::json& element)> take;
};

/// As read_json_object(); `limits.max_values` bounds the values held at a time, that is, those of the document so far
/// and of one element.
Result<nlohmann::json> read_json_object(std::string_view text, const JsonLimits& limits, const JsonElements& elements);

}  // namespace semblante
