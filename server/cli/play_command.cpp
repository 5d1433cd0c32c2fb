#include <atomic>
#include <csignal>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <memory>
#include <sstream>
#include <thread>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "core/json/json_cursor.h"
#include "core/json/read_json.h"
#include "protocol/http/http_client.h"
#include "server/cli/command_failure.h"
#include "server/cli/commands.h"
#include "server/cli/face_formats.h"
#include "server/cli/files.h"
#include "server/cli/real_range.h"

namespace semblante {
namespace {

using nlohmann::json;

constexpr std::size_t most_bytes = std::size_t{64} << 20U;
constexpr std::chrono::milliseconds look_interval{250};
constexpr client::HttpLimits limits = {.max_body = most_bytes};
constexpr JsonLimits answer_limits = {.max_bytes = std::size_t{1} << 20U, .max_depth = 16, .max_values = 100'000};
constexpr std::size_t most_warnings = 1000;
/// ms: a play that stopped earlier than this before its end was stopped by someone; allows for the polling interval.
constexpr double end_slack = 3000.0;

struct PlayCommand {
  client::ServerOptions server;
  std::string file, stream, format;
  bool create = false, loop = false, take_over = false, quiet = false;
  double rate = 0.0, from = 0.0;
};

std::atomic<bool> interrupted{false};

[[noreturn]] void refuse_to_play(const std::string& what) {
  throw CommandFailure(CommandFailure::bad_input, "play: " + what);
}

client::ServerAddress address_of(const PlayCommand& options) {
  auto server = options.server.parse();
  if (!server) fail("play: --server", server.error());
  if (options.server.address.find("://") == std::string::npos || !server->url.path.empty())
    refuse_to_play("--server: " + options.server.address + " must be http://HOST:PORT or https://HOST");
  return *std::move(server);
}

class Playing {
 public:
  explicit Playing(const PlayCommand& options) : options_(options), server_(address_of(options), limits) {}

  void create_stream() const {
    const auto reply = ask("POST", "/v1/streams", "application/json", json{{"name", options_.stream}}.dump());
    if (reply.status != 201 && reply.status != 409) refuse_to_play("--create: " + words_of(reply));
  }

  /// A performance or a .fap file is sent unchanged: the server plays both. Other formats are converted to a
  /// performance, exact to half a quantizer step at the times of their frames.
  void begin() {
    const auto bytes = read_file(options_.file, most_bytes);
    std::string text(bytes.begin(), bytes.end());
    auto extension = std::filesystem::path(options_.file).extension().string();
    const bool fap = options_.format == "fap" || (options_.format.empty() && extension == ".fap");
    const bool performance =
        options_.format == "performance" || (options_.format.empty() && extension == ".json" && is_performance(text));
    if (!fap && !performance) {
      const auto sequence = read_faces(options_.file, options_.format, {});
      for (const auto& warning : sequence.warnings) say(warning);
      FaceWriting writing;
      writing.name = std::filesystem::path(options_.file).stem().string();
      text = write_faces(sequence, "", "performance", writing);
    }
    std::ostringstream target;
    target << "/v1/streams/" << options_.stream << (fap ? "/fap" : "/performances") << "?loop=" << std::boolalpha
           << options_.loop << "&take_over=" << options_.take_over;
    if (options_.rate > 0.0) target << "&fps=" << options_.rate;
    if (options_.from > 0.0) target << "&from=" << options_.from;
    // From here on there is something to stop. Before, a signal ends the process, which may wait for its file.
    std::signal(SIGINT, [](int) { interrupted = true; });
    std::signal(SIGTERM, [](int) { interrupted = true; });
    const auto reply = ask("POST", target.str(), fap ? "text/plain" : "application/json", std::move(text));
    if (reply.status != 202)
      refuse_to_play(options_.file + ": " + words_of(reply) +
                     (reply.status == 409 ? " (--take-over takes its place)" : ""));
    location_ = reply.header("location");
    for (const auto& warning : note(reply)) say(warning);
  }

  /// Waits until the play has ended, or Ctrl-C stops it.
  void follow() {
    const bool shows = !options_.quiet && ::isatty(STDERR_FILENO) != 0;
    while (!interrupted) {
      const auto reply = ask("GET", location_);
      if (reply.status == 404) break;
      if (reply.status != 200) refuse_to_play(words_of(reply));
      (void)note(reply);
      if (shows) {
        std::cerr << "\r" << std::fixed << std::setprecision(1) << position_ / 1000.0 << " s";
        if (duration_ > 0.0) std::cerr << " of " << duration_ / 1000.0 << " s";
        std::cerr << "  " << std::flush;
      }
      std::this_thread::sleep_for(look_interval);
    }
    if (shows) std::cerr << "\n";
    if (interrupted) {
      const auto reply = ask("DELETE", location_);
      if (reply.status != 204 && reply.status != 404) refuse_to_play(words_of(reply));
      return;
    }
    if (options_.loop || duration_ <= 0.0 || duration_ - position_ > end_slack)
      throw CommandFailure(CommandFailure::internal,
                           "play: ended before its time: it was stopped, or another source took over");
  }

 private:
  client::HttpResponse ask(const std::string& method, const std::string& target, const std::string& type = {},
                           std::string body = {}) const {
    auto reply = server_.send({method, target, std::move(body), type, {}});
    if (!reply) fail("play: --server", reply.error());
    return *std::move(reply);
  }
  /// Stores the position of the play; returns the warnings of the answer.
  std::vector<std::string> note(const client::HttpResponse& reply) {
    const auto status = read_json_object(reply.body, answer_limits);
    if (!status) refuse_to_play("the server's answer cannot be read: " + status.error().message);
    JsonCursor::Report report;
    const JsonCursor root(json_view(*status), report);
    position_ = root.number_or("position", 0.0);
    duration_ = root.number_or("duration", 0.0);
    if (report) refuse_to_play("the server's answer cannot be read: " + report->where + ": " + report->message);
    return root.texts("warnings", most_warnings);
  }
  void say(const std::string& warning) const {
    if (!options_.quiet) std::cerr << "warning: " << warning << "\n";
  }

  const PlayCommand& options_;
  client::HttpClient server_;
  std::string location_;
  double position_ = 0.0, duration_ = 0.0;  ///< ms; duration 0: endless
};

void run(const PlayCommand& options) {
  for (const char c : options.stream)
    if (!((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_'))
      refuse_to_play("--stream: it takes lower-case letters, digits, - and _");
  Playing playing(options);
  if (options.create) playing.create_stream();
  playing.begin();
  playing.follow();
}

}  // namespace

void add_play_command(CLI::App& app) {
  auto options = std::make_shared<PlayCommand>();
  CLI::App* const command = app.add_subcommand(
      "play",
      "Play a file into a stream of a running server, in real time: a performance, a .fap file, frames, a take of Live "
      "Link Face. Ends with it; Ctrl-C stops it, and the face returns to rest.");
  command->add_option("FILE", options->file, "File to play")->required()->envname("SEMBLANTE_IN");
  command->add_option("--server", options->server.address, "Address of the server, http://HOST:PORT or https://HOST")
      ->capture_default_str()
      ->envname("SEMBLANTE_SERVER");
  client::declare_access_options(*command, options->server);
  command->add_option("--stream", options->stream, "Id of the stream")->required()->envname("SEMBLANTE_STREAM");
  command->add_option("--in-format", options->format, "Of FILE, if its name does not tell: " + readable_face_formats())
      ->envname("SEMBLANTE_IN_FORMAT");
  command->add_flag("--create", options->create, "Open the stream first, if it is not there")
      ->envname("SEMBLANTE_CREATE");
  command->add_flag("--loop", options->loop, "Begin again at its end")->envname("SEMBLANTE_LOOP");
  command->add_flag("--take-over", options->take_over, "Replace the current source of the stream")
      ->envname("SEMBLANTE_TAKE_OVER");
  command->add_option("--rate", options->rate, "Frames a second; left out: a .fap file's own, else 25")
      ->check(real_range(1.0, 120.0))
      ->envname("SEMBLANTE_RATE");
  command->add_option("--from", options->from, "Begin so many ms after its beginning")
      ->check(real_range(0.0, 86'400'000.0))
      ->envname("SEMBLANTE_FROM");
  command->add_flag("--quiet", options->quiet, "No progress, no warnings")->envname("SEMBLANTE_QUIET");
  command->callback([options] { run(*options); });
}

}  // namespace semblante
