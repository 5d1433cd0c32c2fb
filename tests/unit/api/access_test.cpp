#include "server/api/access.h"

#include <gtest/gtest.h>

namespace semblante::api {
namespace {

http::Request with(const std::string& field, const std::string& value) {
  http::Request head;
  head.headers[field] = value;
  return head;
}

TEST(Access, ThisMachinesNames_AreItsHosts) {
  const Access access;
  EXPECT_FALSE(access.refuse_reading(http::Request{})) << "HTTP/1.0 has no Host";
  for (const auto* host : {"localhost", "LocalHost:8080", "localhost.", "localhost.:8080", "127.0.0.1:80", "127.8.8.8",
                           "[::1]", "[::1]:8080"})
    EXPECT_FALSE(access.refuse_reading(with("Host", host))) << host;
  for (const auto* host : {"", ".", "localhost..", "evil.example", "localhost.evil.example:8080",
                           "127.0.0.1.evil.example", "192.168.0.7", "[::2]", "[::1", "::1", "localhost, evil.example",
                           "evil@localhost", "localhost:80@evil.example", "localhost:80x", "[::1]x", "local host"}) {
    const auto problem = access.refuse_reading(with("Host", host));
    ASSERT_TRUE(problem) << host;
    EXPECT_EQ(problem->slug, "foreign-host");
  }
}

TEST(Access, NamedHosts_AreTakenWithAnyPort) {
  const Access access{{"studio.example"}, {}};
  EXPECT_FALSE(access.refuse_reading(with("Host", "Studio.example:8443")));
  EXPECT_FALSE(access.refuse_reading(with("Host", "studio.example.")));
  EXPECT_TRUE(access.refuse_reading(with("Host", "other.example")));
  const Access open{{"*"}, {}};
  EXPECT_FALSE(open.refuse_reading(with("Host", "other.example")));
  EXPECT_TRUE(open.refuse_reading(with("Host", "localhost:80@evil.example"))) << "no host name";
}

TEST(Access, ForeignOrigins_MayNotChangeAnything) {
  const Access access{{}, {"https://studio.example"}};
  EXPECT_FALSE(access.refuse_changing(with("Origin", "https://studio.example")));
  for (const auto* host : {"localhost:8080", "127.0.0.1:8080", "[::1]:8080"}) {
    auto own = with("Origin", "http://" + std::string(host));
    own.headers["Host"] = host;
    EXPECT_FALSE(access.refuse_changing(own)) << host;
    own.headers["Origin"] = "http://localhost:5173";
    EXPECT_TRUE(access.refuse_changing(own)) << "another program of this machine";
  }
  for (const auto* origin : {"https://evil.example", "http://localhost:5173", "http://studio.example",
                             "http://localhost.evil.example", "http://localhost:80@evil.example", "null"}) {
    EXPECT_FALSE(access.origin_allowed(with("Origin", origin))) << origin;
    EXPECT_TRUE(access.refuse_changing(with("Origin", origin))) << origin;
    EXPECT_FALSE(access.refuse_reading(with("Origin", origin))) << "its page sees no answer without CORS";
  }
}

TEST(Access, ForeignHost_MayNotChangeAnythingEither) {
  auto head = with("Origin", "http://localhost:8080");
  head.headers["Host"] = "evil.example";
  const auto problem = Access{}.refuse_changing(head);
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->slug, "foreign-host");
}

}  // namespace
}  // namespace semblante::api
