// Reading JSON takes time in proportion to its bytes, whatever its shape.

#include "tests/support/growth.h"

#include <functional>
#include <string>

#include <nlohmann/json.hpp>

#include "core/json/json_cursor.h"
#include "core/json/read_json.h"

namespace semblante {
namespace {

std::string repeated(const std::string& begin, const std::string& one, std::size_t times, const std::string& end) {
  std::string text = begin;
  for (std::size_t i = 0; i < times; ++i) text.append(i == 0 ? "" : ",").append(one);
  return text + end;
}

void expect_linear_reading(const std::string& what, const std::function<std::string(std::size_t)>& make) {
  test::expect_linear(what, {.from = 2000, .most = 1'500'000}, make,
                      [](const std::string& text) { (void)read_json(text); });
}

TEST(JsonGrowth, ManyValues) {
  for (const std::string one :
       {"{}", "[]", "0", R"("")", "null", R"({"a":{}})", R"([[[]],{}])", "1.25e-3", R"("\u00e4")"})
    expect_linear_reading("many " + one, [&](std::size_t n) { return repeated(R"({"a":[)", one, n, "]}"); });
}

TEST(JsonGrowth, ManyMembers) {
  expect_linear_reading("different members", [](std::size_t n) {
    std::string text = "{";
    for (std::size_t i = 0; i < n; ++i) text.append(i == 0 ? "\"" : ",\"").append(std::to_string(i)).append("\":{}");
    return text += "}";
  });
  expect_linear_reading("members with a long common beginning", [](std::size_t n) {
    std::string text = "{";
    for (std::size_t i = 0; i < n / 8; ++i)
      text.append(i == 0 ? "\"" : ",\"").append(200, 'k').append(std::to_string(i)).append("\":0");
    return text += "}";
  });
  expect_linear_reading("objects with the same members",
                        [](std::size_t n) { return repeated("[", R"({"a":1,"b":[],"c":{}})", n / 4, "]"); });
}

TEST(JsonGrowth, DeepToTheLimit) {
  const std::string open = std::string(60, '[');
  const std::string close = std::string(60, ']');
  const std::string close_objects = std::string(60, '}');
  expect_linear_reading("towers", [&](std::size_t n) { return repeated("[", open + close, n / 60, "]"); });
  std::string objects;
  for (int i = 0; i < 60; ++i) objects += "{\"k\":";
  objects += "0";
  objects += close_objects;
  expect_linear_reading("towers of objects", [&](std::size_t n) { return repeated("[", objects, n / 60, "]"); });
  expect_linear_reading("brackets that are never closed", [](std::size_t n) { return std::string(n, '['); });
}

TEST(JsonGrowth, LongTokens) {
  const auto most = [](const std::string& what, const std::function<std::string(std::size_t)>& make) {
    test::expect_linear(what, {.from = 100'000, .most = 16'000'000}, make,
                        [](const std::string& text) { (void)read_json(text); });
  };
  most("text", [](std::size_t n) { return std::string(n, 'x').insert(0, 1, '"').append(1, '"'); });
  most("text without an end", [](std::size_t n) { return std::string(n, 'x').insert(0, 1, '"'); });
  most("name", [](std::size_t n) { return std::string(n, 'x').insert(0, "{\"").append("\":1e999}"); });
  most("number", [](std::size_t n) { return std::string(n, '7'); });
  most("fraction", [](std::size_t n) { return std::string(n, '0').insert(0, "0.").append("1"); });
  most("exponent", [](std::size_t n) { return std::string(n, '0').insert(0, "1e").append("1"); });
  most("blanks", [](std::size_t n) { return std::string(n, ' ') + "1"; });
  most("invalid UTF-8 at the end",
       [](std::size_t n) { return std::string(n, 'x').insert(0, 1, '"').append(1, '\xFF'); });
}

TEST(JsonGrowth, Cursor) {
  const auto make = [](std::size_t n) {
    std::string text = R"({"list":[)";
    for (std::size_t i = 0; i < n; ++i) text.append(i == 0 ? "" : ",").append(R"({"a":[1,2],"b":"x"})");
    text += R"(],"named":{)";
    for (std::size_t i = 0; i < n; ++i) text.append(i == 0 ? "\"" : ",\"").append(std::to_string(i)).append("\":0");
    return nlohmann::json::parse(text += "}}");
  };
  test::expect_linear("cursor", {.from = 1000, .most = 200'000}, make, [](const nlohmann::json& document) {
    JsonCursor::Report report;
    const JsonCursor root(json_view(document), report);
    double sum = 0.0;
    for (const auto& element : root.member("list").elements(0, 10'000'000)) {
      for (const auto& number : element.member("a").elements(2, 2)) sum += number.number();
      sum += static_cast<double>(element.member("b").text(10).size());
    }
    for (const auto& [name, value] : root.member("named").members()) sum += value.number();
    for (std::size_t i = 0; i < root.member("list").size(); ++i)
      sum += static_cast<double>(root.member("list").element(i).integer_or("c", 1));
    EXPECT_GT(sum, 0.0);
    EXPECT_FALSE(report);
  });
}

TEST(JsonGrowth, ElementsHandedOver) {
  const auto make = [](std::size_t n) { return repeated(R"({"list":[)", R"({"a":[{},{}]})", n, "]}"); };
  test::expect_linear("elements", {.from = 1000, .most = 400'000}, make, [](const std::string& text) {
    const JsonElements elements{"list", [](std::size_t, const JsonView&) -> Status { return Unit{}; }};
    (void)read_json_object_tree(text, {}, &elements);
  });
}

}  // namespace
}  // namespace semblante
