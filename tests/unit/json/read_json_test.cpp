#include "core/json/read_json.h"

#include <malloc.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/json/json_pointer.h"

namespace semblante {
namespace {

using nlohmann::json;

struct Refused {
  const char* name;
  std::string text;
  ErrorCode code;
  const char* where;
};

std::string repeated(std::string_view text, std::size_t times) {
  std::string all;
  for (std::size_t i = 0; i < times; ++i) all += text;
  return all;
}

/// A view as JSON text; strings without escapes.
std::string written(const JsonView& view) {
  std::string text;
  switch (view.kind()) {
    case JsonKind::array:
      for (std::size_t i = 0; i < view.size(); ++i) text += (i == 0 ? "" : ",") + written(view.element(i));
      return "[" + text + "]";
    case JsonKind::object:
      view.members([&](std::string_view name, const JsonView& value) {
        text += (text.empty() ? "\"" : ",\"") + std::string(name) + "\":" + written(value);
      });
      return "{" + text + "}";
    case JsonKind::text:
      return "\"" + std::string(view.text()) + "\"";
    default:
      return std::to_string(view.natural());
  }
}

TEST(ReadJson, WhatIsRefused_IsNamedWithItsPlace) {
  const std::vector<Refused> all = {
      {"nothing", "", ErrorCode::malformed, ""},
      {"blanks", " \n", ErrorCode::malformed, ""},
      {"no JSON", "hello", ErrorCode::malformed, ""},
      {"open object", "{", ErrorCode::malformed, ""},
      {"open text", R"({"a": "b)", ErrorCode::malformed, ""},
      {"text after the value", "{} x", ErrorCode::malformed, ""},
      {"two values", "1 2", ErrorCode::malformed, ""},
      {"NUL after the value", std::string("{}\0", 3), ErrorCode::malformed, ""},
      {"NUL and more", std::string("{}\0{\"a\":1}", 10), ErrorCode::malformed, ""},
      {"NUL in a text", std::string("[\"a\0b\"]", 7), ErrorCode::malformed, ""},
      {"comment", "[1 /* one */]", ErrorCode::malformed, ""},
      {"trailing comma", "[1,]", ErrorCode::malformed, ""},
      {"NaN", "[NaN]", ErrorCode::malformed, ""},
      {"leading zero", "[01]", ErrorCode::malformed, ""},
      {"single quotes", "['a']", ErrorCode::malformed, ""},
      {"control character", "[\"a\nb\"]", ErrorCode::malformed, ""},
      {"lone surrogate", R"(["\ud800"])", ErrorCode::malformed, ""},
      {"byte that begins nothing", "[\"\xFF\"]", ErrorCode::malformed, ""},
      {"overlong UTF-8", "[\"\xC0\xAF\"]", ErrorCode::malformed, ""},
      {"UTF-8 of a surrogate", "[\"\xED\xA0\x80\"]", ErrorCode::malformed, ""},
      {"cut UTF-8", "[\"\xE2\x82\"]", ErrorCode::malformed, ""},
      {"UTF-8 outside of texts", "[\xC3\xA4]", ErrorCode::malformed, ""},
      {"UTF-16", std::string("\xFF\xFE{\0}\0", 6), ErrorCode::malformed, ""},
      {"member twice", R"({"a": 1, "a": 1})", ErrorCode::malformed, "/a"},
      {"member twice, spelt otherwise", R"({"a": 1, "\u0061": 2})", ErrorCode::malformed, "/a"},
      {"member twice, deep", R"({"x": [0, {"a/b": {"~": 1, "c": [], "~": 2}}]})", ErrorCode::malformed, "/x/1/a~1b/~0"},
      {"member twice, an object", R"({"a": {"b": 1}, "a": {}})", ErrorCode::malformed, "/a"},
      {"number too large", R"({"a": [1, 1e999]})", ErrorCode::not_finite, "/a/1"},
      {"number too small", "[-1e999]", ErrorCode::not_finite, "/0"},
      {"too deep", repeated("[", 65) + repeated("]", 65), ErrorCode::too_large, nullptr},
      {"too deep, not closed", R"({"x": )" + repeated("[", 100'000), ErrorCode::too_large, nullptr},
      {"too deep, objects", repeated(R"({"k":)", 65), ErrorCode::too_large, nullptr},
  };
  for (const Refused& refused : all) {
    const auto document = read_json(refused.text);
    ASSERT_FALSE(document) << refused.name;
    EXPECT_EQ(document.error().code, refused.code) << refused.name << ": " << document.error().message;
    if (refused.where != nullptr) {
      EXPECT_EQ(document.error().where, refused.where) << refused.name;
    }
    EXPECT_FALSE(document.error().message.empty()) << refused.name;
  }
}

TEST(ReadJson, NotJson_SaysTheByte) {
  EXPECT_EQ(read_json("").error().message, "is not valid JSON (byte 1)");
  EXPECT_EQ(read_json("[1,]").error().message, "is not valid JSON (byte 4, in /1)");
  EXPECT_EQ(read_json(std::string("[]\0", 3)).error().message, "is not valid JSON (byte 3)");
}

TEST(ReadJson, WhatIsTaken_IsTheDocument) {
  for (const char* text :
       {R"({"a": [1, -2, 2.5, true, false, null, "x\u00e4\ud83d\ude00"], "b": {}, "": [[], [[]], {"a": {}}]})", "[]",
        "{}", "7", "\"\"", "null", " [ 1 , 2 ] \r\n\t", R"([{"a": 1}, {"a": 1}])"}) {
    const auto document = read_json(text);
    ASSERT_TRUE(document) << text << document.error().message;
    EXPECT_EQ(*document, json::parse(text));
  }
}

TEST(ReadJson, ByteOrderMark_IsSkipped) {
  const auto document = read_json("\xEF\xBB\xBF{\"a\": 1}");
  ASSERT_TRUE(document) << document.error().message;
  EXPECT_EQ(*document, json({{"a", 1}}));
  EXPECT_FALSE(read_json("\xEF\xBB\xBF"));
  EXPECT_FALSE(read_json("\xEF\xBB{}"));
}

TEST(ReadJson, OtherEncodings_AreNamed) {
  for (const std::string_view text :
       {std::string_view("\xFF\xFE{\0}\0", 6), std::string_view("\xFE\xFF\0{\0}", 6), std::string_view("{\0}\0", 4),
        std::string_view("\0{\0}", 4), std::string_view("{\0\0\0}\0\0\0", 8), std::string_view("\0\0\0{", 4)}) {
    const auto refused = read_json(text);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::malformed);
    EXPECT_EQ(refused.error().message, "must be UTF-8, not UTF-16 or UTF-32");
  }
}

TEST(ReadJson, WholeNumbersBeyond64Bits_AreReals) {
  const auto document = read_json("[18446744073709551615, 18446744073709551616, -9223372036854775808, 1e-999]");
  ASSERT_TRUE(document) << document.error().message;
  EXPECT_EQ((*document)[0].get<std::uint64_t>(), 18446744073709551615U);
  EXPECT_TRUE((*document)[1].is_number_float());
  EXPECT_EQ((*document)[2].get<std::int64_t>(), std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ((*document)[3].get<double>(), 0.0);
}

TEST(ReadJson, Limits_HoldToTheLastValue) {
  EXPECT_TRUE(read_json(repeated("[", 64) + repeated("]", 64)));
  EXPECT_TRUE(read_json("[[1],[2]]", {.max_bytes = 9, .max_depth = 2, .max_values = 5}));
  EXPECT_EQ(read_json("[[1],[2]]", {.max_bytes = 8}).error().code, ErrorCode::too_large);
  const auto deep = read_json("[0,[[1]]]", {.max_depth = 2});
  EXPECT_EQ(deep.error().code, ErrorCode::too_large);
  EXPECT_EQ(deep.error().where, "/1/0");
  const auto many = read_json(R"({"a":[[1],[2,3]]})", {.max_values = 6});
  EXPECT_EQ(many.error().code, ErrorCode::too_large);
  EXPECT_EQ(many.error().where, "/a/1/1");
  EXPECT_EQ(read_json(R"({"a":{},"b":{}})", {.max_values = 2}).error().where, "/b");
}

TEST(ReadJson, Pointers_AreShortAndPrintable) {
  const auto twice = read_json("{\"a\\u0000\\u001b\": 1, \"a\\u0000\\u001b\": 2}");
  EXPECT_EQ(twice.error().where, "/a??");
  const std::string name = "\"" + std::string(100'000, 'n') + "\":";
  std::string text;
  for (int i = 0; i < 10; ++i) text += "{" + name;
  const auto deep = read_json(text + "1e999");
  EXPECT_EQ(deep.error().code, ErrorCode::not_finite);
  EXPECT_LE(deep.error().where.size(), 1000U);
  EXPECT_TRUE(deep.error().where.ends_with("/..."));
}

TEST(ReadJson, ObjectIsWanted_NothingElseIsTaken) {
  EXPECT_TRUE(read_json_object("{}"));
  const auto array = read_json_object("[]");
  ASSERT_FALSE(array);
  EXPECT_EQ(array.error().message, "must be an object, not an array");
}

TEST(ReadJson, Elements_AreHandedOverOneByOne) {
  std::vector<std::string> taken;
  const JsonElements elements{"list", [&](std::size_t index, const JsonView& element) -> Status {
                                EXPECT_EQ(index, taken.size());
                                taken.push_back(written(element));
                                return Unit{};
                              }};
  const auto tree =
      read_json_object_tree(R"({"x": {"list": [1]}, "list": [1, [2, {}], {"list": [3]}, "4"], "y": 5})", {}, &elements);
  ASSERT_TRUE(tree) << tree.error().message;
  EXPECT_EQ(written(tree->root()), R"({"list":[],"x":{"list":[1]},"y":5})");
  EXPECT_EQ(taken, (std::vector<std::string>{"1", "[2,{}]", R"({"list":[3]})", "\"4\""}));
}

TEST(ReadJson, ElementsHandedOver_AreCountedOneByOne) {
  const JsonElements elements{"list", [](std::size_t, const JsonView&) -> Status { return Unit{}; }};
  const std::string text = R"({"list": [)" + repeated("[0,0],", 10'000) + "[0,0]]}";
  EXPECT_TRUE(read_json_object_tree(text, {.max_values = 5}, &elements));
  EXPECT_FALSE(read_json_object_tree(text, {.max_values = 4}, &elements));
  const auto twice = read_json_object_tree(R"({"list": [0, 1, {"a": 1, "a": 2}]})", {}, &elements);
  EXPECT_EQ(twice.error().where, "/list/2/a");
  const auto again = read_json_object_tree(R"({"list": [0], "list": [1]})", {}, &elements);
  EXPECT_EQ(again.error().where, "/list");
  EXPECT_EQ(read_json_object_tree(R"({"list": [0, 1e999]})", {}, &elements).error().where, "/list/1");
  const JsonElements refused_elements{"list", [](std::size_t index, const JsonView&) -> Status {
                                        if (index == 1) return Error{ErrorCode::too_large, "/here", "no more"};
                                        return Unit{};
                                      }};
  const auto refused = read_json_object_tree(R"({"list": [0, 1, 2], not JSON)", {}, &refused_elements);
  EXPECT_EQ(refused.error().where, "/here");
}

TEST(ReadJson, Memory_IsBoundedByTheValues) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the sanitizer's allocator does not count";
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
  GTEST_SKIP() << "the sanitizer's allocator does not count";
#endif
#endif
  constexpr std::size_t body = std::size_t{1} << 20U;
  const auto filled = [](std::string_view begin, std::string_view one, std::string_view end) {
    std::string text(begin);
    while (text.size() + one.size() + end.size() + 1 < body) (text += one) += ',';
    text.back() = ' ';
    return text += end;
  };
  for (const std::string& text : {filled("[", "[]", "]"), filled("[", "0", "]"), filled("[", "{}", "]"),
                                  filled("[", R"({"":0})", "]"), filled("[", R"("")", "]"), filled("[", "[[]]", "]")}) {
    const std::size_t before = mallinfo2().uordblks + mallinfo2().hblkhd;
    const auto document = read_json(text);
    ASSERT_TRUE(document) << document.error().message;
    const std::size_t held = mallinfo2().uordblks + mallinfo2().hblkhd - before;
    EXPECT_LT(held, 60 * body) << text.substr(0, 12);
    EXPECT_GT(held, body) << text.substr(0, 12) << ": nothing was measured";
  }
}

}  // namespace
}  // namespace semblante
