#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "tests/bench/fanout/options.h"
#include "tests/bench/fanout/server_process.h"
#include "tests/bench/fanout/timeline.h"

namespace semblante::bench {

/// Where our own programs lie: the folder of this one.
std::filesystem::path program_folder();

/// `semblante serve` in a process and a data folder of its own, or one that runs already.
class SemblanteServer {
 public:
  explicit SemblanteServer(const Options& options);
  ~SemblanteServer();
  SemblanteServer(const SemblanteServer&) = delete;
  SemblanteServer& operator=(const SemblanteServer&) = delete;

  [[nodiscard]] const Endpoint& endpoint() const { return endpoint_; }
  /// 0 when it is not ours and nobody said.
  [[nodiscard]] pid_t pid() const { return pid_; }
  /// Whether it still answers.
  [[nodiscard]] bool healthy() const;
  /// The path of a new stream, which is removed with the object.
  std::string make_stream(int batch_ms);
  /// A number of GET /v1/streams/{id}.
  [[nodiscard]] std::uint64_t stream_number(const std::string& path, const std::string& member) const;

 private:
  std::filesystem::path data_;
  std::optional<ServerProcess> process_;
  Endpoint endpoint_;
  pid_t pid_ = 0;
  std::vector<std::string> streams_;
};

/// A stream that is fed, with the timeline of what its subscribers must get.
struct FedStream {
  FedStream(SemblanteServer& server, const Options& options, double seconds);
  std::string path;
  SendTimes sent;
  Timeline timeline;
  Publisher publisher;
};

/// A baseline: epoll, epoll-tls, beast or ws. Nothing, after a word why, when it cannot run here.
std::optional<ServerProcess> start_rival(const std::string& name, double messages_per_second, std::size_t bytes);

}  // namespace semblante::bench
