// What a worker process says is read in time in proportion to its bytes: it has looked into a hostile file.

#include "tests/support/growth.h"

#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "server/jobs/worker_protocol.h"

namespace semblante::jobs {
namespace {

std::string list(std::size_t n, const std::string& one) {
  std::string text;
  for (std::size_t i = 0; i < n; ++i) text.append(i == 0 ? "" : ",").append(one);
  return text;
}

void expect_linear_line(const std::string& what, std::size_t most,
                        const std::function<std::string(std::size_t)>& make) {
  test::expect_linear("worker: " + what, {.from = most / 512 + 1, .most = most}, make, [](const std::string& text) {
    (void)worker_line_from_json(text);
    (void)worker_request_from_json(text);
  });
}

TEST(JobsGrowth, WorkerLines) {
  const std::string start =
      R"({"done":{"format":"obj","vertices":1,"triangles":1,"min":[0,0,0],"max":[1,1,1],"morph_targets":[],"levels":[],)";
  expect_linear_line("warnings", 400'000, [&](std::size_t n) {
    return start + R"("parts":[],"artefacts":[],"warnings":[)" + list(n, "\"careful\"") + "]}}";
  });
  expect_linear_line("empty objects", 400'000, [](std::size_t n) { return R"({"done":[)" + list(n, "{}") + "]}"; });
  expect_linear_line("what was taken of an extraction", 100'000, [&](std::size_t n) {
    std::string taken = "{";
    for (std::size_t i = 0; i < n; ++i)
      taken.append(i == 0 ? "\\\"" : ",\\\"").append(std::to_string(i)).append("\\\":1");
    return start + R"("parts":[],"artefacts":[],"warnings":[],"taken":")" + taken + "}\"}}";
  });
}

TEST(JobsGrowth, TakenThatIsNoObject_IsRefused) {
  const std::string start =
      R"({"done":{"format":"obj","vertices":1,"triangles":1,"min":[0,0,0],"max":[1,1,1],"morph_targets":[],"levels":[],)"
      R"("parts":[],"artefacts":[],"warnings":[],"taken":)";
  EXPECT_TRUE(worker_line_from_json(start + R"("{\"points\":{}}"}})"));
  for (const std::string taken : {R"("[]")", R"("{")", R"("{\"a\":1,\"a\":1}")"})
    EXPECT_FALSE(worker_line_from_json(start + taken + "}}")) << taken;
}

}  // namespace
}  // namespace semblante::jobs
