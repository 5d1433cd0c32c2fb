#include "tests/bench/fanout/target.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sched.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "server/net/self_signed.h"

namespace semblante::bench {

using Json = nlohmann::json;

namespace {

/// A folder for one run; ends the program when there is none.
std::filesystem::path make_folder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "semblante-fanout-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) give_up("no folder " + pattern);
  return pattern;
}

net::TlsFiles make_certificate(const std::filesystem::path& folder) {
  net::TlsFiles files{folder / "cert.pem", folder / "key.pem"};
  const auto made = net::write_self_signed(files, "bench", {"127.0.0.1"}, std::chrono::hours(24 * 90));
  if (!made.ok()) give_up("no certificate: " + made.error().message);
  return files;
}

/// This thread, and what it starts from now on, runs on the processors from `first` to `last` only.
void run_on(int first, int last) {
  cpu_set_t set;
  CPU_ZERO(&set);
  for (int i = first; i <= last; ++i) CPU_SET(static_cast<unsigned>(i), &set);
  if (sched_setaffinity(0, sizeof set, &set) != 0) give_up(std::string("--apart: ") + std::strerror(errno));
}

}  // namespace

std::filesystem::path program_folder() { return std::filesystem::read_symlink("/proc/self/exe").parent_path(); }

SemblanteServer::SemblanteServer(const Options& options) {
  if (!options.url.empty()) {
    endpoint_ = parse_endpoint(options.url);
    pid_ = options.pid;
    return;
  }
  data_ = make_folder();
  const auto program = options.program.empty() ? (program_folder() / "semblante").string() : options.program;
  std::vector<std::string> command = {
      program, "serve",       "--listen", "127.0.0.1:0", "--data", (data_ / "data").string(), "--max-connections",
      "30000", "--log-level", "warning"};
  if (options.tls) {
    const auto files = make_certificate(data_);
    command.insert(command.end(), {"--tls-cert", files.certificate.string(), "--tls-key", files.key.string()});
  }
  const int processors = static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN));
  if (options.apart && processors < 2) give_up("--apart needs two processors");
  if (options.apart) run_on(0, 0);
  auto started = ServerProcess::start(command);
  if (options.apart) run_on(1, processors - 1);
  if (!started) give_up("the server does not start: " + program);
  process_.emplace(std::move(*started));
  endpoint_ = process_->endpoint();
  pid_ = process_->pid();
}

SemblanteServer::~SemblanteServer() {
  if (process_) {
    process_.reset();
    std::error_code ignored;
    std::filesystem::remove_all(data_, ignored);
  } else {
    for (const auto& path : streams_) request(endpoint_, "DELETE", path);
  }
}

bool SemblanteServer::healthy() const {
  return (!process_ || process_->alive()) && request(endpoint_, "GET", "/v1/streams").status == 200;
}

std::string SemblanteServer::make_stream(int batch_ms) {
  const auto name = "bench-" + std::to_string(getpid()) + "-" + std::to_string(streams_.size());
  Json body = {{"name", name}, {"batch_interval", batch_ms}};
  auto reply = request(endpoint_, "POST", "/v1/streams", body.dump());
  if (reply.status != 201) {  // a server that gathers no batches sends at once
    body.erase("batch_interval");
    reply = request(endpoint_, "POST", "/v1/streams", body.dump());
  }
  if (reply.status != 201) give_up("the server makes no stream: " + reply.body);
  streams_.push_back("/v1/streams/" + name);
  return streams_.back();
}

std::uint64_t SemblanteServer::stream_number(const std::string& path, const std::string& member) const {
  return Json::parse(request(endpoint_, "GET", path).body).at(member).get<std::uint64_t>();
}

FedStream::FedStream(SemblanteServer& server, const Options& options, double seconds)
    : path(server.make_stream(options.batch_ms)),
      sent(1000 + static_cast<std::size_t>(seconds * options.feed.messages_per_second *
                                           static_cast<double>(options.feed.frames_per_message))),
      timeline(stream_content(options.coding, sent, options.feed.heavy)),
      publisher(server.endpoint(), path, options.feed, sent) {}

std::optional<ServerProcess> start_rival(const std::string& name, double messages_per_second, std::size_t bytes) {
  std::vector<std::string> command;
  constexpr std::string_view with_tls = "-tls";
  const bool tls = name.ends_with(with_tls);
  if (name == "ws") {
    const std::filesystem::path folder(SEMBLANTE_FANOUT_RIVALS);
    if (!std::filesystem::exists(folder / "node_modules/ws")) {
      std::printf("ws: left out; `npm ci` in %s installs it\n", folder.c_str());
      return std::nullopt;
    }
    command = {"node", (folder / "ws_broadcast.mjs").string()};
  } else {
    const auto program = name.substr(0, name.size() - (tls ? with_tls.size() : 0));
    command = {(program_folder() / ("bench_fanout_" + program)).string()};
  }
  command.push_back(std::to_string(messages_per_second));
  command.push_back(std::to_string(bytes));
  std::filesystem::path folder;
  if (tls) {
    folder = make_folder();
    const auto files = make_certificate(folder);
    command.push_back(files.certificate.string());
    command.push_back(files.key.string());
  }
  auto process = ServerProcess::start(command);  // it listens once it has read the files
  std::error_code ignored;
  if (tls) std::filesystem::remove_all(folder, ignored);
  if (!process) std::printf("%s: left out; it does not start: %s\n", name.c_str(), command.front().c_str());
  return process;
}

}  // namespace semblante::bench
