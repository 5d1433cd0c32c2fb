#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "server/api/api.h"
#include "server/jobs/worker_protocol.h"
#include "server/recordings/recorder.h"
#include "server/streams/stream_limits.h"

namespace semblante {

/// The options of `semblante serve`; the defaults of limits are those of the folder that applies them.
struct ServeOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 8080;
  std::filesystem::path data = "data";
  std::filesystem::path web_root;
  std::filesystem::path sample;
  bool demo = false;
  unsigned threads = 2;
  unsigned workers = 1;
  std::uint64_t max_upload_bytes = api::ApiLimits{}.max_upload_bytes;
  std::uint64_t max_models = api::ApiLimits{}.max_models;
  std::uint64_t max_streams = api::ApiLimits{}.max_streams;
  std::uint64_t max_expressions = api::ApiLimits{}.max_expressions;
  std::uint64_t max_recordings = recordings::RecorderLimits{}.max_recordings;
  std::uint64_t max_recording_bytes = recordings::RecorderLimits{}.max_bytes;
  std::uint64_t max_recordings_bytes = recordings::RecorderLimits{}.max_total_bytes;
  std::uint64_t disk_reserve = recordings::RecorderLimits{}.disk_reserve;
  std::uint64_t trash_grace = std::uint64_t{7} * 24 * 60 * 60;  ///< seconds
  std::uint64_t max_connections = 0;  ///< 0: the files that the process may open, less a reserve
  std::uint64_t max_stream_connections = streams::StreamLimits{}.max_connections;
  std::uint64_t worker_memory = jobs::WorkerLimits{}.memory_bytes;
  std::uint64_t worker_cpu_seconds = jobs::WorkerLimits{}.cpu_seconds;
  std::vector<std::string> allowed_hosts;
  std::vector<std::string> allowed_origins;
  std::string log_level = "info";
};

/// Serves until SIGINT or SIGTERM. Prints one line to standard output when it is ready. Throws CommandFailure.
void run_serve(const ServeOptions& options);

}  // namespace semblante
