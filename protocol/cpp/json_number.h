#pragma once

#include <cmath>
#include <cstdint>

namespace semblante {

/// A number of a document: 200, not 200.0, where it is whole. Json: one of nlohmann's types.
template <class Json>
Json json_number(double value) {
  const bool whole = value == std::floor(value) && std::abs(value) < 1e15;
  return whole ? Json(static_cast<std::int64_t>(value)) : Json(value);
}

}  // namespace semblante
