#include "server/app/serve_config.h"

#include <algorithm>
#include <chrono>

#include "server/jobs/worker_process.h"

namespace semblante {

jobs::JobConfig job_config(const ServeOptions& options, const jobs::Isolation& isolation) {
  jobs::JobConfig config;
  config.worker_command = {jobs::running_program, "worker"};
  config.isolation = isolation;
  config.limits.memory_bytes = options.worker_memory;
  config.limits.cpu_seconds = options.worker_cpu_seconds;
  config.concurrency = options.workers;
  return config;
}

recordings::RecorderLimits recorder_limits(const ServeOptions& options) {
  recordings::RecorderLimits limits;
  limits.max_recordings = options.max_recordings;
  limits.max_bytes = options.max_recording_bytes;
  limits.max_total_bytes = options.max_recordings_bytes;
  limits.disk_reserve = options.disk_reserve;
  return limits;
}

api::ApiConfig api_config(const ServeOptions& options, const Listening& listening, const store::BlobStore& blobs) {
  api::ApiConfig config;
  config.limits.max_upload_bytes = options.max_upload_bytes;
  config.limits.max_models = options.max_models;
  config.limits.max_streams = options.max_streams;
  config.limits.max_expressions = options.max_expressions;
  config.limits.max_speeches = options.max_speeches;
  // Half of the threads at most: the others handle what else is asked.
  config.limits.max_exports = config.limits.max_voices = std::max(1U, options.threads / 2);
  const auto program = options.voice_program.empty() ? voice::installed_voice() : options.voice_program;
  if (!program.empty() && program != "none") config.voice.command = {program};
  config.voice.wall_seconds = api::longest_speech_seconds;
  config.voice.temporary = blobs.temporary();
  config.sound_reader = config.voice;
  config.sound_reader.command = {voice::installed_sound_reader()};
  config.recognizer = voice::recognizer_at(options.recognizer_program);
  config.recognizer.wall_seconds = config.voice.wall_seconds;
  config.recognizer.temporary = config.voice.temporary;
  config.version = SEMBLANTE_VERSION;
  config.web_root = options.web_root;
  auto hosts = options.allowed_hosts;
  for (const auto& listener : listening.listeners) hosts.push_back(listener.address);
  config.access = {hosts, options.allowed_origins, options.frame_origins};
  config.security.asks_for_tokens = listening.asks_for_tokens;
  config.security.proxies = listening.proxies;
  config.security.token_limits = options.token_limits;
  config.security.rates = std::make_shared<access::ClientRates>(options.client_limits);
  return config;
}

net::ServerConfig net_config(const ServeOptions& options, const Listening& listening, const store::BlobStore& blobs,
                             const OpenFiles& open_files) {
  net::ServerConfig config;
  config.listeners = listening.listeners;
  config.proxies = listening.proxies;
  config.worker_threads = options.threads;
  config.upload_directory = blobs.temporary();
  config.limits.max_connections = open_files.connections;
  config.limits.max_files = open_files.bodies;
  config.limits.max_connections_per_address = static_cast<std::uint32_t>(options.max_connections_per_address);
  config.limits.max_handshakes_per_address = static_cast<std::uint32_t>(options.max_handshakes_per_address);
  config.limits.drain_time = std::chrono::seconds(options.drain_seconds);
  return config;
}

}  // namespace semblante
