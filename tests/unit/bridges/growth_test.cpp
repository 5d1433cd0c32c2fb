// A take of Live Link Face is read in time in proportion to its bytes.

#include "tests/support/growth.h"

#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "core/bridges/live_link_csv.h"

namespace semblante {
namespace {

void expect_linear_take(const std::string& what, std::size_t most,
                        const std::function<std::string(std::size_t)>& make) {
  test::expect_linear("take: " + what, {.from = most / 1024 + 1, .most = most}, make,
                      [](const std::string& text) { (void)read_live_link_csv(text); });
}

TEST(BridgesGrowth, LiveLinkCsv) {
  const auto repeated = [](const std::string& begin, const std::string& one, const std::string& end = "") {
    return [=](std::size_t n) {
      std::string text = begin;
      for (std::size_t i = 0; i < n; ++i) text += one;
      return text += end;
    };
  };
  const std::string header = "Timecode,BlendShapeCount,JawOpen,JawLeft\n";
  expect_linear_take("rows", 400'000, repeated(header, "10:00:00:00.000,61,0.5,1e-3\n"));
  expect_linear_take("rows without a face", 400'000, repeated(header, "10:00:00:00.000,0\n"));
  expect_linear_take("rows past midnight", 400'000, repeated(header, "23:59:59:00.0,61,0,0\n00:00:00:00.0,61,0,0\n"));
  expect_linear_take("empty lines", 8'000'000, repeated(header, "\n", "10:00:00:00.000,61,0.5,1e-3\n"));
  expect_linear_take("columns", 1'000'000, repeated("Timecode,JawOpen", ",x", "\n"));
  expect_linear_take("columns of one row", 1'000'000, repeated(header + "10:00:00:00.000", ",1", "\n"));
  expect_linear_take("blanks", 8'000'000, repeated("Timecode,JawOpen", " ", "\n10:00:00:00.000,1\n"));
  expect_linear_take("digits", 8'000'000, repeated(header + "10:00:00:00.000,61,0.", "7", ",1\n"));
}

}  // namespace
}  // namespace semblante
