#include "server/app/serve.h"

#include <algorithm>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <iostream>
#include <optional>
#include <thread>
#include <unistd.h>

#include <sys/stat.h>

#include "server/access/new_token.h"
#include "server/api/api.h"
#include "server/app/certificate_files.h"
#include "server/app/data_folder.h"
#include "server/app/lan.h"
#include "server/app/open_files.h"
#include "server/app/sample_installer.h"
#include "server/app/service_manager.h"
#include "server/cli/command_failure.h"
#include "server/jobs/isolation.h"
#include "server/jobs/worker_process.h"
#include "server/log/log.h"
#include "server/log/periodic.h"
#include "server/net/ring_sender.h"
#include "server/net/server.h"
#include "server/store/sqlite_store.h"
#include "server/upkeep/data_lock.h"

namespace semblante {
namespace {

constexpr std::chrono::hours purge_interval{1};
constexpr std::chrono::seconds lock_patience{5};

[[noreturn]] void fail_input(const std::string& message) {
  throw CommandFailure(CommandFailure::bad_input, "serve: " + message);
}

/// Refuses a second server on one data folder, because they would undo each other's changes. Retries for a short time:
/// a worker just started by a killed server holds the lock until the kernel has killed it.
std::unique_ptr<upkeep::DataLock> lock_data(const std::filesystem::path& data) {
  const auto deadline = std::chrono::steady_clock::now() + lock_patience;
  while (true) {
    auto lock = upkeep::DataLock::take(data);
    if (lock) return std::move(*lock);
    if (lock.error().code == ErrorCode::io)
      fail_input("--data: the lock of the folder cannot be taken: " + lock.error().message);
    if (std::chrono::steady_clock::now() > deadline)
      fail_input("--data: another server works in " + data.string() + "; stop it or choose another folder");
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

/// On a full disk with the reserve released. A new data folder cannot be made on a full disk.
Result<std::unique_ptr<store::Store>> open_store(const std::filesystem::path& file, store::DiskReserve& reserve) {
  const auto open = [&] {
    auto store = store::open_sqlite_store(file);
    if (!store) fail("serve: --data", store.error());
    return store;
  };
  try {
    try {
      return open();
    } catch (const store::DiskFull&) {
      if (!reserve.release()) throw;
    }
    return open();
  } catch (const store::DiskFull& fault) {
    throw CommandFailure(CommandFailure::internal, std::string("serve: --data: the disk is full: ") + fault.what());
  }
}

/// Throws StoreError unless a change can be made durable, and some disk space and some files are free: the store alone
/// may have space left in its own files.
void check_writable(store::DatabaseFacts& store, const std::filesystem::path& data) {
  constexpr std::uint64_t least_free = std::uint64_t{1} << 20U;
  store.check_writable();
  constexpr std::uint64_t least_files = 16;  // of a job: its folder and what it makes
  if (store::free_bytes(data) < least_free) throw store::DiskFull("less than 1 MiB is free in " + data.string());
  if (store::free_files(data) < least_files) throw store::DiskFull("no more files can be made in " + data.string());
}

/// On a full disk the folders are made later, when there is space; where a file has their name, when it is gone.
void make_folders(store::PendingWrites& pending, store::BlobStore& blobs, store::DiskReserve& reserve) {
  try {
    reserve.fill();
  } catch (const store::StoreError& fault) {
    pending.note(fault);
  }
  pending.write(&blobs, "folders", "the folders for uploads and blobs", [&blobs] { blobs.make_folders(); });
}

/// Before the first thread: it forks.
jobs::Isolation isolation_of_workers(const std::filesystem::path& data) {
  const auto isolation = jobs::available_isolation(data);
  if (const auto missing = jobs::missing_isolation(isolation); !missing.empty()) log::warning(missing);
  return isolation;
}

void purge(store::Trash& trash, const std::stop_token& stop) {
  const auto removed = trash.purge(std::chrono::system_clock::now(), stop);
  if (removed.files > 0)
    log::info(std::to_string(removed.files) + " files (" + std::to_string(removed.bytes) +
              " bytes) removed from the trash after the grace period");
}

void open_streams(store::StreamStore& store, streams::StreamHub& hub, const ServeOptions& options) {
  if (options.demo) {
    streams::StreamInfo demo;
    demo.id = "demo";
    demo.settings.title = "Demo";
    demo.settings.model = options.sample.empty() ? "" : std::string(sample_model_id);
    demo.settings.batch_interval = 0;
    demo.settings.is_public = true;  // it is there to be shown
    demo.created = store::timestamp_now();
    demo.source = "demo";
    hub.open(demo);
  }
  for (const auto& record : store.streams()) {
    streams::StreamInfo info;
    info.id = record.id;
    info.created = record.created;
    info.settings = record.settings;
    info.source = "none";
    if (!hub.open(info)) log::warning("the stream " + record.id + " is hidden by one of the server's own");
  }
}

void write_net_metrics(metrics::TextWriter& writer, const net::ServerCounts& counts) {
  using metrics::MetricType;
  writer.single("semblante_connections", MetricType::gauge, "Connections open, WebSockets among them.",
                counts.connections_open);
  writer.single("semblante_connections_accepted_total", MetricType::counter, "Connections accepted.",
                counts.connections_total);
  writer.single("semblante_connections_refused_total", MetricType::counter,
                "Connections refused because of the limit of open connections.", counts.connections_refused);
  writer.single("semblante_websockets", MetricType::gauge, "WebSockets open.", counts.websockets_open);
}

/// A certificate and all addresses, for phones in the same network.
ListenOptions listening_at_home(ListenOptions options, const std::filesystem::path& data) {
  constexpr std::uint16_t usual_port = 8443;
  if (!options.listen.empty() || !options.certificate.empty())
    fail_input("--lan chooses address and certificate itself; leave out --listen, --tls-cert and --tls-key");
  auto names = network_addresses();
  if (names.empty()) fail_input("--lan: this machine has no address in a network");
  names.emplace_back("localhost");
  names.emplace_back("127.0.0.1");
  const auto files = self_signed_certificate(data, names);
  options.listen = {"0.0.0.0:" + std::to_string(options.port == ListenOptions{}.port ? usual_port : options.port)};
  options.certificate = files.certificate;
  options.key = files.key;
  return options;
}

/// A token for this run of `serve --lan`; those of earlier runs end. Prints how a phone gets in.
void invite(store::TokenStore& tokens, std::uint16_t port) {
  constexpr std::int64_t life = std::int64_t{12} * 3600;  // seconds
  const std::string name = "serve --lan";
  for (const auto& token : tokens.tokens())
    if (token.name == name) tokens.remove_token(token.id);
  const auto made = access::make_token({name, access::Scope::edit, {}, {}, life});
  tokens.add_token(made.record);
  const auto addresses = network_addresses();
  if (addresses.empty()) return;
  // After the # it is not sent with a request: the page takes it from there and forgets it.
  const auto url = url_of({addresses.front(), port, true}, port) + "/#token=" + made.text;
  std::cout << qr_code(url) << url
            << "\nThe browser warns about the certificate, because this machine has signed it itself. The token is "
               "accepted for 12 hours.\n";
}

}  // namespace

void run_serve(const ServeOptions& options) {
  const auto level = log::parse_level(options.log_level);
  if (!level) fail_input("--log-level: " + options.log_level + " is not one of debug, info, warning, error");
  const auto format = log::parse_format(options.log_format);
  if (!format) fail_input("--log-format: " + options.log_format + " is not one of text, json");
  log::set_level(*level);
  log::set_format(*format);
  // What users upload is theirs: other accounts of this machine may not read the data folder, nor what is made in it.
  ::umask(S_IRWXG | S_IRWXO);
  // A write to a closed pipe or socket, or beyond the limit of a file's size (ulimit -f), must return an error.
  for (const int number : {SIGPIPE, SIGXFSZ}) std::signal(number, SIG_IGN);
  const auto open_files = open_files_to_serve(options.max_connections);
  std::error_code error;
  if (!options.web_root.empty() && !std::filesystem::is_directory(options.web_root, error))
    fail_input("--web-root: " + options.web_root.string() + " is no folder");
  std::filesystem::create_directories(options.data, error);
  if (error) fail_input("--data: " + options.data.string() + ": " + error.message());
  const auto listen_options = options.lan ? listening_at_home(options.listening, options.data) : options.listening;
  const auto listening = check_listening(listen_options, options.data);
  auto hosts = options.allowed_hosts;
  for (const auto& listener : listening.listeners) hosts.push_back(listener.address);
  const auto lock = lock_data(options.data);

  auto blobs = store::BlobStore::open(options.data);
  const auto isolation = isolation_of_workers(options.data);
  store::DiskReserve reserve(options.data / "reserve");
  const auto trash = std::make_shared<store::Trash>(options.data, std::chrono::seconds(options.trash_grace));
  keep_log_of_lost_database(options.data, *trash);
  auto store = open_store(options.data / store::database_file_name, reserve);
  bring_files_in_line(options.data, **store, *trash);
  // From now on the trash is only read by others.
  const log::Periodic purger(
      "purging the trash", purge_interval, [&trash](const std::stop_token& stop) { purge(*trash, stop); },
      log::Periodic::First::at_once);

  store::PendingWrites pending({[&] { check_writable(**store, options.data); }, &reserve});
  make_folders(pending, blobs, reserve);

  jobs::JobConfig job_config;
  job_config.worker_command = {jobs::own_executable(), "worker"};
  job_config.isolation = isolation;
  job_config.limits.memory_bytes = options.worker_memory;
  job_config.limits.cpu_seconds = options.worker_cpu_seconds;
  job_config.concurrency = options.workers;
  jobs::JobQueue queue({**store, **store, **store}, blobs, pending, job_config);
  recordings::RecorderLimits recorder_limits;
  recorder_limits.max_recordings = options.max_recordings;
  recorder_limits.max_bytes = options.max_recording_bytes;
  recorder_limits.max_total_bytes = options.max_recordings_bytes;
  recorder_limits.disk_reserve = options.disk_reserve;
  auto recorder = recordings::Recorder::open(**store, **store, pending, options.data / store::recordings_folder_name,
                                             recorder_limits);
  streams::StreamLimits stream_limits;
  stream_limits.max_connections = options.max_stream_connections;
  streams::InProcessHub hub(stream_limits, net::make_group_sender());
  hub.set_listener(recorder);
  open_streams(**store, hub, options);

  api::ApiConfig api_config;
  api_config.limits.max_upload_bytes = options.max_upload_bytes;
  api_config.limits.max_models = options.max_models;
  api_config.limits.max_streams = options.max_streams;
  api_config.limits.max_expressions = options.max_expressions;
  api_config.limits.max_speeches = options.max_speeches;
  const auto program = options.voice_program.empty() ? voice::installed_voice() : options.voice_program;
  if (!program.empty() && program != "none") api_config.voice.command = {program};
  api_config.voice.wall_seconds = api::longest_speech_seconds;
  api_config.voice.temporary = blobs.temporary();
  api_config.sound_reader = api_config.voice;
  api_config.sound_reader.command = {voice::installed_sound_reader()};
  api_config.recognizer = voice::recognizer_at(options.recognizer_program);
  api_config.recognizer.wall_seconds = api_config.voice.wall_seconds;
  api_config.recognizer.temporary = api_config.voice.temporary;
  // Half of the threads at most: the others handle what else is asked.
  api_config.limits.max_exports = api_config.limits.max_voices = std::max(1U, options.threads / 2);
  api_config.version = SEMBLANTE_VERSION;
  api_config.web_root = options.web_root;
  api_config.access = {hosts, options.allowed_origins, options.frame_origins};
  api_config.security.asks_for_tokens = listening.asks_for_tokens;
  api_config.security.proxies = listening.proxies;
  api_config.security.token_limits = options.token_limits;
  api_config.security.rates = std::make_shared<access::ClientRates>(options.client_limits);
  const auto tokens = api_config.security.tokens;
  tokens->load(**store);
  // Behind a proxy, in a container above all, the first token is made while the server runs.
  if (listening.asks_for_tokens && tokens->empty() && !listening.proxies.empty())
    log::warning("the server asks for tokens, and there is none: semblante token create --data " +
                 options.data.string() + " --scope admin");
  else if (listening.asks_for_tokens && tokens->empty() && !options.lan)
    fail_input(
        "nobody could use this server: it asks for tokens, and there is none. Make one:\n  semblante token create "
        "--data " +
        options.data.string() + " --scope admin");
  // Of the bound sockets; empty until the server listens.
  std::vector<std::uint16_t> bound;
  api_config.network_urls = [&listening, &bound, names = api_config.access.certificate] {
    return network_urls(listening.listeners, bound, names->all());
  };
  net::Server* running = nullptr;
  const auto net_metrics = [&running](metrics::TextWriter& writer) { write_net_metrics(writer, running->counts()); };
  api::Api api(api::Context{**store, blobs, pending, queue, hub, api_config, net_metrics, recorder, trash});

  net::ServerConfig net_config;
  net_config.listeners = listening.listeners;
  net_config.proxies = listening.proxies;
  net_config.worker_threads = options.threads;
  net_config.upload_directory = blobs.temporary();
  net_config.limits.max_connections = open_files.connections;
  net_config.limits.max_files = open_files.bodies;
  net_config.limits.max_connections_per_address = static_cast<std::uint32_t>(options.max_connections_per_address);
  net_config.limits.max_handshakes_per_address = static_cast<std::uint32_t>(options.max_handshakes_per_address);
  net_config.limits.drain_time = std::chrono::seconds(options.drain_seconds);
  net::Server server(net_config, api);
  running = &server;
  const auto ports = server.listen();
  if (!ports) fail("serve", ports.error());
  bound = *ports;
  server.stop_on_signals(!listening.tls);
  std::optional<CertificateFiles> certificate;
  if (listening.tls) {
    api.redirect_to_https(ports->front());
    certificate.emplace(net::TlsFiles{listen_options.certificate, listen_options.key},
                        [&server, names = api_config.access.certificate](auto context) {
                          names->set(context->names());
                          server.set_tls(std::move(context));
                        });
    server.reload_on_signal([&certificate] { certificate->reload(); });
  }
  // Tokens that a command line has made or revoked.
  constexpr std::chrono::seconds look_for_tokens{1};
  const log::Periodic token_watch("looking for changed tokens", look_for_tokens,
                                  [&](const auto&) { tokens->refresh(**store); });

  SampleInstaller sample(**store, **store, blobs, pending, queue, options.sample);
  queue.on_finished([&sample](const store::JobRecord& job) { sample.job_finished(job); });
  queue.start();
  sample.begin();

  for (std::size_t i = 0; i < ports->size(); ++i)
    std::cout << "semblante listening on " << url_of(listening.listeners[i], (*ports)[i]) << std::endl;
  if (options.lan) {
    invite(**store, ports->front());
    tokens->load(**store);
    std::cout << std::flush;
  }
  notify_service_manager("READY=1");
  server.run([&] {
    log::info("stopping: finishes what has begun, within " + std::to_string(options.drain_seconds) + " s");
    notify_service_manager("STOPPING=1");
    api.begin_stopping();
    // What is recorded ends with its stream, after the last frame that was accepted.
    recorder->begin_closing();
    hub.shut_down();
  });
  recorder->close();
  queue.stop();
  log::info("stopped");
}

}  // namespace semblante
