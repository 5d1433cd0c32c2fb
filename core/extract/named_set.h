#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/expressions/library.h"

namespace semblante {

/// Which of the two high-level FAPs a displacement set is for: FAP 1 or FAP 2.
enum class SetKind : std::uint8_t { viseme, expression };
inline constexpr std::array<std::string_view, 2> set_kind_names = {"viseme", "expression"};
std::string_view to_string(SetKind kind);
std::optional<SetKind> parse_set_kind(std::string_view name);

/// A displacement set that owns what it is made of: one taken from an example, or made by hand.
struct NamedSet {
  std::string name;
  SetKind kind = SetKind::expression;
  std::vector<Displacement> displacements;  ///< FAPU units, as DisplacementSet::displacements

  /// Valid while this object lives and is not touched.
  [[nodiscard]] DisplacementSet view() const { return {name, displacements}; }
};

/// More units of a FAPU than any face moves a point by: a hundred times the width of the mouth. What lies beyond is a
/// fault of units or numbers, not an expression.
inline constexpr double most_set_units = 102400.0;

}  // namespace semblante
