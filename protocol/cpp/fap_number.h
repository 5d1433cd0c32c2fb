#pragma once

#include <optional>
#include <string>
#include <string_view>

/// Numbers as .fap files write them, the same in every language: no locale, no hexadecimals.
namespace semblante {

/// Greatest FAP value of a .fap file, FAP units.
inline constexpr double max_fap_value = 1e9;
/// What is nearer to zero than this is zero: no face moves by a millionth of a FAP unit, and no number needs an
/// exponent.
inline constexpr double least_fap_value = 1e-6;

/// A whole word as a number: decimal, with sign, fraction or exponent if it likes, or a way to say infinity or NaN
/// ("inf", "-Infinity", "nan", "1.#QNAN"). nullopt for anything else, and for more than 64 characters.
std::optional<double> read_fap_number(std::string_view word);

/// The shortest decimal without an exponent that reads back the same. |value| <= 1e9, 0 or at least 1e-6.
std::string write_fap_number(double value);

}  // namespace semblante
