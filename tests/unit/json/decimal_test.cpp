#include "core/types/decimal.h"

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace semblante {
namespace {

/// What the standard library reads; infinity or 0 where it only says that the value is out of range.
template <class Real>
Real standard(const std::string& text) {
  Real value{};
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  EXPECT_EQ(end, text.data() + text.size()) << text;
  if (status == std::errc::result_out_of_range) return static_cast<Real>(std::strtod(text.c_str(), nullptr));
  return value;
}

void expect_same(const std::string& text) {
  EXPECT_EQ(read_double(text), standard<double>(text)) << text;
  EXPECT_EQ(read_float(text), standard<float>(text)) << text;
}

double random_double(std::mt19937_64& random) {
  const std::uint64_t bits = random();
  double value = 0.0;
  std::memcpy(&value, &bits, sizeof(value));
  return std::isfinite(value) ? value : 1.0;
}

TEST(Decimal, Reading_IsCorrectlyRounded) {
  for (const char* text : {"0",
                           "-0",
                           "1",
                           "0.1",
                           "-2.5",
                           ".5",
                           "5.",
                           "1e3",
                           "1E+3",
                           "1e-3",
                           "123456789012345678901234567890",
                           "4.9e-324",
                           "2.4703282292062327e-324",
                           "2.4703282292062328e-324",
                           "1.7976931348623157e308",
                           "1.7976931348623158e308",
                           "9007199254740993",
                           "9007199254740992.9999999999999999",
                           "2.2250738585072011e-308",
                           "1.00000005960464477539062",
                           "16777217",
                           "1.1754943e-38",
                           "7e-46",
                           "7.1e-46",
                           "3.4028235e38",
                           "0.000000000000000000000000000000000001e36"}) {
    expect_same(text);
  }
  // A tie of double, and a digit beyond any that is kept.
  const std::string tie = "9007199254740993." + std::string(2000, '0');
  EXPECT_EQ(read_double(tie), 9007199254740992.0);
  EXPECT_EQ(read_double(tie + "1"), 9007199254740994.0);
  EXPECT_EQ(read_double("1e999"), std::numeric_limits<double>::infinity());
  EXPECT_EQ(read_double("-1e999999999999"), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(read_double("1e-999999999999"), 0.0);
  EXPECT_EQ(read_float("3.5e38"), std::numeric_limits<float>::infinity());
  EXPECT_EQ(read_float("3.4028235677973367e38"), std::numeric_limits<float>::infinity());  // the tie above the greatest
  std::mt19937_64 random(7);
  for (int i = 0; i < 20'000; ++i) {
    char text[64];
    const double value = random_double(random);
    for (const int digits : {5, 9, 17, 25}) {
      std::snprintf(text, sizeof(text), "%.*e", digits, value);
      expect_same(text);
    }
    std::snprintf(text, sizeof(text), "%.9g",
                  static_cast<double>(
                      static_cast<float>(std::ldexp(value, -static_cast<int>(std::log2(std::abs(value) + 1e-300))))));
    expect_same(text);
  }
}

TEST(Decimal, OtherText_IsNoNumber) {
  for (const char* text :
       {"", "-", ".", "e5", "1e", "1e+", "1.2.3", "+1", " 1", "1 ", "0x1", "nan", "inf", "1,5", "--1"}) {
    EXPECT_FALSE(read_double(text)) << text;
    EXPECT_FALSE(read_float(text)) << text;
  }
}

TEST(Decimal, Writing_IsThatOfTheStandardLibrary) {
  std::mt19937_64 random(11);
  for (int i = 0; i < 5000; ++i) {
    const double value =
        i % 2 == 0 ? random_double(random) : std::ldexp(static_cast<double>(static_cast<std::int64_t>(random())), -50);
    char text[2000];
    auto end = std::to_chars(text, text + sizeof(text), value, std::chars_format::fixed).ptr;
    EXPECT_EQ(read_double(shortest_fixed_text(value)), value);
    EXPECT_EQ(shortest_fixed_text(value).size(), static_cast<std::size_t>(end - text)) << std::string(text, end);
    EXPECT_EQ(read_double(shortest_text(value)), value);
    EXPECT_LE(shortest_text(value).size(), nlohmann::json(value).dump().size());
    for (const int digits : {0, 3, 10}) {
      end = std::to_chars(text, text + sizeof(text), value, std::chars_format::fixed, digits).ptr;
      EXPECT_EQ(fixed_text(value, digits), std::string(text, end));
    }
  }
  // to_chars writes all digits of these.
  EXPECT_EQ(shortest_fixed_text(1e23), "1" + std::string(23, '0'));
  for (const double value : {0.0, -0.0, 1.0, -1.0, 0.5, 1e15, 1e14, 123456.0, 1e-4, 1e-5, 5e-324,
                             1.7976931348623157e308, 0.1, 0.3, 2.0 / 3.0})
    EXPECT_EQ(shortest_text(value), nlohmann::json(value).dump());
  EXPECT_EQ(fixed_text(0.5, 0), "0");  // ties to even, as printf
  EXPECT_EQ(fixed_text(1.5, 0), "2");
  EXPECT_EQ(fixed_text(9.99, 1), "10.0");
  EXPECT_EQ(shortest_fixed_text(0.001), "0.001");
  EXPECT_EQ(shortest_fixed_text(1e21), "1000000000000000000000");
}

TEST(Decimal, WholeNumbers_AreThoseOfTheStandardLibrary) {
  std::mt19937_64 random(13);
  for (unsigned shift = 0; shift < 64; ++shift) {
    for (int i = 0; i < 20; ++i) {
      const std::uint64_t value = random() >> shift;
      EXPECT_EQ(natural_text(value), std::to_string(value));
      EXPECT_EQ(whole_text(static_cast<std::int64_t>(value)), std::to_string(static_cast<std::int64_t>(value)));
    }
  }
  EXPECT_EQ(natural_text(0), "0");
  EXPECT_EQ(natural_text(~std::uint64_t{0}), "18446744073709551615");
  EXPECT_EQ(whole_text(0), "0");
  EXPECT_EQ(whole_text(std::numeric_limits<std::int64_t>::min()), "-9223372036854775808");
}

TEST(Decimal, PowersOfTenAndTheirNeighbours_HaveTheFewestDigits) {
  for (int power = -323; power <= 308; ++power) {
    const double ten = standard<double>("1e" + std::to_string(power));
    for (const double value : {std::nextafter(ten, 0.0), ten, std::nextafter(ten, 1e300)}) {
      EXPECT_EQ(read_double(shortest_text(value)), value) << power;
      EXPECT_LE(shortest_text(value).size(), nlohmann::json(value).dump().size()) << power;
    }
    if (power < -4 || power > 15) {
      const std::string exponent = std::to_string(std::abs(power));
      EXPECT_EQ(shortest_text(ten),
                (power < 0 ? "1e-" : "1e+") + std::string(exponent.size() < 2 ? "0" : "") + exponent);
    }
  }
}

/// The neighbour above a power of two is farther than that below: the fewest digits need not be the nearest ones.
TEST(Decimal, PowersOfTwo_HaveTheFewestDigits) {
  EXPECT_EQ(shortest_text(0x1p-1017), "7.120236347223045e-307");
  const auto digits_of = [](std::string text) {
    text = text.substr(0, text.find('e'));
    std::erase(text, '.');
    text.erase(0, text.find_first_not_of('0'));
    return text.substr(0, text.find_last_not_of('0') + 1);
  };
  for (int exponent = -1074; exponent < 1024; ++exponent) {
    const double value = std::ldexp(1.0, exponent);
    char text[64];
    const auto end = std::to_chars(text, text + sizeof(text), value, std::chars_format::scientific).ptr;
    EXPECT_EQ(digits_of(shortest_text(value)), digits_of(std::string(text, end))) << exponent;
    EXPECT_EQ(read_double(shortest_text(value)), value) << exponent;
  }
}

}  // namespace
}  // namespace semblante
