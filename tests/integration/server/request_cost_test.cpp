// What a request of a megabyte may cost the real server: processor time, which does not depend on how busy the machine
// is. Arrays of many empty objects once cost the square of their number, 25 s for one request.

#include <fstream>
#include <iterator>
#include <sstream>
#include <unistd.h>

#include <gtest/gtest.h>

#include "tests/integration/server/model_flow.h"

namespace semblante::test {
namespace {

using nlohmann::json;

/// Ten times what the slowest takes, a tenth of what the square would.
constexpr double most_seconds = 2.0;

/// Processor time of a process, and of its children that have ended, in seconds.
double processor_seconds(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  std::istringstream fields(text.substr(text.rfind(')') + 2));  // the name may hold anything
  std::string skipped;
  for (int i = 0; i < 11; ++i) fields >> skipped;
  double sum = 0.0;
  for (int i = 0; i < 4; ++i) {  // user, system, and both of the children
    double ticks = 0.0;
    fields >> ticks;
    sum += ticks;
  }
  EXPECT_TRUE(fields) << text;
  return sum / static_cast<double>(sysconf(_SC_CLK_TCK));
}

/// {"a":[{},{},...]}, or the like.
std::string many(std::size_t count, const std::string& before = R"({"a":[)", const std::string& one = "{}",
                 const std::string& after = "]}") {
  std::string text = before;
  for (std::size_t i = 0; i < count; ++i) text.append(i == 0 ? "" : ",").append(one);
  return text + after;
}

class RequestCost : public ::testing::Test {
 protected:
  RequestCost() : server_(folder_.path() / "data") {}

  [[nodiscard]] int port() const { return server_.port(); }

  template <class Act>
  void expect_cheap(const std::string& what, Act act) {
    const double before = processor_seconds(server_.pid());
    act();
    EXPECT_LT(processor_seconds(server_.pid()) - before, most_seconds) << what;
  }

  TemporaryFolder folder_;
  ServerProcess server_;
};

TEST_F(RequestCost, ManyObjects_ToEveryRouteThatTakesJson) {
  const auto document = json_of(request(port(), "GET", "/openapi.json"));
  const auto model = import_grid(port());
  request(port(), "POST", "/v1/streams", R"({"name":"hello"})", json_type);
  std::size_t sent = 0;
  for (const auto& [path, item] : document["paths"].items()) {
    for (const std::string method : {"put", "patch", "post"}) {
      if (!item.contains(method) || !item[method].contains("requestBody")) continue;
      if (!item[method]["requestBody"]["content"].contains("application/json")) continue;
      auto target = path;
      if (const auto at = target.find("{model}"); at != std::string::npos) target.replace(at, 7, model);
      if (const auto at = target.find("{stream}"); at != std::string::npos) target.replace(at, 8, "hello");
      auto upper = method;
      for (auto& c : upper) c = static_cast<char>(std::toupper(c));
      for (const auto& body :
           {many(240'000), many(170'000, R"({"frames":[)"), many(80'000, R"({"cues":[)", R"({"":[]})"),
            many(240'000, R"({"points":[)", "[]"), many(340'000, R"({"a":[)", "0")}) {
        expect_cheap(upper + " " + target, [&] {
          const auto reply = request(port(), upper, target, body, json_type);
          EXPECT_GE(reply.status, 400) << target << " " << body.substr(0, 20);
          EXPECT_LT(reply.status, 500) << target << " " << reply.body;
        });
        ++sent;
      }
    }
  }
  EXPECT_GE(sent, 50U);
}

TEST_F(RequestCost, ManyObjects_InAMessageOfAStream) {
  request(port(), "POST", "/v1/streams", R"({"name":"talk"})", json_type);
  WebSocket socket(port(), "/v1/streams/talk", "semblante.v1.json");
  expect_cheap("a message", [&] {
    socket.send_text(many(240'000, R"({"type":"hello","version":1,"role":"subscribe","a":[)"));
    const auto answer = socket.receive(std::chrono::seconds(60));
    EXPECT_TRUE(answer || socket.close_code() != 0);
  });
}

TEST_F(RequestCost, ManyObjects_InAModel) {
  expect_cheap("an import", [&] {
    const auto made = json_of(request(port(), "POST", "/v1/models?filename=a.gltf",
                                      many(200'000, R"({"asset":{"version":"2.0"},"extras":[)"),
                                      {{"Content-Type", "model/gltf+json"}}));
    ASSERT_TRUE(made.contains("job")) << made;
    EXPECT_EQ(wait_for_job(port(), made["job"]["id"]).value("state", ""), "failed");
  });
}

}  // namespace
}  // namespace semblante::test
