#include "server/app/serve.h"

#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <iostream>
#include <thread>
#include <unistd.h>

#include <arpa/inet.h>
#include <sys/file.h>
#include <sys/stat.h>

#include "server/api/api.h"
#include "server/app/data_folder.h"
#include "server/app/open_files.h"
#include "server/app/sample_installer.h"
#include "server/cli/command_failure.h"
#include "server/jobs/worker_process.h"
#include "server/log/log.h"
#include "server/net/server.h"
#include "server/store/sqlite_store.h"
#include "server/store/trash_purger.h"

namespace semblante {
namespace {

constexpr std::chrono::hours purge_interval{1};
constexpr std::chrono::seconds lock_patience{5};

[[noreturn]] void fail_input(const std::string& message) {
  throw CommandFailure(CommandFailure::bad_input, "serve: " + message);
}

/// There is no authentication: a client that reaches the port may do everything, so only loopback addresses are
/// allowed.
std::string checked_address(std::string address) {
  if (address == "localhost") address = "127.0.0.1";
  in_addr four{};
  in6_addr six{};
  const bool is_four = inet_pton(AF_INET, address.c_str(), &four) == 1;
  const bool is_six = inet_pton(AF_INET6, address.c_str(), &six) == 1;
  if (!is_four && !is_six) fail_input("--address: " + address + " is not an IP address");
  const bool loopback = is_four ? (ntohl(four.s_addr) >> 24U) == 127U : IN6_IS_ADDR_LOOPBACK(&six);
  if (!loopback)
    fail_input("--address: " + address +
               " can be reached from other machines, and this server has no authentication; use 127.0.0.1 or ::1 and "
               "put a proxy with authentication in front of it");
  return address;
}

/// Refuses a second server on one data folder, because they would undo each other's changes. The lock is held until the
/// process ends. Retries for a short time: a worker just started by a killed server holds the lock until the kernel has
/// killed it.
void lock_data(const std::filesystem::path& data) {
  const auto file = data / "lock";
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (descriptor < 0) fail_input("--data: " + data.string() + " cannot be written: " + std::strerror(errno));
  const auto deadline = std::chrono::steady_clock::now() + lock_patience;
  while (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
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

/// Throws StoreError unless a change can be made durable and some disk space is free: the store alone may have space
/// left in its own files.
void check_writable(store::DatabaseFacts& store, const std::filesystem::path& data) {
  constexpr std::uint64_t least_free = std::uint64_t{1} << 20U;
  store.check_writable();
  if (store::free_bytes(data) < least_free) throw store::DiskFull("less than 1 MiB is free in " + data.string());
}

/// On a full disk the folders are made later, when there is space.
void make_folders(store::PendingWrites& pending, store::BlobStore& blobs, store::DiskReserve& reserve) {
  try {
    reserve.fill();
  } catch (const store::StoreError& fault) {
    pending.note(fault);
  }
  pending.write(&blobs, "folders", "the folders for uploads and blobs", [&blobs] {
    if (const auto made = blobs.make_folders(); !made) throw store::StoreError(made.error().message);
  });
}

void open_streams(store::StreamStore& store, streams::StreamHub& hub, const ServeOptions& options) {
  if (options.demo) {
    streams::StreamInfo demo;
    demo.id = "demo";
    demo.settings.title = "Demo";
    demo.settings.model = options.sample.empty() ? "" : std::string(sample_model_id);
    demo.settings.batch_interval = 0;
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

std::string url_of(const std::string& address, std::uint16_t port) {
  const bool is_six = address.find(':') != std::string::npos;
  return "http://" + (is_six ? "[" + address + "]" : address) + ":" + std::to_string(port);
}

}  // namespace

void run_serve(const ServeOptions& options) {
  const auto level = log::parse_level(options.log_level);
  if (!level) fail_input("--log-level: " + options.log_level + " is not one of debug, info, warning, error");
  log::set_level(*level);
  // What users upload is theirs: other accounts of this machine may not read the data folder, nor what is made in it.
  ::umask(S_IRWXG | S_IRWXO);
  std::signal(SIGPIPE, SIG_IGN);  // a write to a closed pipe or socket must return an error
  const auto address = checked_address(options.address);
  std::error_code error;
  if (!options.web_root.empty() && !std::filesystem::is_directory(options.web_root, error))
    fail_input("--web-root: " + options.web_root.string() + " is no folder");
  std::filesystem::create_directories(options.data, error);
  if (error) fail_input("--data: " + options.data.string() + ": " + error.message());
  lock_data(options.data);

  auto blobs = store::BlobStore::open(options.data);
  if (!blobs) fail("serve: --data", blobs.error());
  store::DiskReserve reserve(options.data / "reserve");
  const auto trash = std::make_shared<store::Trash>(options.data, std::chrono::seconds(options.trash_grace));
  keep_log_of_lost_database(options.data, *trash);
  auto store = open_store(options.data / store::database_file_name, reserve);
  bring_files_in_line(options.data, **store, *trash);
  const store::TrashPurger purger(*trash, purge_interval, [](const store::Trash::Counts& removed) {
    log::info(std::to_string(removed.files) + " files (" + std::to_string(removed.bytes) +
              " bytes) removed from the trash after the grace period");
  });

  store::PendingWrites pending({[&] { check_writable(**store, options.data); }, &reserve});
  make_folders(pending, *blobs, reserve);

  jobs::JobConfig job_config;
  job_config.worker_command = {jobs::own_executable(), "worker"};
  job_config.limits.memory_bytes = options.worker_memory;
  job_config.limits.cpu_seconds = options.worker_cpu_seconds;
  job_config.concurrency = options.workers;
  jobs::JobQueue queue({**store, **store, **store}, *blobs, pending, job_config);
  recordings::RecorderLimits recorder_limits;
  recorder_limits.max_recordings = options.max_recordings;
  recorder_limits.max_bytes = options.max_recording_bytes;
  recorder_limits.max_total_bytes = options.max_recordings_bytes;
  recorder_limits.disk_reserve = options.disk_reserve;
  auto recorder = recordings::Recorder::open(**store, **store, pending, options.data / store::recordings_folder_name,
                                             recorder_limits);
  if (!recorder) fail("serve: --data", recorder.error());
  streams::StreamLimits stream_limits;
  stream_limits.max_connections = options.max_stream_connections;
  streams::InProcessHub hub(stream_limits);
  hub.set_listener(*recorder);
  open_streams(**store, hub, options);

  api::ApiConfig api_config;
  api_config.limits.max_upload_bytes = options.max_upload_bytes;
  api_config.limits.max_models = options.max_models;
  api_config.limits.max_streams = options.max_streams;
  api_config.limits.max_expressions = options.max_expressions;
  api_config.version = SEMBLANTE_VERSION;
  api_config.web_root = options.web_root;
  api_config.access = {options.allowed_hosts, options.allowed_origins};
  net::Server* running = nullptr;
  const auto net_metrics = [&running](metrics::TextWriter& writer) { write_net_metrics(writer, running->counts()); };
  api::Api api(api::Context{**store, *blobs, pending, queue, hub, api_config, net_metrics, *recorder, trash});

  net::ServerConfig net_config;
  net_config.address = address;
  net_config.port = options.port;
  net_config.worker_threads = options.threads;
  net_config.upload_directory = blobs->temporary();
  net_config.limits.max_connections = connections_to_serve(options.max_connections);
  net::Server server(net_config, api);
  running = &server;
  const auto port = server.listen();
  if (!port) fail("serve", port.error());
  server.stop_on_signals();

  SampleInstaller sample(**store, **store, *blobs, pending, queue, options.sample);
  queue.on_finished([&sample](const store::JobRecord& job) { sample.job_finished(job); });
  queue.start();
  sample.begin();

  std::cout << "semblante listening on " << url_of(address, *port) << std::endl;
  server.run([&] {
    (*recorder)->stop_all(recordings::ended::server_stopped);
    hub.close_all(EndReason::shutdown);
  });
  log::info("stopping");
  (*recorder)->close();
  queue.stop();
}

}  // namespace semblante
