// What a request brings is read in time in proportion to its bytes.

#include "tests/support/growth.h"

#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "server/http/conditional.h"
#include "server/http/media_type.h"
#include "server/http/message.h"
#include "server/http/multipart.h"
#include "server/http/problem.h"
#include "server/http/url.h"

namespace semblante::http {
namespace {

using test::expect_linear;
using Make = std::function<std::string(std::size_t)>;

Make repeated(const std::string& begin, const std::string& one, const std::string& end = "") {
  return [=](std::size_t n) {
    std::string text = begin;
    for (std::size_t i = 0; i < n; ++i) text += one;
    return text += end;
  };
}

TEST(HttpGrowth, Multipart) {
  const std::string boundary(70, 'b');
  const auto form = [&](const std::string& what, const Make& make, std::size_t most = 4'000'000) {
    expect_linear("form: " + what, {.from = most / 4096 + 1, .most = most}, make, [&](const std::string& body) {
      (void)parse_multipart(body, boundary);
      (void)parse_multipart(body, boundary, body.size());
    });
  };
  const std::string delimiter = "--" + boundary;
  const std::string part = "\r\nContent-Disposition: form-data; name=\"a\"; filename=\"b\"\r\n\r\nx\r\n" + delimiter;
  form("parts", repeated(delimiter, part, "--"), 200'000);
  form("empty parts", repeated(delimiter, "\r\n\r\n" + delimiter, "--"), 400'000);
  form("parts that do not end", repeated(delimiter, part), 200'000);
  form("one large part", repeated(delimiter + "\r\n\r\n", "x", "\r\n" + delimiter + "--"), 16'000'000);
  form("beginnings of a boundary", repeated(delimiter + "\r\n\r\n", "\r\n--" + boundary.substr(1), "\r\n"), 400'000);
  form("all of a boundary but its end",
       repeated(delimiter + "\r\n\r\n", "\r\n--" + boundary.substr(0, 69) + "c", "\r\n" + delimiter + "--"), 400'000);
  form("bytes of the boundary", repeated(delimiter + "\r\n\r\n\r\n--", "b", "\r\n"));
  form("line breaks", repeated(delimiter + "\r\n\r\n", "\r\n", delimiter + "--"));
  form("carriage returns", repeated("", "\r"));
  form("blanks behind a boundary", repeated(delimiter, " ", "\r\n"));
  form("headers of parts", repeated(delimiter, "\r\n" + std::string(4000, ':') + "\r\n\r\n\r\n" + delimiter, "--"),
       4000);
  form(
      "parameters of parts",
      [&](std::size_t n) {
        std::string parameters;
        for (int i = 0; i < 1000; ++i) parameters += ";a=\"\\\"";
        return repeated(delimiter, "\r\nContent-Disposition: x" + parameters + "\r\n\r\n\r\n" + delimiter, "--")(n);
      },
      2000);
}

TEST(HttpGrowth, Targets) {
  const auto target = [](const std::string& what, const Make& make) {
    expect_linear("target: " + what, {.from = 1000, .most = 1'000'000}, make,
                  [](const std::string& text) { (void)parse_target(text); });
  };
  target("path", repeated("/", "a/"));
  target("escapes", repeated("/", "%41"));
  target("parameters", [](std::size_t n) {
    std::string text = "/?";
    for (std::size_t i = 0; i < n; ++i) text.append("&").append(std::to_string(i)).append("=1");
    return text;
  });
  target("the same parameter", repeated("/?", "&a=1"));
  target("parameters without names", repeated("/?", "&"));
  target("equals signs", repeated("/?", "="));
  target("fragments", repeated("/", "#"));
}

TEST(HttpGrowth, HeaderFields) {
  const auto field = [](const std::string& what, const Make& make) {
    expect_linear("field: " + what, {.from = 1000, .most = 1'000'000}, make, [](const std::string& text) {
      (void)accepts(text, "application/json");
      (void)etag_matches(text, "\"x\"", true);
      (void)parameter(text, "boundary");
      (void)essence(text);
      Request request;
      request.method = "GET";
      request.headers["Range"] = text;
      request.headers["If-None-Match"] = text;
      request.headers["If-Match"] = "*";
      Response response;
      response.headers["ETag"] = "\"x\"";
      response.body = std::string("body");
      (void)apply_conditions(request, std::move(response));
    });
  };
  field("media types", repeated("", "a/b;q=0.5,"));
  field("media types that match", repeated("", "application/json,"));
  field("parameters", repeated("a/b", ";c=d"));
  field("semicolons", repeated("a/b", ";"));
  field("equals signs", repeated("a/b;", "="));
  field("quotes", repeated("a/b;c=", "\""));
  field("escapes in quotes", repeated("a/b;c=\"", "\\"));
  field("commas", repeated("", ","));
  field("blanks", repeated("", " "));
  field("entity tags", repeated("", "W/\"abc\", "));
  field("ranges", repeated("bytes=0-1", ",2-3"));
  field("digits of a range", repeated("bytes=", "1", "-"));
  field("suffix ranges", repeated("bytes=", "-1,"));
}

TEST(HttpGrowth, Headers) {
  // The wire allows 16 KiB of them; as a map they do not mind more.
  expect_linear(
      "names", {.from = 1000, .most = 200'000},
      [](std::size_t n) {
        std::vector<std::string> names;
        for (std::size_t i = 0; i < n; ++i) names.push_back("X-" + std::to_string(i));
        return names;
      },
      [](const std::vector<std::string>& names) {
        Request request;
        for (const auto& name : names) request.headers[name] = "1";
        for (const auto& name : names) EXPECT_TRUE(request.header(name));
      });
}

TEST(HttpGrowth, ProblemDocuments) {
  expect_linear("problem", {.from = 1000, .most = 9000},
                repeated(R"({"type":"/problems/conflict","errors":[)", "{},", "{}]}"),
                [](const std::string& text) { (void)problem_from_json(text); });
}

}  // namespace
}  // namespace semblante::http
