#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "server/api/access.h"
#include "server/api/export_slots.h"
#include "server/api/key_locks.h"
#include "server/api/known_voices.h"
#include "server/api/security.h"
#include "server/api/speakers.h"
#include "server/http/application.h"
#include "server/jobs/job_queue.h"
#include "server/metrics/request_counts.h"
#include "server/recordings/recorder.h"
#include "server/store/blob_store.h"
#include "server/store/pending_writes.h"
#include "server/store/store.h"
#include "server/store/trash.h"
#include "server/streams/stream_hub.h"
#include "server/voice/voice_process.h"

namespace semblante::api {

/// A speech is made while its request waits.
inline constexpr std::uint64_t longest_speech_seconds = 30;

struct ApiLimits {
  std::uint64_t max_upload_bytes = std::uint64_t{256} << 20U;
  std::uint64_t max_json_bytes = std::uint64_t{1} << 20U;
  std::size_t max_models = 1000;
  std::size_t max_streams = 256;
  std::size_t max_expressions = 1000;
  std::size_t max_speeches = 1000;
  std::size_t max_voices = 1;   ///< that speak at the same time
  std::size_t max_exports = 1;  ///< of recordings, made at the same time
};

struct ApiConfig {
  ApiLimits limits;
  std::string version;
  std::filesystem::path web_root;  ///< empty: no pages
  Access access;
  Security security = {};
  voice::VoiceProgram voice = {};         ///< empty command: the server has no voice
  voice::VoiceProgram sound_reader = {};  ///< empty command: it reads WAV alone
  voice::VoiceProgram recognizer = {};    ///< empty command: it hears no words
  /// The URLs by which other machines reach this server, as far as it knows them. Any thread.
  std::function<std::vector<std::string>()> network_urls = [] { return std::vector<std::string>(); };
};

/// Writes the counts of the network layer into /metrics.
using NetMetrics = std::function<void(metrics::TextWriter&)>;

/// The objects that handlers use. All of them may be used from any worker thread.
struct Context {
  store::Store& store;
  store::BlobStore& blobs;
  store::PendingWrites& pending;
  jobs::JobQueue& jobs;
  streams::StreamHub& hub;
  ApiConfig config;
  NetMetrics net_metrics;
  std::shared_ptr<recordings::Recorder> recorder = nullptr;
  std::shared_ptr<const store::Trash> trash = nullptr;
  std::shared_ptr<metrics::RequestCounts> requests = nullptr;  ///< made by Api
  std::shared_ptr<KeyLocks> idempotency_keys = nullptr;        ///< made by Api
  std::shared_ptr<std::atomic<bool>> stopping = nullptr;       ///< made by Api
  std::shared_ptr<KeyLocks> quota_turns = nullptr;             ///< by token; made by Api
  std::shared_ptr<KeyLocks> stream_changes = nullptr;          ///< by stream; made by Api
  std::shared_ptr<ExportSlots> exports = nullptr;              ///< made by Api, unless it is given
  std::shared_ptr<ExportSlots> voices = nullptr;               ///< made by Api
  std::shared_ptr<KnownVoices> known_voices = nullptr;         ///< made by Api
  std::shared_ptr<Speakers> speakers = nullptr;                ///< made by Api
};

/// REST and stream operations: finds the route, checks what can be checked before the body, and calls the handler. The
/// handlers are plain functions on plain values; no sockets here.
class Api : public http::Application {
 public:
  explicit Api(Context context);

  /// From now on /readyz answers 503, and requests that would change something, and connections to streams, are
  /// refused: the server stops. Any thread.
  void begin_stopping() { *context_.stopping = true; }
  /// Requests without TLS are answered with this port of https. Before the server runs.
  void redirect_to_https(std::uint16_t port) { context_.config.security.https_port = port; }

  void find_route(http::Request& head) override;
  std::variant<http::BodyPlan, http::Response> plan(const http::Request& head) override;
  http::Response handle(http::Request& request) override;
  std::variant<std::shared_ptr<http::WebSocketPeer>, http::Response> open_websocket(const http::Request& head) override;
  http::Problem unwritten_body(int error_number) override;
  void decorate(const http::Request& head, http::Response& response) override;

 private:
  http::Problem refuse(const std::string& request, const store::StoreError& fault);

  Context context_;
};

}  // namespace semblante::api
