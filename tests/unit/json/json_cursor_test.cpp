#include "core/json/json_cursor.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace semblante {
namespace {

using nlohmann::json;

std::string words_of(const JsonCursor::Report& report) { return report ? report->where + ": " + report->message : ""; }

/// The `where` and the message of the error that `read` returns, the same for a tree and for nlohmann's document.
template <class Read>
std::string fault(const char* text, Read read) {
  const json document = json::parse(text);
  JsonCursor::Report report;
  read(JsonCursor(json_view(document), report));
  const auto tree = read_json_tree(text);
  EXPECT_TRUE(tree) << text;
  JsonCursor::Report report_of_tree;
  read(JsonCursor(*tree, report_of_tree));
  EXPECT_EQ(words_of(report_of_tree), words_of(report)) << text;
  return words_of(report);
}

void expect_what_is_there(const JsonCursor& root) {
  EXPECT_EQ(root.member("n").number(), 1.5);
  EXPECT_EQ(root.member("i").integer(0, 7), 7U);
  EXPECT_EQ(root.member("r").integer(), 4U);
  EXPECT_TRUE(root.member("b").boolean());
  EXPECT_EQ(root.member("t").text(1), "x");
  EXPECT_EQ(root.member("a").size(), 3U);
  EXPECT_EQ(root.member("a").element(2).integer(), 3U);
  EXPECT_EQ(root.member("a").elements(3, 3).size(), 3U);
  EXPECT_EQ(root.member("o").members()[0].second.pointer(), "/o/k~1~0");
  EXPECT_EQ(root.member("o").members()[0].first, "k/~");
  EXPECT_FALSE(root.optional_member("z"));
  EXPECT_EQ(root.index("i", 8), 7U);
  EXPECT_EQ(root.index("z", 8), std::nullopt);
  EXPECT_EQ(root.number_or("z", 2.0), 2.0);
  EXPECT_FALSE(root.failed());
}

TEST(JsonCursor, Reads_WhatIsThere) {
  const char* const text =
      R"({"n": 1.5, "i": 7, "r": 4.0, "b": true, "t": "x", "a": [1, 2, 3], "o": {"l": 2, "k/~": 1}})";
  JsonCursor::Report report;
  const json document = json::parse(text);
  expect_what_is_there(JsonCursor(json_view(document), report));
  const auto tree = read_json_tree(text);
  ASSERT_TRUE(tree);
  expect_what_is_there(JsonCursor(*tree, report));
}

TEST(JsonCursor, FirstFault_IsKept_WithItsPointer) {
  const auto twice = [](const JsonCursor& root) {
    (void)root.member("a").element(1).number();
    (void)root.member("b").text();
  };
  EXPECT_EQ(fault(R"({"a": [1, "x"], "b": 1})", twice), "/a/1: must be a number, not a string");
  EXPECT_EQ(fault(R"({"a": [1, 2]})", twice), "/b: is missing");
  EXPECT_EQ(fault(R"({"a": [1]})", twice), "/a/1: is missing");
  EXPECT_EQ(fault(R"({"a": {}})", twice), "/a: must be an array, not an object");
  EXPECT_EQ(fault("[]", twice), ": must be an object, not an array");
}

TEST(JsonCursor, Integers_AreWholeAndInRange) {
  const auto read = [](const JsonCursor& root) { (void)root.integer(2, 9); };
  EXPECT_EQ(fault("9", read), "");
  EXPECT_EQ(fault("9.0", read), "");
  for (const char* text : {"1", "10", "-3", "18446744073709551615", "1e300", "-1e300", "1", "10.0"}) {
    EXPECT_NE(fault(text, read).find("must be between 2 and 9"), std::string::npos) << text;
  }
  EXPECT_EQ(fault("2.5", read), ": must be a whole number");
  EXPECT_EQ(fault("null", read), ": must be a whole number, not null");
  const auto all = [](const JsonCursor& root) { EXPECT_EQ(root.integer(0, ~std::uint64_t{0}), 18446744073709551615U); };
  EXPECT_EQ(fault("18446744073709551615", all), "");
  const auto exact = [](const JsonCursor& root) { (void)root.integer(0, 18446744073709551614U); };
  EXPECT_NE(fault("18446744073709551615", exact), "");
}

TEST(JsonCursor, Indices_ArePlacesInAnArray) {
  const auto read = [](const JsonCursor& root) { (void)root.index("i", 3); };
  EXPECT_EQ(fault(R"({"i": 2})", read), "");
  EXPECT_EQ(fault(R"({"i": null})", read), "");
  EXPECT_EQ(fault(R"({"i": 3})", read), "/i: must be between 0 and 2, not 3");
  EXPECT_EQ(fault(R"({"i": 0})", [](const JsonCursor& root) { (void)root.index("i", 0); }),
            "/i: refers to an empty list");
  EXPECT_EQ(fault("{}", [](const JsonCursor& root) { (void)root.required_index("i", 3); }), "/i: is missing");
}

TEST(JsonCursor, Elements_AreAsManyAsAskedFor) {
  const auto read = [](const JsonCursor& root) {
    const bool has_elements = !root.elements(2, 3).empty();
    EXPECT_EQ(has_elements, !root.failed());
  };
  EXPECT_EQ(fault("[1,2,3]", read), "");
  EXPECT_EQ(fault("[1]", read), ": must have 2 to 3 elements, not 1");
  EXPECT_EQ(fault("[1,2,3,4]", read), ": must have 2 to 3 elements, not 4");
}

}  // namespace
}  // namespace semblante
