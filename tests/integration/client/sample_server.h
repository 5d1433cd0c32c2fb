#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include <nlohmann/json.hpp>

#include "protocol/http/http_client.h"
#include "tests/integration/client/child_process.h"

namespace semblante::testing {

/// The real server on a free port, with the sample head parametrized as model `sample` and the demo stream playing, in
/// a folder of its own.
class SampleServer {
 public:
  /// Fails the test when the server does not come up.
  SampleServer();
  ~SampleServer();
  SampleServer(const SampleServer&) = delete;
  SampleServer& operator=(const SampleServer&) = delete;

  [[nodiscard]] const client::HttpClient& http() const { return *http_; }
  [[nodiscard]] std::string url() const;
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] std::filesystem::path model_file() const { return folder_ / "sample-head.glb"; }
  [[nodiscard]] std::filesystem::path points_file() const { return folder_ / "sample-head.fps.json"; }
  /// Makes a stream that suggests the sample head.
  void create_stream(const std::string& name, std::optional<double> viseme_share = {}) const;
  /// Posts {"frames": `frames`}.
  void post_frames(const std::string& stream, const std::string& frames) const;
  /// What the server says of a stream; null when it does not answer.
  [[nodiscard]] nlohmann::json stream(const std::string& name) const;
  /// Waits until a stream has that many subscribers.
  void wait_for_subscribers(const std::string& stream, int count) const;

 private:
  std::filesystem::path folder_;
  std::unique_ptr<ChildProcess> process_;
  std::unique_ptr<client::HttpClient> http_;
};

}  // namespace semblante::testing
