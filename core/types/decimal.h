#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace semblante {

/// Numbers as decimal text, correctly rounded and the same on every machine: the standard library of WebAssembly has
/// neither from_chars nor to_chars for reals, and strtod follows the locale. Its to_string is 3 kB of code there.

/// Reads [-] digits [. digits] [e [sign] digits], with a digit before or after the point, and nothing else. Beyond the
/// range of the type: infinity; too small: 0.
std::optional<double> read_double(std::string_view text);
std::optional<float> read_float(std::string_view text);

std::string natural_text(std::uint64_t value);
std::string whole_text(std::int64_t value);

/// A finite value with `digits` (at most 20) digits after the point, without an exponent.
std::string fixed_text(double value, int digits);
/// The fewest digits that read_double() reads as the same finite value, without an exponent: "0.001", "12", "-0".
std::string shortest_fixed_text(double value);
/// The fewest digits, as JSON writes a real: "0.5", "7.0", "1e+300", "1.5e-07".
std::string shortest_text(double value);

}  // namespace semblante
