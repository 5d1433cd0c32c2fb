#pragma once

#include <optional>
#include <string>
#include <string_view>

/// Number syntax of .fap files, the same in every language: no locale, no hexadecimals.
namespace semblante {

/// Largest FAP value of a .fap file, FAP units.
inline constexpr double max_fap_value = 1e9;
/// Smaller absolute values are read as zero: they are far below visible motion, and so no number needs an
/// exponent.
inline constexpr double least_fap_value = 1e-6;

/// Parses a whole word as a number: decimal with optional sign, fraction and exponent, or a spelling of infinity or NaN
/// ("inf", "-Infinity", "nan", "1.#QNAN"). nullopt for anything else, and for more than 64 characters.
std::optional<double> read_fap_number(std::string_view word);

/// The shortest decimal without an exponent that parses to the same value. |value| <= 1e9, 0 or at least 1e-6.
std::string write_fap_number(double value);

}  // namespace semblante
