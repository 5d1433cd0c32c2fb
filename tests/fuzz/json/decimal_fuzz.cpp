#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>

#include "core/types/decimal.h"

using namespace semblante;

namespace {

void expect(bool fact) {
  if (!fact) std::abort();
}

bool same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
bool same(float a, float b) { return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b); }

/// What the standard library reads of the whole text; infinity or 0 where it only says "out of range".
template <class Real>
std::optional<Real> standard(const std::string& text, Real (*strto)(const char*, char**)) {
  if (text.find_first_not_of("0123456789.eE+-") != std::string::npos) return std::nullopt;
  Real value{};
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status == std::errc::invalid_argument || end != text.data() + text.size()) return std::nullopt;
  const Real other = strto(text.c_str(), nullptr);
  if (status == std::errc{}) expect(same(value, other));
  return other;
}

template <class Real>
void expect_read(const std::optional<Real>& value, const std::optional<Real>& expected) {
  expect(value.has_value() == expected.has_value() && (!value || same(*value, *expected)));
}

void read(const std::string& text) {
  expect_read(read_double(text), standard<double>(text, std::strtod));
  expect_read(read_float(text), standard<float>(text, std::strtof));
}

std::string standard_text(double value, std::chars_format format) {
  char text[2000];
  return {text, std::to_chars(text, text + sizeof(text), value, format).ptr};
}

/// Significant digits, without zeros at the end, and the decimal exponent of the first one.
std::string normal(const std::string& text) {
  std::string digits;
  int exponent = 0;
  const std::size_t e = text.find('e');
  if (e != std::string::npos) exponent = std::atoi(text.c_str() + e + 1);
  bool after_point = false;
  for (const char c : text.substr(0, e)) {
    if (c == '.') after_point = true;
    if (c < '0' || c > '9') continue;
    if (digits.empty() && c == '0') {
      exponent -= after_point ? 1 : 0;
      continue;
    }
    if (!after_point && !digits.empty()) ++exponent;
    if (after_point && digits.empty()) --exponent;
    digits += c;
  }
  while (!digits.empty() && digits.back() == '0') digits.pop_back();
  if (digits.empty()) exponent = 0;
  return digits + "e" + std::to_string(exponent);
}

void write(double value) {
  const std::string shortest = standard_text(value, std::chars_format::scientific);
  const std::string fixed = shortest_fixed_text(value);
  expect(same(*read_double(fixed), value) && normal(fixed) == normal(shortest));
  // to_chars writes all digits of greater values.
  expect(std::abs(value) >= 0x1p53 || fixed == standard_text(value, std::chars_format::fixed));
  expect(fixed.find('e') == std::string::npos);
  const std::string json = shortest_text(value);
  expect(same(*read_double(json), value) && normal(json) == normal(shortest));
  expect(json.find_first_of(".e") != std::string::npos && json.size() <= 25);
  for (const int digits : {0, 1, 6, 20}) {
    char text[2000];
    const auto end = std::to_chars(text, text + sizeof(text), value, std::chars_format::fixed, digits).ptr;
    expect(fixed_text(value, digits) == std::string(text, end));
  }
}

/// Texts at and beside the middle of two neighbours, where the last of many digits decides.
template <class Real, class Wide>
void read_middle(Real value, std::string_view tail) {
  const Wide middle = (Wide{value} + Wide{std::nextafter(value, Real{0})}) / 2;
  char text[2000];
  std::snprintf(text, sizeof(text), "%.1100Le", static_cast<long double>(middle));
  const std::string exact = text;
  const std::size_t e = exact.find('e');
  read(exact);
  const std::size_t last = exact.find_last_not_of('0', e - 1) + 1;
  for (const std::size_t kept : {last, last - 1, std::min(last, std::size_t{20})})
    for (const std::string& added : {std::string("1"), std::string(tail), std::string(900, '0') + "1"})
      read(exact.substr(0, kept) + added + exact.substr(e));
}

}  // namespace

/// Beside from_chars, strtod, strtof and to_chars: of the input as a text, and of its first bytes as a value with the
/// others as digits.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  read(text);
  double value = 0.0;
  if (size < sizeof(value)) return 0;
  std::memcpy(&value, data, sizeof(value));
  if (!std::isfinite(value)) return 0;
  float narrow = 0.0F;
  std::memcpy(&narrow, data, sizeof(narrow));
  std::string tail;
  for (const char c : text.substr(sizeof(value))) tail += static_cast<char>('0' + static_cast<unsigned char>(c) % 10);
  constexpr std::uint64_t fraction = (std::uint64_t{1} << 52U) - 1U;
  switch (data[size - 1] % 4) {
    case 0:
      write(value);
      break;
    case 1:
      write(std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) & ~fraction));  // a power of two
      break;
    case 2:
      read_middle<double, long double>(value, tail);
      break;
    default:
      if (std::isfinite(narrow)) read_middle<float, double>(narrow, tail);
      break;
  }
  return 0;
}
