#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "server/access/client_limits.h"
#include "server/access/token_limits.h"
#include "server/api/api.h"
#include "server/app/listening.h"
#include "server/jobs/worker_protocol.h"
#include "server/net/server.h"
#include "server/recordings/recorder.h"
#include "server/streams/stream_limits.h"

namespace semblante {

/// The options of `semblante serve`; the defaults of limits are those of the folder that applies them.
struct ServeOptions {
  ListenOptions listening;
  bool lan = false;  ///< every address of this machine, with a certificate and a token of its own
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
  std::uint64_t max_speeches = api::ApiLimits{}.max_speeches;
  std::string voice_program;       ///< empty: the installed voice, if there is one; "none"
  std::string recognizer_program;  ///< likewise
  std::uint64_t max_recordings = recordings::RecorderLimits{}.max_recordings;
  std::uint64_t max_recording_bytes = recordings::RecorderLimits{}.max_bytes;
  std::uint64_t max_recordings_bytes = recordings::RecorderLimits{}.max_total_bytes;
  std::uint64_t disk_reserve = recordings::RecorderLimits{}.disk_reserve;
  std::uint64_t trash_grace = std::uint64_t{7} * 24 * 60 * 60;  ///< seconds
  std::uint64_t max_connections = 0;  ///< 0: three quarters of the files that the process may open, less a reserve
  std::uint64_t max_stream_connections = streams::StreamLimits{}.max_connections;
  std::uint64_t drain_seconds = net::ServerLimits{}.drain_time.count();
  std::uint64_t worker_memory = jobs::WorkerLimits{}.memory_bytes;
  std::uint64_t worker_cpu_seconds = jobs::WorkerLimits{}.cpu_seconds;
  std::vector<std::string> allowed_hosts;
  std::vector<std::string> allowed_origins;
  std::vector<std::string> frame_origins;
  access::ClientLimits client_limits;
  access::TokenLimits token_limits;
  std::uint64_t max_connections_per_address = net::ServerLimits{}.max_connections_per_address;
  std::uint64_t max_handshakes_per_address = net::ServerLimits{}.max_handshakes_per_address;
  std::string log_level = "info";
  std::string log_format = "text";
};

/// Serves until SIGINT or SIGTERM, and finishes what has begun; a second signal ends the process at once. Prints one
/// line to standard output when it is ready. Throws CommandFailure.
void run_serve(const ServeOptions& options);

}  // namespace semblante
