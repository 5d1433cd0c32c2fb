// A displacement set is read in time in proportion to its bytes.

#include "tests/support/growth.h"

#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "core/extract/set_file.h"

namespace semblante {
namespace {

TEST(ExtractGrowth, DisplacementSets) {
  const auto set = [](const std::string& what, std::size_t most, const std::function<std::string(std::size_t)>& make) {
    test::expect_linear("set: " + what, {.from = most / 1024 + 1, .most = most}, make,
                        [](const std::string& text) { (void)parse_displacement_set(text); });
  };
  const auto members = [](std::size_t n, const std::string& value) {
    std::string text;
    for (std::size_t i = 0; i < n; ++i)
      text.append(i == 0 ? "\"" : ",\"").append(std::to_string(i)).append("\":").append(value);
    return text;
  };
  set("points that are none", 9000, [&](std::size_t n) { return R"({"displacements":{)" + members(n, "[]") + "}}"; });
  set("members beside them", 9000, [&](std::size_t n) { return R"({"displacements":{},)" + members(n, "{}") + "}"; });
  set("more members than are read", 400'000,
      [&](std::size_t n) { return R"({"displacements":{)" + members(n, "[0,0,0]") + "}}"; });
  set("a long name", 16'000'000,
      [](std::size_t n) { return R"({"name":")" + std::string(n, 'x') + R"(","displacements":{"2.1":[1,2,3]}})"; });
}

}  // namespace
}  // namespace semblante
