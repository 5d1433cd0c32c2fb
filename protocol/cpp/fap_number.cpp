#include "protocol/cpp/fap_number.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "core/types/decimal.h"
#include "core/types/letter_case.h"

namespace semblante {
namespace {

constexpr std::size_t max_word = 64;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// digits [. digits] [e [sign] digits], with a digit before or after the point.
bool is_decimal(std::string_view word) {
  std::size_t i = 0;
  const auto digits = [&] {
    const std::size_t begin = i;
    while (i < word.size() && is_digit(word[i])) ++i;
    return i - begin;
  };
  std::size_t mantissa = digits();
  if (i < word.size() && word[i] == '.') ++i, mantissa += digits();
  if (mantissa == 0) return false;
  if (i < word.size() && (word[i] == 'e' || word[i] == 'E')) {
    ++i;
    if (i < word.size() && (word[i] == '+' || word[i] == '-')) ++i;
    if (digits() == 0) return false;
  }
  return i == word.size();
}

}  // namespace

std::optional<double> read_fap_number(std::string_view word) {
  if (word.size() > max_word) return std::nullopt;
  const bool negative = word.starts_with('-');
  if (negative || word.starts_with('+')) word.remove_prefix(1);
  if (equal_ignoring_case(word, "inf") || equal_ignoring_case(word, "infinity") ||
      equal_ignoring_case(word, "1.#inf")) {
    return negative ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
  }
  if (equal_ignoring_case(word, "nan") || equal_ignoring_case(word, "1.#qnan") || equal_ignoring_case(word, "1.#ind")) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  if (!is_decimal(word)) return std::nullopt;
  const double value = std::min(*read_double(word), std::numeric_limits<double>::max());
  if (value < least_fap_value) return 0.0;
  return negative ? -value : value;
}

std::string write_fap_number(double value) {
  assert(std::abs(value) <= max_fap_value && (value == 0.0 || std::abs(value) >= least_fap_value));
  return shortest_fixed_text(value == 0.0 ? 0.0 : value);
}

}  // namespace semblante
