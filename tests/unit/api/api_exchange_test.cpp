// The checker that every exchange of the server's tests goes through: that it finds what is wrong.

#include "tests/support/api_exchange.h"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/json_schema.h"

namespace semblante::test {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> faults(const json& schema, const json& value,
                                UnknownMembers unknown = UnknownMembers::refused) {
  return schema_faults(json::object(), schema, value, unknown);
}

TEST(JsonSchema, EveryKeyword_FindsItsFault) {
  struct Case {
    const char* name;
    json schema, good, bad;
  };
  const json pair = {{"type", "object"}, {"properties", {{"a", {{"type", "integer"}}}}}, {"required", {"a"}}};
  const std::vector<Case> cases = {
      {"type", {{"type", "integer"}}, 1, 1.5},
      {"types", {{"type", {"string", "null"}}}, nullptr, 1},
      {"const", {{"const", "ok"}}, "ok", "no"},
      {"enum", {{"enum", {"a", nullptr}}}, nullptr, "b"},
      {"minimum", {{"minimum", 0}}, 0, -1},
      {"maximum", {{"maximum", 1}}, 1, 1.1},
      {"exclusiveMinimum", {{"exclusiveMinimum", 0}}, 0.1, 0},
      {"minLength", {{"minLength", 1}}, "\xC3\xA9", ""},
      {"maxLength", {{"maxLength", 1}}, "\xC3\xA9", "ab"},
      {"pattern", {{"pattern", "^a+$"}}, "aa", "ab"},
      {"format", {{"format", "date-time"}}, "2024-01-02T03:04:05.678Z", "yesterday"},
      {"items", {{"items", {{"type", "string"}}}}, {"a"}, {"a", 1}},
      {"minItems", {{"minItems", 1}}, {1}, json::array()},
      {"maxItems", {{"maxItems", 1}}, {1}, {1, 2}},
      {"required", pair, {{"a", 1}}, json::object()},
      {"properties", pair, {{"a", 1}}, {{"a", "b"}}},
      {"a member that is not known", pair, {{"a", 1}}, {{"a", 1}, {"b", 1}}},
      {"additionalProperties", {{"additionalProperties", {{"type", "string"}}}}, {{"a", "b"}}, {{"a", 1}}},
      {"no additionalProperties", {{"additionalProperties", false}}, json::object(), {{"a", 1}}},
      {"propertyNames", {{"propertyNames", {{"pattern", "^[0-9]$"}}}}, {{"1", 1}}, {{"a", 1}}},
      {"allOf", {{"allOf", {{{"minimum", 0}}, {{"maximum", 1}}}}}, 1, 2},
      {"anyOf", {{"anyOf", {{{"type", "null"}}, {{"type", "string"}}}}}, "a", 1},
      {"oneOf", {{"oneOf", {{{"minimum", 0}}, {{"maximum", 1}}}}}, 2, 1},
      {"false", false, {}, {}}};
  for (const auto& item : cases) {
    SCOPED_TRACE(item.name);
    if (item.schema != false) {
      EXPECT_THAT(faults(item.schema, item.good), IsEmpty());
    }
    EXPECT_EQ(faults(item.schema, item.bad).size(), 1U) << json(faults(item.schema, item.bad));
  }
}

TEST(JsonSchema, UnknownMember_IsFoundAcrossAllOfAndWithinArrays) {
  const json schema = {
      {"items", {{"allOf", {{{"properties", {{"a", json::object()}}}}, {{"properties", {{"b", json::object()}}}}}}}}};
  EXPECT_THAT(faults(schema, {{{"a", 1}, {"b", 2}}}), IsEmpty());
  EXPECT_THAT(faults(schema, {{{"a", 1}}, {{"b", 2}, {"c", 3}}}), ElementsAre(HasSubstr("/1/c")));
  EXPECT_THAT(faults(schema, {{{"c", 3}}}, UnknownMembers::allowed), IsEmpty());
}

TEST(JsonSchema, UnknownKeyword_IsNotPassedOver) {
  EXPECT_THROW(faults({{"minProperties", 1}}, json::object()), std::logic_error);
  EXPECT_THROW(faults({{"format", "uuid"}}, "a"), std::logic_error);
  EXPECT_THAT(faults({{"x-words", 1}, {"description", "of people"}}, 1), IsEmpty());
}

const json& document() {
  static const json parsed = json::parse(R"({
    "paths": {"/v1/things/{thing}": {"put": {
      "requestBody": {"content": {"application/json": {"schema":
        {"type": "object", "additionalProperties": false, "properties": {"name": {"type": "string"}}}}}},
      "responses": {
        "200": {"description": "", "content": {"application/json": {"schema": {"$ref": "#/components/schemas/Thing"}}}},
        "204": {"description": ""},
        "404": {"$ref": "#/components/responses/Problem"}}}}},
    "components": {
      "schemas": {"Thing": {"type": "object", "required": ["name"], "properties": {"name": {"type": "string"}}}},
      "responses": {"Problem": {"content": {"application/problem+json": {"schema":
        {"type": "object", "required": ["type"], "properties": {"type": {"type": "string"}}}}}}}}})");
  return parsed;
}

TEST(ApiExchange, RightAnswers_HaveNoFaults) {
  const std::string json_type = "application/json; charset=utf-8", problem = "application/problem+json";
  EXPECT_THAT(exchange_faults(document(),
                              {"PUT", "/v1/things/a?x=1", "", R"({"name":"b"})", 200, json_type, R"({"name":"b"})"}),
              IsEmpty());
  EXPECT_THAT(exchange_faults(document(), {"PUT", "/v1/things/a", "", "", 204, "", ""}), IsEmpty());
  EXPECT_THAT(exchange_faults(document(), {"PUT", "/v1/things/a", "", "{", 404, problem, R"({"type":"a"})"}),
              IsEmpty());
  EXPECT_THAT(exchange_faults(document(), {"PUT", "/v1/none", "", "", 404, problem, R"({"type":"a"})"}), IsEmpty());
  EXPECT_THAT(exchange_faults(document(), {"GET", "/page.html", "", "", 200, "text/html", "<p>"}), IsEmpty());
}

TEST(ApiExchange, EachFault_IsFound) {
  const std::string json_type = "application/json", problem = "application/problem+json";
  const std::vector<std::pair<ApiExchange, const char*>> cases = {
      {{"PUT", "/v1/things/a", "", "", 201, json_type, R"({"name":"b"})"}, "status 201"},
      {{"PUT", "/v1/things/a", "", "", 200, "text/plain", R"({"name":"b"})"}, "media type text/plain"},
      {{"PUT", "/v1/things/a", "", "", 200, json_type, R"({"name":)"}, "no JSON"},
      {{"PUT", "/v1/things/a", "", "", 200, json_type, R"({"nam":"b"})"}, "name is missing"},
      {{"PUT", "/v1/things/a", "", "", 200, json_type, R"({"name":"b","size":1})"}, "/size"},
      {{"PUT", "/v1/things/a", "", "", 204, "", "words"}, "has a body"},
      {{"PUT", "/v1/things/a", "", "", 404, json_type, R"({"type":"a"})"}, "media type application/json"},
      {{"PUT", "/v1/things/a", "", "", 404, problem, R"({"type":"a","extra":1})"}, "/extra"},
      {{"PUT", "/v1/things/a", "", R"({"size":1})", 204, "", ""}, "/size"},
      {{"PUT", "/v1/things/a", "text/plain", "words", 204, "", ""}, "text/plain was taken"},
      {{"POST", "/v1/things/a", "", "", 405, json_type, "{}"}, "media type"},
      {{"GET", "/v1/none", "", "", 200, json_type, "{}"}, "no such operation"},
  };
  for (const auto& [exchange, words] : cases) {
    SCOPED_TRACE(words);
    const auto found = exchange_faults(document(), exchange);
    ASSERT_FALSE(found.empty());
    EXPECT_THAT(found.front(), HasSubstr(words));
  }
}

}  // namespace
}  // namespace semblante::test
