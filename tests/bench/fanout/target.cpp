#include "tests/bench/fanout/target.h"

#include <cstdio>
#include <cstdlib>
#include <unistd.h>

#include <nlohmann/json.hpp>

namespace semblante::bench {

using Json = nlohmann::json;

std::filesystem::path program_folder() { return std::filesystem::read_symlink("/proc/self/exe").parent_path(); }

SemblanteServer::SemblanteServer(const Options& options) {
  if (!options.url.empty()) {
    endpoint_ = parse_endpoint(options.url);
    pid_ = options.pid;
    return;
  }
  std::string pattern = (std::filesystem::temp_directory_path() / "semblante-fanout-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) give_up("no folder " + pattern);
  data_ = pattern;
  const auto program = options.program.empty() ? (program_folder() / "semblante").string() : options.program;
  auto started = ServerProcess::start({program, "serve", "--port", "0", "--data", (data_ / "data").string(),
                                       "--max-connections", "30000", "--log-level", "warning"});
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
  if (name == "ws") {
    const std::filesystem::path folder(SEMBLANTE_FANOUT_RIVALS);
    if (!std::filesystem::exists(folder / "node_modules/ws")) {
      std::printf("ws: left out; `npm ci` in %s installs it\n", folder.c_str());
      return std::nullopt;
    }
    command = {"node", (folder / "ws_broadcast.mjs").string()};
  } else {
    command = {(program_folder() / ("bench_fanout_" + name)).string()};
  }
  command.push_back(std::to_string(messages_per_second));
  command.push_back(std::to_string(bytes));
  auto process = ServerProcess::start(command);
  if (!process) std::printf("%s: left out; it does not start: %s\n", name.c_str(), command.front().c_str());
  return process;
}

}  // namespace semblante::bench
