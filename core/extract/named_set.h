#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/expressions/library.h"

namespace semblante {

/// The high-level FAP of a displacement set: FAP 1 or FAP 2.
enum class SetKind : std::uint8_t { viseme, expression };
inline constexpr std::array<std::string_view, 2> set_kind_names = {"viseme", "expression"};
std::string_view to_string(SetKind kind);
std::optional<SetKind> parse_set_kind(std::string_view name);
/// The library's sets of a kind, by number.
inline std::span<const DisplacementSet> library_of(SetKind kind) {
  return kind == SetKind::viseme ? viseme_library() : expression_library();
}

/// A displacement set with owned name and displacements: extracted from an example, or made by hand.
struct NamedSet {
  std::string name;
  SetKind kind = SetKind::expression;
  std::vector<Displacement> displacements;  ///< FAPU units, as DisplacementSet::displacements

  /// Valid while this object exists and is not modified.
  [[nodiscard]] DisplacementSet view() const { return {name, displacements}; }
};

/// Largest plausible displacement, FAPU units: a hundred times the width of the mouth. Larger values are errors of
/// units or numbers.
inline constexpr double most_set_units = 102400.0;

}  // namespace semblante
