#include "core/types/decimal.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace semblante {
namespace {

/// Significant digits of a text that can change the result; of further ones only whether they are all zero.
constexpr int max_digits = 800;
/// A value of max_digits digits is infinite or zero beyond these powers of ten.
constexpr int max_power = 1200;

/// A natural number below 2^4224, as large as the products of max_digits digits and the powers of ten in use.
class BigNatural {
 public:
  explicit BigNatural(std::uint64_t value) {
    while (value != 0) words_[count_++] = static_cast<std::uint32_t>(value), value >>= 32U;
  }

  [[nodiscard]] bool is_zero() const { return count_ == 0; }

  [[nodiscard]] int bits() const {
    return count_ == 0 ? 0 : 32 * (count_ - 1) + static_cast<int>(std::bit_width(words_[count_ - 1]));
  }

  /// this * factor + summand
  void multiply(std::uint32_t factor, std::uint32_t summand = 0) {
    std::uint64_t carry = summand;
    for (int i = 0; i < count_; ++i) {
      carry += std::uint64_t{words_[i]} * factor;
      words_[i] = static_cast<std::uint32_t>(carry);
      carry >>= 32U;
    }
    if (carry != 0) words_[count_++] = static_cast<std::uint32_t>(carry);
  }

  void multiply_by_power_of_ten(int power) {
    for (; power >= 9; power -= 9) multiply(1'000'000'000U);
    for (; power > 0; --power) multiply(10U);
  }

  /// Returns the remainder.
  std::uint32_t divide(std::uint32_t divisor) {
    std::uint64_t rest = 0;
    for (int i = count_; i-- > 0;) {
      rest = rest << 32U | words_[i];
      words_[i] = static_cast<std::uint32_t>(rest / divisor);
      rest %= divisor;
    }
    trim();
    return static_cast<std::uint32_t>(rest);
  }

  void shift_left(int by) {
    const int whole = by / 32;
    const unsigned part = static_cast<unsigned>(by % 32);
    if (whole > 0 && count_ > 0) {
      std::copy_backward(words_.begin(), words_.begin() + count_, words_.begin() + count_ + whole);
      std::fill_n(words_.begin(), whole, 0U);
      count_ += whole;
    }
    if (part > 0) multiply(1U << part);
  }

  /// this - other * factor, which is not negative
  void subtract(const BigNatural& other, std::uint32_t factor = 1) {
    std::uint64_t product = 0;
    std::int64_t borrow = 0;
    for (int i = 0; i < count_; ++i) {
      if (i < other.count_) product += std::uint64_t{other.words_[i]} * factor;
      borrow += std::int64_t{words_[i]} - static_cast<std::int64_t>(product & 0xFFFF'FFFFU);
      product >>= 32U;
      words_[i] = static_cast<std::uint32_t>(borrow);
      borrow >>= 32;
    }
    trim();
  }

  /// this / 2^bit as a whole number, below 2^64
  [[nodiscard]] std::uint64_t from_bit(int bit) const {
    std::uint64_t value = 0;
    for (int i = count_ - 1; i >= bit / 32; --i) {
      const int at = 32 * i - bit;
      value += at < 0 ? words_[i] >> static_cast<unsigned>(-at) : std::uint64_t{words_[i]} << static_cast<unsigned>(at);
    }
    return value;
  }

  /// -1, 0 or 1
  [[nodiscard]] int compare(const BigNatural& other) const {
    if (count_ != other.count_) return count_ < other.count_ ? -1 : 1;
    for (int i = count_; i-- > 0;) {
      if (words_[i] != other.words_[i]) return words_[i] < other.words_[i] ? -1 : 1;
    }
    return 0;
  }

 private:
  void trim() {
    while (count_ > 0 && words_[count_ - 1] == 0) --count_;
  }

  std::array<std::uint32_t, 132> words_{};  ///< the least first
  int count_ = 0;
};

/// `above` / `below` in binary: `mantissa_bits` bits, rounded to nearest, ties to even.
double quotient(BigNatural above, BigNatural below, int mantissa_bits, int least_exponent) {
  if (above.is_zero()) return 0.0;
  int exponent = above.bits() - below.bits();  // of the first bit, or one more
  if (exponent > 0) below.shift_left(exponent);
  if (exponent < 0) above.shift_left(-exponent);
  if (above.compare(below) < 0) {
    above.shift_left(1);
    --exponent;
  }
  const int bits = std::min(mantissa_bits, exponent - least_exponent + 1);  // fewer for subnormal numbers
  if (bits < 0) return 0.0;
  std::uint64_t mantissa = 0;
  if (bits > 0) {
    above.subtract(below);
    mantissa = 1;
    if (below.bits() < 32) {
      above.shift_left(32);
      below.shift_left(32);
    }
    const int at = below.bits() - 32;
    const std::uint64_t divisor = below.from_bit(at) + 1;  // too large, so that no digit is
    for (int left = bits - 1; left > 0;) {
      const int step = std::min(left, 16);
      above.shift_left(step);
      auto digit = static_cast<std::uint32_t>(above.from_bit(at) / divisor);
      above.subtract(below, digit);
      for (; above.compare(below) >= 0; ++digit) above.subtract(below);
      mantissa = (mantissa << static_cast<unsigned>(step)) + digit;
      left -= step;
    }
    above.shift_left(1);
  }
  const int half = above.compare(below);
  if (half > 0 || (half == 0 && (mantissa & 1U) != 0)) ++mantissa;
  return std::ldexp(static_cast<double>(mantissa), exponent - bits + 1);
}

struct Decimal {
  bool negative = false;
  std::uint64_t leading = 0;  ///< the value of the significant digits if they are at most 19
  std::int64_t digits = 0;    ///< number of significant digits
  std::int64_t power = 0;     ///< of ten, of the last significant digit
  std::string_view text;      ///< from the first significant digit on
};

bool is_decimal_digit(char c) { return c >= '0' && c <= '9'; }

std::optional<Decimal> split(std::string_view text) {
  Decimal number;
  std::size_t at = 0;
  const auto next = [&] { return at < text.size() ? text[at] : '\0'; };
  if (next() == '-') number.negative = true, ++at;
  bool any = false;
  bool after_point = false;
  for (;; ++at) {
    if (next() == '.' && !after_point) {
      after_point = true;
      continue;
    }
    if (!is_decimal_digit(next())) break;
    any = true;
    if (after_point) --number.power;
    if (number.digits == 0 && next() == '0') continue;
    if (number.digits == 0) number.text = text.substr(at);
    if (++number.digits <= 19) number.leading = number.leading * 10 + static_cast<std::uint64_t>(next() - '0');
  }
  if (!any) return std::nullopt;
  if (next() == 'e' || next() == 'E') {
    ++at;
    const bool down = next() == '-';
    if (down || next() == '+') ++at;
    if (!is_decimal_digit(next())) return std::nullopt;
    std::int64_t exponent = 0;
    constexpr std::int64_t most = 100'000'000'000'000'000;  // beyond what the digits of any text make up for
    for (; is_decimal_digit(next()); ++at) exponent = std::min(exponent * 10 + (next() - '0'), most);
    number.power += down ? -exponent : exponent;
  }
  if (at != text.size()) return std::nullopt;
  return number;
}

BigNatural digits_of(Decimal& number) {
  BigNatural value(0);
  std::int64_t taken = 0;
  bool any_beyond = false;
  for (const char c : number.text) {
    if (!is_decimal_digit(c) && c != '.') break;
    if (c == '.') continue;
    if (taken < max_digits) {
      value.multiply(10U, static_cast<std::uint32_t>(c - '0'));
    } else {
      any_beyond |= c != '0';
    }
    ++taken;
  }
  number.power += std::max<std::int64_t>(0, taken - max_digits);
  if (any_beyond) {  // more than what was taken: one further digit decides a tie
    value.multiply(10U, 1U);
    --number.power;
  }
  return value;
}

double rounded(Decimal number, int mantissa_bits, int least_exponent) {
  constexpr int max_exact_power = 22;
  static constexpr std::array<double, max_exact_power + 1> powers = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                                     1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                                     1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  if (number.digits == 0) return 0.0;
  if (number.digits + number.power > 400) return std::numeric_limits<double>::infinity();
  if (number.digits + number.power < -400) return 0.0;
  // Both operands are exact, so that one rounding is made.
  const bool fits = number.digits <= 15 && std::abs(number.power) <= max_exact_power;
  if (fits && mantissa_bits == 53) {
    const auto value = static_cast<double>(number.leading);
    return number.power < 0 ? value / powers[-number.power] : value * powers[number.power];
  }
  BigNatural above = digits_of(number);
  BigNatural below(1);
  const int power = static_cast<int>(std::clamp<std::int64_t>(number.power, -max_power, max_power));
  if (power > 0) above.multiply_by_power_of_ten(power);
  if (power < 0) below.multiply_by_power_of_ten(-power);
  return quotient(above, below, mantissa_bits, least_exponent);
}

/// Adds 1 to a whole number.
void count_up(std::string& digits) {
  std::size_t i = digits.size();
  while (i > 0 && digits[i - 1] == '9') digits[--i] = '0';
  if (i > 0) {
    ++digits[i - 1];
  } else {
    digits.insert(0, 1, '1');
  }
}

/// value * 10^power, rounded to a whole number (ties to even), as digits. `value` is finite and not negative.
std::string scaled_digits(double value, int power) {
  int exponent = 0;
  const auto mantissa = static_cast<std::uint64_t>(std::ldexp(std::frexp(value, &exponent), 53));
  exponent -= 53;
  BigNatural above(mantissa);
  if (power > 0) above.multiply_by_power_of_ten(power);
  if (exponent > 0) above.shift_left(exponent);
  BigNatural below(1);
  if (power < 0) below.multiply_by_power_of_ten(-power);
  if (exponent < 0) below.shift_left(-exponent);
  std::string digits;
  // One division of large numbers, digit by digit from the greatest power of ten.
  BigNatural step = below;
  int steps = 0;
  for (BigNatural next = step; next.compare(above) <= 0; ++steps) {
    step = next;
    next.multiply(10U);
  }
  for (; steps > 0; --steps) {
    char digit = '0';
    while (above.compare(step) >= 0) {
      above.subtract(step);
      ++digit;
    }
    digits += digit;
    step.divide(10U);
  }
  above.shift_left(1);
  const int half = above.compare(below);
  const bool odd = !digits.empty() && (digits.back() - '0') % 2 == 1;
  if (half > 0 || (half == 0 && odd)) count_up(digits);
  return digits.empty() ? "0" : digits;
}

struct Shortest {
  std::string digits;  ///< without zeros at the end
  int power = 0;       ///< of ten, of the last digit
};

Shortest shortest_of(double value) {
  if (value == 0.0) return {"0", 0};
  const auto is_value = [&](const Shortest& text) {
    return rounded(*split(text.digits + "e" + whole_text(text.power)), 53, -1074) == value;
  };
  int exponent = 0;
  const bool is_power_of_two = std::frexp(value, &exponent) == 0.5;
  // The greatest power of two up to the value has the same power of ten as the value, or one less.
  int magnitude = static_cast<int>(std::floor((exponent - 1) * std::numbers::ln2 / std::numbers::ln10));
  if (rounded(*split("1e" + whole_text(magnitude + 1)), 53, -1074) <= value) ++magnitude;
  for (int count = 1;; ++count) {
    Shortest result{scaled_digits(value, count - 1 - magnitude), magnitude - count + 1};
    if (count < 17 && !is_value(result)) {
      if (!is_power_of_two) continue;
      // Its neighbour above is farther than that below: digits that are not the nearest may still be read as it.
      count_up(result.digits);
      if (!is_value(result)) continue;
    }
    while (result.digits.size() > 1 && result.digits.back() == '0') result.digits.pop_back(), ++result.power;
    return result;
  }
}

/// digits * 10^power, without an exponent
std::string placed(std::string digits, int power) {
  if (power >= 0) return digits.append(static_cast<std::size_t>(power), '0');
  const auto places = static_cast<std::size_t>(-power);
  if (digits.size() <= places) digits.insert(0, places + 1 - digits.size(), '0');
  return digits.insert(digits.size() - places, 1, '.');
}

std::string signed_text(double value, std::string text) { return std::signbit(value) ? text.insert(0, 1, '-') : text; }

}  // namespace

std::optional<double> read_double(std::string_view text) {
  const auto number = split(text);
  if (!number) return std::nullopt;
  const double value = rounded(*number, 53, -1074);
  return number->negative ? -value : value;
}

std::optional<float> read_float(std::string_view text) {
  const auto number = split(text);
  if (!number) return std::nullopt;
  const double value = rounded(*number, 24, -149);
  constexpr double most = std::numeric_limits<float>::max();
  const float narrow = value > most ? std::numeric_limits<float>::infinity() : static_cast<float>(value);
  return number->negative ? -narrow : narrow;
}

std::string natural_text(std::uint64_t value) {
  std::array<char, 20> digits{};
  std::size_t first = digits.size();
  do {
    digits[--first] = static_cast<char>('0' + value % 10);
    value /= 10;
  } while (value != 0);
  return {digits.data() + first, digits.size() - first};
}

std::string whole_text(std::int64_t value) {
  // Negated as an unsigned number: as a signed one the negative of the least value would overflow.
  return value < 0 ? "-" + natural_text(0 - static_cast<std::uint64_t>(value))
                   : natural_text(static_cast<std::uint64_t>(value));
}

std::string fixed_text(double value, int digits) {
  return signed_text(value, placed(scaled_digits(std::abs(value), digits), -digits));
}

std::string shortest_fixed_text(double value) {
  auto [digits, power] = shortest_of(std::abs(value));
  return signed_text(value, placed(std::move(digits), power));
}

std::string shortest_text(double value) {
  auto [digits, power] = shortest_of(std::abs(value));
  const int magnitude = static_cast<int>(digits.size()) - 1 + power;
  if (magnitude >= -4 && magnitude < 15) {
    std::string text = placed(std::move(digits), power);
    return signed_text(value, power >= 0 ? text + ".0" : text);
  }
  if (digits.size() > 1) digits.insert(1, 1, '.');
  std::string exponent = whole_text(std::abs(magnitude));
  if (exponent.size() < 2) exponent.insert(0, 1, '0');
  return signed_text(value, digits + (magnitude < 0 ? "e-" : "e+") + exponent);
}

}  // namespace semblante
