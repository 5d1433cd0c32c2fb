// One id for each request: in its answer, in problem documents, in the lines of the log, also in those of its job.

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/integration/server/model_flow.h"

namespace semblante::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

/// Every line of the log as an object; a line that is none fails the test.
std::vector<json> lines_of(const ServerProcess& server) {
  std::vector<json> lines;
  std::istringstream text(server.errors());
  for (std::string line; std::getline(text, line);) {
    lines.push_back(json::parse(line, nullptr, false));
    EXPECT_TRUE(lines.back().is_object()) << line;
  }
  return lines;
}

/// The messages of the lines with this value of a member.
std::string messages_with(const ServerProcess& server, const std::string& member, const std::string& value) {
  std::string all;
  for (const auto& line : lines_of(server))
    if (line.value(member, "") == value) all += line.value("message", "") + "\n";
  return all;
}

TEST(RequestId, IsInAnswerAndLog_AndDiffers) {
  const TemporaryFolder data;
  const ServerProcess server(data.path(), {"--log-format", "json", "--log-level", "debug"});
  const auto first = request(server.port(), "GET", "/healthz");
  const auto second = request(server.port(), "GET", "/v1/models/nothing");
  const auto id = second.headers.at("x-request-id");
  EXPECT_NE(first.headers.at("x-request-id"), id);
  EXPECT_EQ(json_of(second)["request"], id);
  EXPECT_EQ(messages_with(server, "request", id), "GET /v1/models/nothing 404\n");
  // Also what no route is found for, what cannot be read, and what becomes a WebSocket: test_client looks at each.
  EXPECT_EQ(raw_exchange(server.port(), "NONSENSE\r\n\r\n").substr(9, 3), "400");
  request(server.port(), "POST", "/v1/streams", R"({"name":"talk"})", {{"Content-Type", "application/json"}});
  EXPECT_EQ(WebSocket(server.port(), "/v1/streams/talk", "semblante.v1.json").handshake().status, 101);
  EXPECT_EQ(WebSocket(server.port(), "/v1/streams/nothing", "semblante.v1.json").handshake().status, 404);
}

TEST(RequestId, OfARequestThatMadeAJob_IsInTheLinesOfTheJob_AlsoAfterARestart) {
  const TemporaryFolder data;
  const std::vector<std::string> options = {"--log-format", "json"};
  ServerProcess server(data.path(), options);
  const auto made = request(server.port(), "POST", "/v1/models?filename=bad.obj", "v 1 2\nf 1 2 3\n",
                            {{"Content-Type", "model/obj"}});
  const std::string job = json_of(made)["job"]["id"];
  EXPECT_EQ(wait_for_job(server.port(), job)["state"], "failed");
  const auto id = made.headers.at("x-request-id");
  EXPECT_TRUE(semblante::testing::eventually(
      [&] { return messages_with(server, "job", job).find("failed") != std::string::npos; }));
  EXPECT_THAT(messages_with(server, "request", id), HasSubstr("job " + job));

  // A job that a killed server has left is of the same request.
  const auto slow = request(server.port(), "POST", "/v1/models?filename=slow.obj", grid_obj(400) + "f 1 2 999999\n",
                            {{"Content-Type", "model/obj"}});
  server.end(SIGKILL);
  const ServerProcess again(data.path(), options);
  const std::string left = json_of(slow)["job"]["id"];
  wait_for_job(again.port(), left);
  EXPECT_TRUE(semblante::testing::eventually([&] {
    return messages_with(again, "request", slow.headers.at("x-request-id")).find(left) != std::string::npos;
  })) << again.errors();
}

TEST(RequestId, IsTakenFromATrustedProxyOnly_AndOnlyIfItCanStandInALog) {
  const TemporaryFolder data;
  const auto id_of = [](const ServerProcess& server, const std::string& given) {
    return request(server.port(), "GET", "/healthz", {}, {{"X-Request-Id", given}}).headers.at("x-request-id");
  };
  {
    const ServerProcess server(data.path());
    EXPECT_NE(id_of(server, "from-a-stranger"), "from-a-stranger");
  }
  const ServerProcess server(data.path(), {"--trusted-proxy", "127.0.0.1"});
  EXPECT_EQ(id_of(server, "4bf92f35-77b3.4da6_A"), "4bf92f35-77b3.4da6_A");
  EXPECT_EQ(id_of(server, std::string(64, 'a')), std::string(64, 'a'));
  for (const auto& bad : {std::string(65, 'a'), std::string("a b"), std::string("a\"b"), std::string("a,b")})
    EXPECT_THAT(id_of(server, bad), Not(HasSubstr(bad)));
}

}  // namespace
}  // namespace semblante::test
