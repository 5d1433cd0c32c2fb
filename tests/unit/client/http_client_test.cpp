#include "protocol/http/http_client.h"

#include <gtest/gtest.h>

#include "tests/support/wait.h"
#include "tests/unit/client/canned_server.h"

namespace semblante::testing {
namespace {

using client::HttpClient;
using client::HttpLimits;
using client::parse_url;

constexpr HttpLimits small_limits = {.max_body = 1000, .max_header = 2000, .timeout = patience};

Result<client::HttpResponse> get_from(const CannedServer& server, const HttpLimits& limits = small_limits) {
  return HttpClient(*parse_url(server.url()), limits).get("/x");
}

TEST(HttpClient, HostileServer_IsAnErrorWithinItsLimits) {
  {  // Nobody there.
    const auto response = HttpClient(*parse_url("http://127.0.0.1:1"), small_limits).get("/x");
    ASSERT_FALSE(response);
    EXPECT_EQ(response.error().code, ErrorCode::io);
  }
  {  // Not HTTP.
    const CannedServer server("SSH-2.0-nothing to see\r\n\r\n");
    const auto response = get_from(server);
    ASSERT_FALSE(response);
    EXPECT_EQ(response.error().code, ErrorCode::malformed);
  }
  {  // Closed without a word.
    const CannedServer server("HTTP/1.1 200 OK\r\nContent-Le");
    const auto response = get_from(server);
    ASSERT_FALSE(response);
    EXPECT_EQ(response.error().code, ErrorCode::io);
  }
  for (const auto& chunks :
       {"0\r\nX: " + std::string(66'000, 'a'), "1;" + std::string(1U << 20U, 'e') + "\r\nx\r\n0"}) {
    // What surrounds chunks is as bounded as the header.
    const CannedServer server("HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n\r\n" + chunks + "\r\n\r\n");
    const auto response = get_from(server);
    ASSERT_FALSE(response);
    EXPECT_EQ(response.error().code, ErrorCode::too_large) << response.error().message;
  }
  {  // A body shorter than announced.
    const CannedServer server("HTTP/1.1 200 OK\r\nContent-Length: 500\r\n\r\nshort");
    EXPECT_FALSE(get_from(server));
  }
  {  // A body that is announced too large is refused before it comes.
    const CannedServer server("HTTP/1.1 200 OK\r\nContent-Length: 4000000000\r\n\r\n");
    const auto response = get_from(server);
    ASSERT_FALSE(response);
    EXPECT_EQ(response.error().code, ErrorCode::too_large);
  }
  {  // A body without a length that does not end.
    const CannedServer server("HTTP/1.1 200 OK\r\n\r\n" + std::string(100000, 'x'));
    const auto response = get_from(server);
    ASSERT_FALSE(response);
    EXPECT_EQ(response.error().code, ErrorCode::too_large);
  }
  {  // A head that does not end.
    const CannedServer server("HTTP/1.1 200 OK\r\n" + std::string(100000, 'x'));
    EXPECT_FALSE(get_from(server));
  }
  {  // Silence.
    const CannedServer server("");
    HttpLimits limits = small_limits;
    limits.timeout = std::chrono::milliseconds(150);
    const auto response = get_from(server, limits);  // without a limit of its own it would wait for ever
    ASSERT_FALSE(response);
    EXPECT_EQ(response.error().code, ErrorCode::io);
  }
}

TEST(HttpClient, TrailersAndChunkExtensions_WithinTheLimits_AreRead) {
  const CannedServer server("HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n\r\n2;e=f\r\nhi\r\n0\r\nX: y\r\n\r\n");
  const auto response = get_from(server);
  ASSERT_TRUE(response) << response.error().message;
  EXPECT_EQ(response->body, "hi");
}

TEST(HttpClient, Get_SendsHostAndPathAndReadsTheAnswer) {
  const CannedServer server("HTTP/1.1 200 OK\r\nETag: \"sha256-1\"\r\nContent-Length: 5\r\n\r\nhello");
  const auto response = HttpClient(*parse_url(server.url() + "/base/"), small_limits).get("/x?y=1");
  ASSERT_TRUE(response) << response.error().message;
  EXPECT_EQ(response->status, 200);
  EXPECT_EQ(response->body, "hello");
  EXPECT_EQ(response->header("etag"), "\"sha256-1\"");
  EXPECT_EQ(response->header("server"), "");
  EXPECT_TRUE(server.request().starts_with("GET /base/x?y=1 HTTP/1.1\r\n")) << server.request();
  EXPECT_NE(server.request().find("Host: 127.0.0.1:"), std::string::npos);
}

TEST(HttpClient, Token_IsSentAsBearer_AndFitsAHeader) {
  const CannedServer server("HTTP/1.1 204 No Content\r\n\r\n");
  client::ServerOptions options{.address = server.url(), .token = "smb_id_secret"};
  const auto address = options.parse();
  ASSERT_TRUE(address);
  const auto response = HttpClient(*address, small_limits).get("/x");
  ASSERT_TRUE(response) << response.error().message;
  EXPECT_EQ(response->reason, "No Content");
  EXPECT_NE(server.request().find("Authorization: Bearer smb_id_secret\r\n"), std::string::npos);
  for (const char* bad : {"a b", "a\r\nX: y", "\xc3\xa9"}) {
    options.token = bad;
    EXPECT_FALSE(options.parse()) << bad;
  }
}

TEST(HttpClient, FetchOfAProblem_SaysItInItsWords) {
  const CannedServer server(
      "HTTP/1.1 404 Not Found\r\nContent-Type: application/problem+json\r\nContent-Length: 61\r\n\r\n"
      R"({"type":"/problems/not-found","title":"No such model","x":[]})");
  const auto body = HttpClient(*parse_url(server.url()), small_limits).fetch("/v1/models/m");
  ASSERT_FALSE(body);
  EXPECT_EQ(body.error().code, ErrorCode::missing);
  EXPECT_NE(body.error().message.find("404: No such model"), std::string::npos) << body.error().message;
}

TEST(HttpClient, FetchWithItsOwnBound_RefusesMore) {
  const CannedServer server("HTTP/1.1 200 OK\r\nContent-Length: 5\r\n\r\nhello");
  const auto body = HttpClient(*parse_url(server.url()), small_limits).fetch("/x", 4);
  ASSERT_FALSE(body);
  EXPECT_EQ(body.error().code, ErrorCode::too_large);
}

TEST(Url, Malformed_IsRefused) {
  for (const char* text : {"", "http://", "http://host:", "http://host:0", "http://host:65536", "http://host:12x",
                           "http://[::1", "http://user@host", "ftp://host", "://host", "http://http://host",
                           "http://ho st", "http://host/\r\nX: y", "http://host?x", "http://h#x"}) {
    const auto url = parse_url(text);
    ASSERT_FALSE(url) << text;
    EXPECT_EQ(url.error().code, ErrorCode::invalid_argument) << text;
  }
}

TEST(Url, Parts_AreTakenApart) {
  const auto url = parse_url("http://[::1]:8080/a/b/");
  ASSERT_TRUE(url);
  EXPECT_EQ(url->host, "::1");
  EXPECT_EQ(url->port, "8080");
  EXPECT_EQ(url->path, "/a/b");
  EXPECT_EQ(parse_url("localhost")->port, "80");
  EXPECT_FALSE(url->secure);
  const auto secure = parse_url("https://faces.example/base");
  ASSERT_TRUE(secure);
  EXPECT_TRUE(secure->secure);
  EXPECT_EQ(secure->host, "faces.example");
  EXPECT_EQ(secure->port, "443");
  EXPECT_TRUE(parse_url("HTTPS://faces.example")->secure);
  EXPECT_EQ(parse_url("https://faces.example:8443")->port, "8443");
  EXPECT_EQ(url->authority(), "[::1]:8080");
  EXPECT_EQ(parse_url("http://host")->authority(), "host:80");
}

TEST(Url, Segment_IsEscaped) { EXPECT_EQ(client::escape_segment("a/b ?\xC3\xA9-1"), "a%2Fb%20%3F%C3%A9-1"); }

}  // namespace
}  // namespace semblante::testing
