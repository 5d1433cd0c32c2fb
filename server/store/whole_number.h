#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

namespace semblante::store {

/// A whole number that the type has. nlohmann's own conversion takes fractions, and is undefined for numbers that the
/// type has not. Throws nlohmann::json::exception for anything else.
template <class Whole>
Whole whole_number(const nlohmann::json& json) {
  if (json.is_number_unsigned()) {
    if (const auto value = json.get<std::uint64_t>(); std::in_range<Whole>(value)) return static_cast<Whole>(value);
  } else if (json.is_number_integer()) {
    if (const auto value = json.get<std::int64_t>(); std::in_range<Whole>(value)) return static_cast<Whole>(value);
  }
  constexpr int wrong_type = 302;  // nlohmann's number of this kind of fault
  throw nlohmann::json::type_error::create(
      wrong_type, "must be a whole number up to " + std::to_string(std::numeric_limits<Whole>::max()), &json);
}

/// The same, into a member.
template <class Whole>
void get_whole(const nlohmann::json& json, Whole& number) {
  number = whole_number<Whole>(json);
}

}  // namespace semblante::store
