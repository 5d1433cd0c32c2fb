#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace semblante {

/// What `semblante serve` is told.
struct ServeOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 8080;
  std::filesystem::path data = "data";
  std::filesystem::path web_root;
  std::filesystem::path sample;
  bool demo = false;
  unsigned threads = 2;
  unsigned workers = 1;
  std::uint64_t max_upload_bytes = std::uint64_t{256} << 20U;
  std::uint64_t max_models = 1000;
  std::uint64_t max_streams = 256;
  std::uint64_t max_expressions = 1000;
  std::uint64_t max_recordings = 1000;
  std::uint64_t max_recording_bytes = std::uint64_t{256} << 20U;
  std::uint64_t max_recordings_bytes = std::uint64_t{16} << 30U;
  std::uint64_t disk_reserve = std::uint64_t{256} << 20U;
  std::uint64_t trash_grace = std::uint64_t{7} * 24 * 60 * 60;  ///< seconds
  std::uint64_t max_connections = 0;                            ///< 0: what the process may open, but for a reserve
  std::uint64_t max_stream_connections = 16384;
  std::uint64_t worker_memory = std::uint64_t{4} << 30U;
  std::uint64_t worker_cpu_seconds = 300;
  std::vector<std::string> allowed_hosts;
  std::vector<std::string> allowed_origins;
  std::string log_level = "info";
};

/// Serves until SIGINT or SIGTERM. Prints one line to standard output when it is ready. Throws CommandFailure.
void run_serve(const ServeOptions& options);

}  // namespace semblante
