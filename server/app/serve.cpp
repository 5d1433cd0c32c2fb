#include "server/app/serve.h"

#include <csignal>
#include <iostream>
#include <optional>

#include <sys/stat.h>

#include "server/access/token_registry.h"
#include "server/api/api.h"
#include "server/app/certificate_files.h"
#include "server/app/data_folder.h"
#include "server/app/lan.h"
#include "server/app/lan_mode.h"
#include "server/app/open_data.h"
#include "server/app/open_files.h"
#include "server/app/private_files.h"
#include "server/app/sample_installer.h"
#include "server/app/serve_config.h"
#include "server/app/serve_failure.h"
#include "server/app/service_manager.h"
#include "server/jobs/isolation.h"
#include "server/log/log.h"
#include "server/log/periodic.h"
#include "server/net/ring_sender.h"
#include "server/net/server.h"
#include "server/upkeep/data_lock.h"

namespace semblante {
namespace {

constexpr std::chrono::hours purge_interval{1};

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

void set_up_log(const ServeOptions& options) {
  const auto level = log::parse_level(options.log_level);
  if (!level) fail_serve("--log-level: " + options.log_level + " is not one of debug, info, warning, error");
  const auto format = log::parse_format(options.log_format);
  if (!format) fail_serve("--log-format: " + options.log_format + " is not one of text, json");
  log::set_level(*level);
  log::set_format(*format);
}

void set_up_process() {
  // What users upload is theirs: other accounts of this machine may not read the data folder, nor what is made in it.
  ::umask(S_IRWXG | S_IRWXO);
  // A write to a closed pipe or socket, or beyond the limit of a file's size (ulimit -f), must return an error.
  // SIGUSR1 and SIGUSR2 are what scripts for rotating logs send to any daemon; here they have no meaning, and must not
  // end the process.
  for (const int number : {SIGPIPE, SIGXFSZ, SIGUSR1, SIGUSR2}) std::signal(number, SIG_IGN);
}

void check_folders(const ServeOptions& options) {
  std::error_code error;
  if (!options.web_root.empty() && !std::filesystem::is_directory(options.web_root, error))
    fail_serve("--web-root: " + options.web_root.string() + " is no folder");
  if (const auto faults = private_files_in_web_root(options); !faults.empty()) fail_serve(faults.front());
  std::filesystem::create_directories(options.data, error);
  if (error) fail_serve("--data: " + options.data.string() + ": " + error.message());
}

/// A server that asks for tokens needs one.
void check_for_token(const access::TokenRegistry& tokens, const Listening& listening, const ServeOptions& options) {
  if (!listening.asks_for_tokens || !tokens.empty()) return;
  const std::string command = "semblante token create --data " + options.data.string() + " --scope admin";
  // Behind a proxy, in a container above all, the first token is made while the server runs.
  if (!listening.proxies.empty())
    log::warning("the server asks for tokens, and there is none: " + command);
  else if (!options.lan)
    fail_serve("nobody could use this server: it asks for tokens, and there is none. Make one:\n  " + command);
}

}  // namespace

void run_serve(const ServeOptions& options) {
  set_up_log(options);
  set_up_process();
  const auto open_files = open_files_to_serve(options.max_connections);
  check_folders(options);
  const auto listen_options = options.lan ? listening_at_home(options.listening, options.data) : options.listening;
  const auto listening = check_listening(listen_options, options.data);
  const auto lock = lock_data(options.data);

  auto blobs = store::BlobStore::open(options.data);
  const auto isolation = isolation_of_workers(options.data);
  store::DiskReserve reserve(options.data / "reserve");
  const auto trash = std::make_shared<store::Trash>(options.data, std::chrono::seconds(options.trash_grace));
  keep_log_of_lost_database(options.data, *trash);
  const auto store = open_store(options.data, reserve);
  bring_files_in_line(options.data, *store, *trash);
  // From now on the trash is only read by others.
  const log::Periodic purger(
      "purging the trash", purge_interval, [&trash](const std::stop_token& stop) { purge(*trash, stop); },
      log::Periodic::First::at_once);

  store::PendingWrites pending({[&] { check_writable(*store, options.data); }, &reserve});
  make_folders(pending, blobs, reserve);

  jobs::JobQueue queue({*store, *store, *store}, blobs, pending, job_config(options, isolation));
  auto recorder = recordings::Recorder::open(*store, *store, pending, options.data / store::recordings_folder_name,
                                             recorder_limits(options));
  streams::StreamLimits stream_limits;
  stream_limits.max_connections = options.max_stream_connections;
  streams::InProcessHub hub(stream_limits, net::make_group_sender());
  hub.set_listener(recorder);
  open_streams(*store, hub, options);

  api::ApiConfig of_api = api_config(options, listening, blobs);
  const auto tokens = of_api.security.tokens;
  tokens->load(*store);
  check_for_token(*tokens, listening, options);
  const auto names = of_api.access.certificate;
  // Of the bound sockets; empty until the server listens.
  std::vector<std::uint16_t> bound;
  of_api.network_urls = [&listening, &bound, names] { return network_urls(listening.listeners, bound, names->all()); };
  net::Server* running = nullptr;
  const auto net_metrics = [&running](metrics::TextWriter& writer) { write_net_metrics(writer, running->counts()); };
  api::Api api(api::Context{*store, blobs, pending, queue, hub, of_api, net_metrics, recorder, trash});

  net::Server server(net_config(options, listening, blobs, open_files), api);
  running = &server;
  const auto ports = server.listen();
  if (!ports) fail("serve", ports.error());
  bound = *ports;
  server.stop_on_signals(!listening.tls);
  std::optional<CertificateFiles> certificate;
  if (listening.tls) {
    api.redirect_to_https(ports->front());
    certificate.emplace(net::TlsFiles{listen_options.certificate, listen_options.key}, [&server, names](auto context) {
      names->set(context->names());
      server.set_tls(std::move(context));
    });
    server.reload_on_signal([&certificate] { certificate->reload(); });
  }
  // Tokens that a command line has made or revoked.
  constexpr std::chrono::seconds look_for_tokens{1};
  const log::Periodic token_watch("looking for changed tokens", look_for_tokens,
                                  [&](const auto&) { tokens->refresh(*store); });

  SampleInstaller sample(*store, *store, blobs, pending, queue, options.sample);
  queue.on_finished([&sample](const store::JobRecord& job) { sample.job_finished(job); });
  queue.start();
  sample.begin();

  for (std::size_t i = 0; i < ports->size(); ++i)
    std::cout << "semblante listening on " << url_of(listening.listeners[i], (*ports)[i]) << std::endl;
  if (options.lan) {
    invite(*store, ports->front());
    tokens->load(*store);
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
