#include <array>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "server/http/conditional.h"
#include "server/http/media_type.h"
#include "server/http/multipart.h"
#include "server/http/problem.h"
#include "server/http/request_id.h"
#include "server/http/url.h"

namespace semblante::http {
namespace {

TEST(Url, BrokenTargets_AreRefused) {
  for (const auto* target :
       {"", "x", "http://host/", "/%", "/%1", "/%zz", "/a%00b", "/?a=%g0", "/v1%2Fstreams", "/..%2f..%2fetc"})
    EXPECT_FALSE(parse_target(target)) << target;
}

TEST(Url, Target_IsTakenApart) {
  const auto target = parse_target("/v1/a%20b?x=1%2B2&y=a+b&z#end");
  ASSERT_TRUE(target);
  EXPECT_EQ(target->repeated, "");
  EXPECT_EQ(target->path, "/v1/a b");
  EXPECT_EQ(target->query, (std::map<std::string, std::string>{{"x", "1+2"}, {"y", "a b"}, {"z", ""}}));
}

TEST(Url, KeyGivenTwice_IsNamed_HoweverItIsWritten) {
  const auto target = parse_target("/?a=1&x=1&%78=2&a=1");
  ASSERT_TRUE(target);
  EXPECT_EQ(target->repeated, "x");
  EXPECT_EQ(target->query, (std::map<std::string, std::string>{{"a", "1"}, {"x", "1"}}));
}

TEST(Url, AbsoluteForm_IsAHostAndATarget) {
  for (const auto& [target, authority, rest] :
       std::vector<std::array<std::string, 3>>{{"http://localhost:8080/version?a=1", "localhost:8080", "/version?a=1"},
                                               {"HTTPS://[::1]/", "[::1]", "/"},
                                               {"http://head.example", "head.example", "/"},
                                               {"http://head.example?a", "head.example", "/?a"},
                                               {"http://a@b/http://c/", "a@b", "/http://c/"}}) {
    const auto absolute = absolute_target(target);
    ASSERT_TRUE(absolute) << target;
    EXPECT_EQ(absolute->authority, authority);
    EXPECT_EQ(absolute->rest, rest);
  }
  for (const auto* target : {"", "/http://a/", "http:///a", "http://", "ftp://a/", "http:/a", "*"})
    EXPECT_FALSE(absolute_target(target)) << target;
}

TEST(MediaType, FileName_BeyondAscii_IsThatOfTheExtendedParameter) {
  EXPECT_EQ(file_name_of(R"(form-data; name=file; filename="a.obj")"), "a.obj");
  EXPECT_EQ(file_name_of("form-data; name=file; filename*=UTF-8''cabe%C3%A7a.obj"), "cabe\xC3\xA7\x61.obj");
  EXPECT_EQ(file_name_of(R"(form-data; filename="=?utf-8?B?Y2FiZcOnYS5vYmo=?="; filename*=utf-8'pt'cabe%C3%A7a.obj)"),
            "cabe\xC3\xA7\x61.obj")
      << "as .NET writes it";
  for (const char* const broken : {"UTF-8''%ZZ", "UTF-8''a%00", "x", "UTF-16''%00a", "'", ""})
    EXPECT_EQ(file_name_of(std::string("form-data; filename*=") + broken + "; filename=a.obj"), "a.obj") << broken;
}

TEST(MediaType, Parameters_MayBeQuotedAndHoldSemicolons) {
  EXPECT_EQ(parameter(R"(form-data; name="a;b\"c"; filename=x.obj)", "name"), "a;b\"c");
  EXPECT_EQ(parameter(R"(form-data; name="a;b"; filename=x.obj)", "FILENAME"), "x.obj");
  EXPECT_EQ(parameter("form-data", "name"), "");
  EXPECT_EQ(essence(" Text/HTML ; charset=utf-8"), "text/html");
}

TEST(MediaType, Accept_MostSpecificRangeDecides) {
  EXPECT_TRUE(accepts("", "application/json"));
  EXPECT_TRUE(accepts("*/*", "application/json"));
  EXPECT_TRUE(accepts("text/html, application/*;q=0.5", "application/json"));
  EXPECT_FALSE(accepts("text/html", "application/json"));
  EXPECT_FALSE(accepts("*/*, application/json;q=0", "application/json"));
  EXPECT_TRUE(accepts("*/*;q=0, application/json;q=0.001", "application/json"));
}

Response tagged() {
  Response response;
  response.headers["ETag"] = "\"t\"";
  response.headers["Cache-Control"] = "no-cache";
  response.body = std::string("0123456789");
  return response;
}

Response conditioned(const Headers& headers, const std::string& method = "GET") {
  Request request;
  request.method = method;
  request.headers = headers;
  return apply_conditions(request, tagged());
}

TEST(Conditional, Tags_GiveNotModifiedOrFailed) {
  EXPECT_EQ(conditioned({{"If-None-Match", "\"a\", W/\"t\""}}).status, 304);
  EXPECT_EQ(conditioned({{"If-None-Match", "*"}}).status, 304);
  EXPECT_EQ(conditioned({{"If-None-Match", "\"a\""}}).status, 200);
  EXPECT_EQ(conditioned({{"If-Match", "\"a\""}}).status, 412);
  EXPECT_EQ(conditioned({{"If-Match", "W/\"t\""}}).status, 412) << "a weak tag proves nothing about the bytes";
  EXPECT_EQ(conditioned({{"If-Match", "\"t\""}}).status, 200);
  EXPECT_EQ(conditioned({{"If-None-Match", "\"t\""}}).headers.at("ETag"), "\"t\"");
}

TEST(Conditional, Ranges_FollowTheRfc) {
  const auto body = [](const Response& response) { return std::get<std::string>(response.body); };
  const auto first = conditioned({{"Range", "bytes=0-3"}});
  EXPECT_EQ(first.status, 206);
  EXPECT_EQ(body(first), "0123");
  EXPECT_EQ(first.headers.at("Content-Range"), "bytes 0-3/10");
  EXPECT_EQ(body(conditioned({{"Range", "bytes=8-"}})), "89");
  EXPECT_EQ(body(conditioned({{"Range", "bytes=8-99"}})), "89");
  EXPECT_EQ(body(conditioned({{"Range", "bytes=-3"}})), "789");
  EXPECT_EQ(body(conditioned({{"Range", "bytes=-99"}})), "0123456789");
  for (const auto* outside : {"bytes=10-", "bytes=10-12", "bytes=-0"})
    EXPECT_EQ(conditioned({{"Range", outside}}).status, 416) << outside;
  for (const auto* ignored :
       {"bytes=3-1", "lines=0-1", "bytes=a-b", "bytes=0-1,3-4", "bytes=", "bytes=18446744073709551616-"})
    EXPECT_EQ(conditioned({{"Range", ignored}}).status, 200) << ignored;
  EXPECT_EQ(conditioned({{"Range", "bytes=0-3"}, {"If-Range", "\"other\""}}).status, 200);
  EXPECT_EQ(conditioned({{"Range", "bytes=0-3"}}, "HEAD").status, 200);
}

TEST(Multipart, BrokenForms_AreRefused) {
  for (const auto* body : {"", "x", "--B", "--B\r\n", "--Bx\r\n\r\n", "--B\r\nName: x", "--B\r\n\r\ncontent",
                           "--B\r\n\r\ncontent\r\n--C--"})
    EXPECT_FALSE(parse_multipart(body, "B")) << body;
  EXPECT_FALSE(parse_multipart("--B--", ""));
  std::string many;
  for (int i = 0; i < 20; ++i) many += "--B\r\n\r\nx\r\n";
  EXPECT_FALSE(parse_multipart(many + "--B--", "B"));
}

TEST(Multipart, Parts_AreFound) {
  const std::string body =
      "preamble\r\n--B\r\nContent-Disposition: form-data; name=\"name\"\r\n\r\nA\r\n--B\r\ncontent-disposition: "
      "form-data; "
      "name=file; filename=\"h.glb\"\r\nContent-Type: "
      "model/gltf-binary\r\n\r\n\r\n--\r\nraw\r\n--B\r\n\r\n\r\n--B--\r\n";
  const auto parts = parse_multipart(body, "B");
  ASSERT_TRUE(parts) << parts.error().message;
  ASSERT_EQ(parts->size(), 3U);
  EXPECT_EQ((*parts)[0].name, "name");
  EXPECT_EQ((*parts)[0].content, "A");
  EXPECT_EQ((*parts)[1].file_name, "h.glb");
  EXPECT_EQ((*parts)[1].content, "\r\n--\r\nraw");
  EXPECT_EQ((*parts)[2].content, "");
}

TEST(RequestId, IsRandom_AndForeignOnesMustFitALine) {
  EXPECT_NE(new_request_id(), new_request_id());
  EXPECT_TRUE(is_request_id(new_request_id()));
  EXPECT_TRUE(is_request_id("4bf92f35-77b3.4da6_A"));
  for (const std::string_view bad : {"", "a b", "a\"b", "a\nb", "\xc3\xa9"}) EXPECT_FALSE(is_request_id(bad));
  EXPECT_FALSE(is_request_id(std::string(65, 'a')));
}

TEST(RequestId, IsAMemberOfProblemDocuments_AndOfNothingElse) {
  auto refusal = to_response(make_problem("not-found", "no \"such\" thing"));
  add_request_id(refusal, "r1");
  const auto json = nlohmann::json::parse(std::get<std::string>(refusal.body));
  EXPECT_EQ(json["request"], "r1");
  EXPECT_EQ(json["detail"], "no \"such\" thing");
  Response other;
  other.headers["Content-Type"] = "application/json";
  other.body = std::string("{}\n");
  add_request_id(other, "r1");
  EXPECT_EQ(std::get<std::string>(other.body), "{}\n");
}

TEST(Problem, Json_ComesBackAsItWas) {
  auto problem = make_problem("invalid-feature-point", "vertex 9 is not there", "/points/2.1/vertex");
  problem.faults = {{"/points/2.1/vertex", "vertex 9 is not there"}, {"/points/2.2", "neither"}};
  EXPECT_EQ(problem_from_json(to_json(problem)), problem);
  EXPECT_EQ(problem_from_json("no json").slug, "internal");
}

TEST(Problem, OfAnEndlessName_HasItsBeginning) {
  std::string name = "not a point ";
  for (int i = 0; i < 100'000; ++i) name += "\u00e3";
  Problem problem = make_problem("invalid-feature-point", name, "/points/" + name);
  problem.faults.assign(2, {problem.pointer, problem.detail});
  const std::string json = to_json(problem);
  EXPECT_LT(json.size(), 9'000U);
  const Problem back = problem_from_json(json);
  EXPECT_EQ(back.pointer.substr(0, 20), "/points/not a point ");
  EXPECT_EQ(back.detail.substr(back.detail.size() - 5), "\u00e3...");
}

TEST(Problem, Advice_IsThatOfTheErrorOrElseOfItsKind) {
  EXPECT_EQ(problem_from({ErrorCode::malformed, "line 3", "x"}).advice, Advice::export_again);
  EXPECT_EQ(problem_from({ErrorCode::malformed, "", "x", Advice::unpack}).advice, Advice::unpack);
  EXPECT_EQ(problem_from({ErrorCode::out_of_range, "/points/2.1", "x"}).advice, Advice::move_points);
  EXPECT_EQ(problem_from({ErrorCode::internal, "", "x"}).advice, std::nullopt);
  EXPECT_EQ(make_problem("conflict", "x").advice, std::nullopt);
}

TEST(Problem, Advice_IsAMemberOfItsName_AndEachComesBack) {
  auto problem = make_problem("malformed-model", "x");
  for (const auto& text : all_advice()) {
    problem.advice = text.advice;
    EXPECT_THAT(to_json(problem), ::testing::HasSubstr("\"advice\":\"" + std::string(text.name) + "\""));
    EXPECT_EQ(problem_from_json(to_json(problem)), problem);
    EXPECT_FALSE(text.words.empty());
  }
  problem.advice = std::nullopt;
  EXPECT_EQ(to_json(problem).find("advice"), std::string::npos);
  EXPECT_EQ(problem_from_json(to_json(problem)), problem) << "stored by an earlier version";
  EXPECT_EQ(problem_from_json(R"({"title":"x","detail":"y","advice":"of-a-later-version"})").advice, std::nullopt);
}

TEST(Problem, ErrorAtAPoint_IsAboutThatPoint) {
  EXPECT_EQ(problem_from({ErrorCode::out_of_range, "/points/2.1", "x"}).slug, "invalid-feature-point");
  EXPECT_EQ(problem_from({ErrorCode::out_of_range, "line 3", "x"}).slug, "malformed-model");
}

}  // namespace
}  // namespace semblante::http
