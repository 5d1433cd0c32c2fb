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
  const std::string import =
      R"({"done":{"kind":"import","artefacts":[],"outcome":{"format":"obj","vertices":1,"triangles":1,"min":[0,0,0],)"
      R"("max":[1,1,1],"morph_targets":[],"findings":{"errors":0,"warnings":0,"notes":0},"parts":[],"part_count":0,)";
  expect_linear_line("warnings", 400'000,
                     [&](std::size_t n) { return import + R"("warnings":[)" + list(n, "\"careful\"") + "]}}}"; });
  expect_linear_line("empty objects", 400'000, [](std::size_t n) { return R"({"done":[)" + list(n, "{}") + "]}"; });
  const std::string extract = R"({"done":{"kind":"extract","artefacts":[],"outcome":{"displacements":{},)";
  expect_linear_line("points at rest", 400'000, [&](std::size_t n) {
    return extract + R"("skipped":{},"at_no_vertex":[],"not_marked":[],"head_motion":null,"at_rest":[)" +
           list(n, "\"2.1\"") + "]}}}";
  });
  expect_linear_line("skipped points", 100'000, [&](std::size_t n) {
    std::string skipped;
    for (std::size_t i = 0; i < n; ++i)
      skipped.append(i == 0 ? "\"" : ",\"").append(std::to_string(i)).append("\":\"ES\"");
    return extract + R"("at_rest":[],"at_no_vertex":[],"not_marked":[],"head_motion":null,"skipped":{)" + skipped +
           "}}}}";
  });
}

}  // namespace
}  // namespace semblante::jobs
