#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "tests/integration/server/grid_model.h"
#include "tests/integration/server/test_client.h"

namespace semblante::test {

inline nlohmann::json json_of(const Reply& reply) { return nlohmann::json::parse(reply.body, nullptr, false); }

/// Follows a job to its end; the last state.
inline nlohmann::json wait_for_job(int port, const std::string& id) {
  nlohmann::json job;
  const bool ended = testing::eventually(
      [&] {
        job = json_of(request(port, "GET", "/v1/jobs/" + id));
        return job.value("state", "") != "queued" && job.value("state", "") != "running";
      },
      std::chrono::milliseconds(50));
  return ended ? job : nlohmann::json{{"state", "the test waited in vain"}};
}

/// Uploads a grid and waits for its import; the id.
inline std::string import_grid(int port, int side = 9) {
  const auto made = json_of(
      request(port, "POST", "/v1/models?name=Grid&filename=grid.obj", grid_obj(side), {{"Content-Type", "model/obj"}}));
  if (!made.contains("job")) return made.dump();
  wait_for_job(port, made["job"]["id"]);
  return made["model"]["id"];
}

/// Five points on a 9 by 9 grid: chin, lips' middle, corners.
inline std::string grid_points() {
  return R"({"points":{"2.1":{"vertex":4},"2.2":{"vertex":40},"2.3":{"vertex":31},"2.4":{"vertex":38},"2.5":{"vertex":42}}})";
}

inline nlohmann::json parametrize_grid(int port, const std::string& model) {
  request(port, "PUT", "/v1/models/" + model + "/feature-points", grid_points(),
          {{"Content-Type", "application/json"}});
  const auto job = json_of(request(port, "POST", "/v1/models/" + model + "/parametrizations"));
  return job.contains("id") ? wait_for_job(port, job["id"]) : job;
}

}  // namespace semblante::test
