// What a real server says at /metrics, read by a parser that shares no code with it, and held against the table that
// documents it.

#include <fstream>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/integration/server/test_client.h"
#include "tests/support/prometheus_text.h"

namespace semblante::test {
namespace {

using ::testing::IsEmpty;

struct Documented {
  std::string type, help;
  std::set<std::string> labels;
};

/// The rows of the table in server/metrics/README.md, by name.
std::map<std::string, Documented> documented() {
  std::ifstream file(std::string(SEMBLANTE_SOURCE_DIR) + "/server/metrics/README.md");
  const std::regex row("\\| `([a-z0-9_]+)` \\| ([a-z]+) \\| ([^|]*)\\| (.+) \\|");
  const std::regex label("`([a-z_]+)`");
  std::map<std::string, Documented> rows;
  for (std::string line; std::getline(file, line);) {
    std::smatch match;
    if (!std::regex_match(line, match, row)) continue;
    auto& entry = rows[match[1]];
    entry.type = match[2];
    entry.help = match[4];
    const std::string labels = match[3];
    for (std::sregex_iterator at(labels.begin(), labels.end(), label), end; at != end; ++at)
      entry.labels.insert((*at)[1]);
  }
  return rows;
}

class Metrics : public ::testing::Test {
 protected:
  PrometheusText scrape() const {
    const auto reply = request(server_.port(), "GET", "/metrics");
    EXPECT_EQ(reply.status, 200);
    EXPECT_EQ(reply.headers.at("content-type"), "text/plain; version=0.0.4; charset=utf-8");
    auto text = read_prometheus_text(reply.body);
    EXPECT_THAT(text.faults, IsEmpty());
    return text;
  }

  TemporaryFolder folder_;
  ServerProcess server_{folder_.path() / "data", {"--demo"}};
};

TEST_F(Metrics, EveryNameIsDocumentedAndEveryDocumentedNameIsThere) {
  request(server_.port(), "GET", "/v1/streams");
  const auto text = scrape();
  const auto rows = documented();
  ASSERT_GT(rows.size(), 20U);
  for (const auto& [name, row] : rows) {
    const auto found = text.families.find(name);
    if (found == text.families.end()) {
      ADD_FAILURE() << name << " is documented and not there";
      continue;
    }
    EXPECT_EQ(found->second.type, row.type) << name;
    EXPECT_EQ(found->second.help, row.help) << name;
    for (const auto& sample : found->second.samples) {
      std::set<std::string> labels;
      for (const auto& [label, value] : sample.labels)
        if (label != "le") labels.insert(label);
      EXPECT_EQ(labels, row.labels) << name;
    }
  }
  for (const auto& [name, family] : text.families) EXPECT_TRUE(rows.contains(name)) << name << " is not documented";
}

TEST_F(Metrics, Requests_AreCountedByRoute_WhateverPathsClientsChoose) {
  for (int i = 0; i < 3; ++i) request(server_.port(), "GET", "/v1/streams/demo");
  for (int i = 0; i < 5; ++i) request(server_.port(), "GET", "/v1/streams/nobody-" + std::to_string(i));
  for (int i = 0; i < 7; ++i) request(server_.port(), "GET", "/nowhere/%22%5C" + std::to_string(i));
  request(server_.port(), "BREW", "/v1/streams");
  const auto text = scrape();
  const std::string name = "semblante_http_requests_total";
  const auto count = [&](const std::string& method, const std::string& route, const std::string& status) {
    return text.value(name, {{"method", method}, {"route", route}, {"status", status}});
  };
  EXPECT_EQ(count("GET", "/v1/streams/{stream}", "2xx"), 3.0);
  EXPECT_EQ(count("GET", "/v1/streams/{stream}", "4xx"), 5.0);
  EXPECT_GE(count("other", "other", "4xx"), 8.0);
  EXPECT_LT(text.families.at(name).samples.size(), 8U) << "no series is made of a path";
  EXPECT_EQ(text.value("semblante_http_request_duration_seconds_count",
                       {{"method", "GET"}, {"route", "/v1/streams/{stream}"}}),
            8.0);
}

TEST_F(Metrics, Counters_RiseWithWhatHappens) {
  const auto before = scrape();
  const auto reply =
      request(server_.port(), "POST", "/v1/streams", R"({"name":"counted"})", {{"Content-Type", "application/json"}});
  ASSERT_EQ(reply.status, 201) << reply.body;
  request(server_.port(), "POST", "/v1/streams/counted/frames", R"({"frames":[{"faps":{"4":5000}},{}]})",
          {{"Content-Type", "application/json"}});
  const auto after = scrape();
  EXPECT_EQ(before.value("semblante_streams", {{"source", "request"}}), 0.0);
  EXPECT_EQ(after.value("semblante_stream_frames_total", {{"source", "request"}}), 2.0);
  EXPECT_EQ(after.value("semblante_stream_clamped_values_total"), 1.0);
  EXPECT_GE(after.value("semblante_connections_accepted_total"),
            before.value("semblante_connections_accepted_total") + 2.0);
  EXPECT_GE(after.value("process_cpu_seconds_total"), before.value("process_cpu_seconds_total"));
  // Requests are its source for some seconds after the last one.
  EXPECT_TRUE(testing::eventually([&] {
    request(server_.port(), "POST", "/v1/streams/counted/frames", R"({"frames":[{}]})",
            {{"Content-Type", "application/json"}});
    return scrape().value("semblante_streams", {{"source", "request"}}) == 1.0;
  }));
}

}  // namespace
}  // namespace semblante::test
