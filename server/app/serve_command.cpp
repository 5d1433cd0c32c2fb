#include <iostream>
#include <map>
#include <memory>

#include <CLI/CLI.hpp>

#include "server/app/browser_names.h"
#include "server/app/commands.h"
#include "server/app/installed_files.h"
#include "server/app/option_sources.h"
#include "server/app/serve.h"
#include "server/app/serve_options.h"
#include "server/cli/command_failure.h"
#include "server/cli/real_range.h"
#include "server/store/store_error.h"

namespace semblante {

void declare_serve_options(CLI::App& app, ServeOptions& declared) {
  auto* const command = &app;
  auto* const options = &declared;
  const auto installed = installed_files();
  options->web_root = installed.web_root;
  options->sample = installed.sample;
  const auto add = [command](const std::string& name, auto& value, const std::string& help,
                             const std::string& variable) {
    return command->add_option(name, value, help)->envname("SEMBLANTE_" + variable)->capture_default_str();
  };
  // Without a range a negative number would wrap to a huge one.
  const CLI::Range count(1, 1'000'000);
  constexpr std::uint64_t max_size = std::uint64_t{1} << 50U;
  auto& listening = options->listening;
  add("--address", listening.address, "Loopback address to listen on, for one person on this machine", "ADDRESS");
  add("--port", listening.port, "Port to listen on; 0: any free port, which is printed", "PORT")
      ->check(CLI::Range(0, 65535));
  add("--listen", listening.listen,
      "ADDRESS:PORT to listen on in place of --address and --port, such as 0.0.0.0:443 or [::]:443; may be given more "
      "than once. What other machines can reach needs TLS and asks for tokens (semblante token create)",
      "LISTEN");
  add("--tls-cert", listening.certificate,
      "Certificate in PEM, with those that sign it; read again when it changes, and at SIGHUP", "TLS_CERT");
  add("--tls-key", listening.key, "Private key of the certificate, in PEM", "TLS_KEY");
  add("--http-redirect", listening.redirects,
      "ADDRESS:PORT without TLS whose requests are redirected to https; may be given more than once", "HTTP_REDIRECT");
  add("--trusted-proxy", listening.proxies,
      "Address or range of a proxy whose X-Forwarded-For and X-Forwarded-Proto are believed; may be given more than "
      "once. The server then asks for tokens",
      "TRUSTED_PROXY");
  command->add_flag("--require-tokens", listening.require_tokens, "Ask for tokens on loopback too")
      ->envname("SEMBLANTE_REQUIRE_TOKENS");
  command
      ->add_flag(
          "--lan", options->lan,
          "For phones in the same network: listens on every address (port 8443), makes a certificate and a token, "
          "and prints the address and its QR code")
      ->envname("SEMBLANTE_LAN");
  add("--data", options->data, "Folder for models, packages and facts; made if missing", "DATA");
  add("--web-root", options->web_root,
      "Folder of the studio's built pages, served at /; without it those of the installation, if there are; \"\": none",
      "WEB_ROOT");
  add("--sample", options->sample,
      "Model file (with <name>.fps.json beside it) to be there as model `sample`, parametrized once in the background",
      "SAMPLE");
  command->add_flag("--demo", options->demo, "Play the stream `demo`: a face that talks, in a loop")
      ->envname("SEMBLANTE_DEMO");
  add("--threads", options->threads, "Threads that handle requests", "THREADS")->check(CLI::Range(1, 256));
  add("--workers", options->workers, "Jobs that run at the same time, each in its own process", "WORKERS")
      ->check(CLI::Range(1, 64));
  add("--max-upload-bytes", options->max_upload_bytes, "Size limit of a model file", "MAX_UPLOAD_BYTES")
      ->transform(CLI::AsSizeValue(false))
      ->check(CLI::Range(std::uint64_t{1}, max_size));
  add("--max-models", options->max_models, "Maximum number of models", "MAX_MODELS")->check(count);
  add("--max-expressions", options->max_expressions, "Maximum number of displacement sets, without the library's",
      "MAX_EXPRESSIONS")
      ->check(count);
  add("--max-speeches", options->max_speeches, "Maximum number of stored speeches", "MAX_SPEECHES")->check(count);
  add("--voice-program", options->voice_program,
      "Program that speaks (server/voice/README.md); left out: semblante-voice-espeak beside this one, if it is there; "
      "none: no voice",
      "VOICE_PROGRAM");
  add("--recognizer-program", options->recognizer_program,
      "Program that hears words in recordings (server/voice/README.md); left out: semblante-recognizer-pocketsphinx "
      "beside this one, if it is there; none: no words",
      "RECOGNIZER_PROGRAM");
  add("--max-streams", options->max_streams, "Maximum number of streams", "MAX_STREAMS")->check(count);
  add("--max-recordings", options->max_recordings, "Maximum number of stored recordings", "MAX_RECORDINGS")
      ->check(count);
  const auto add_size = [&](const std::string& name, std::uint64_t& value, const std::string& help,
                            const std::string& variable) {
    add(name, value, help, variable)->transform(CLI::AsSizeValue(false))->check(CLI::Range(std::uint64_t{0}, max_size));
  };
  add_size("--max-recording-bytes", options->max_recording_bytes, "Size at which a recording ends",
           "MAX_RECORDING_BYTES");
  add_size("--max-recordings-bytes", options->max_recordings_bytes, "Size of all recordings at which running ones end",
           "MAX_RECORDINGS_BYTES");
  add_size("--disk-reserve", options->disk_reserve, "Free bytes that recordings and their exports leave on the disk",
           "DISK_RESERVE");
  const std::map<std::string, std::uint64_t> time_units = {{"s", 1}, {"min", 60}, {"h", 3600}, {"d", 86400}};
  constexpr std::uint64_t max_grace = std::uint64_t{10} * 365 * 86400;
  add("--trash-grace", options->trash_grace,
      "How long files that the database does not know stay in the data folder's trash, seconds (or 36h, 7d); 0: until "
      "the next start",
      "TRASH_GRACE")
      ->transform(CLI::AsNumberWithUnit(time_units, CLI::AsNumberWithUnit::DEFAULT, "TIME"))
      ->check(CLI::Range(std::uint64_t{0}, max_grace));
  add("--max-connections", options->max_connections,
      "Maximum number of connections; 0: three quarters of the limit of open files of the process (hard limit), less "
      "512",
      "MAX_CONNECTIONS")
      ->check(CLI::Range(0, 1'000'000));
  add("--max-stream-connections", options->max_stream_connections, "Connections of one stream",
      "MAX_STREAM_CONNECTIONS")
      ->check(CLI::Range(1, 1'000'000));
  add("--drain-seconds", options->drain_seconds,
      "Seconds after SIGTERM for pending answers, and for streams to reach their subscribers; it ends earlier when all "
      "is done, and at once at a second SIGTERM",
      "DRAIN_SECONDS")
      ->check(CLI::Range(0, 3600));
  add("--worker-memory", options->worker_memory, "Address space of one job's process, bytes (or 4GB); 0: no limit",
      "WORKER_MEMORY")
      ->transform(CLI::AsSizeValue(false))
      ->check(CLI::Range(std::uint64_t{0}, max_size));
  add("--worker-cpu-seconds", options->worker_cpu_seconds, "Processor time of one job, seconds; 0: no limit",
      "WORKER_CPU_SECONDS")
      ->check(CLI::Range(0, 1'000'000));
  add("--allow-host", options->allowed_hosts,
      "Accepted host name besides localhost, e.g. studio.example behind a proxy that keeps the Host of requests; * "
      "takes any; may be given more than once",
      "ALLOW_HOST")
      ->check(fault_of_host);
  add("--allow-origin", options->allowed_origins,
      "Origin whose pages may use the server beside its own, also of another port of this machine, e.g. "
      "http://localhost:5173; * takes all; may "
      "be given more than once",
      "ALLOW_ORIGIN")
      ->check(fault_of_origin);
  add("--allow-frame", options->frame_origins,
      "Origin whose pages may show the server's pages in a frame, e.g. https://shop.example; may be given more than "
      "once",
      "ALLOW_FRAME");
  add("--client-requests", options->client_limits.requests_per_second,
      "Requests per second of one token, or of one address without a token, on a server that asks for tokens; 0: no "
      "limit",
      "CLIENT_REQUESTS")
      ->check(real_range(0.0, 1e6));
  add("--client-failures", options->client_limits.failures_per_minute,
      "Tokens of one address per minute that are not accepted, before it has to wait", "CLIENT_FAILURES")
      ->check(real_range(1.0, 1e6));
  add("--client-creations", options->client_limits.creations_per_minute,
      "Models, jobs, streams, recordings, speeches and expressions together that one address may create per minute; "
      "this machine "
      "and the scope admin have no such limit; 0: no limit",
      "CLIENT_CREATIONS")
      ->check(real_range(0.0, 1e6));
  auto& of_token = options->token_limits;
  add_size("--token-bytes", of_token.bytes,
           "Bytes that one token may have stored: of models, recordings, speeches and expressions; 0: no limit. Tokens "
           "with the "
           "scope admin have none of the limits of a token",
           "TOKEN_BYTES");
  const auto add_count = [&](const std::string& name, std::uint64_t& value, const std::string& what,
                             const std::string& variable) {
    add(name, value, what + "; 0: no limit", variable)->check(CLI::Range(0, 1'000'000));
  };
  add_count("--token-models", of_token.models, "Models of one token", "TOKEN_MODELS");
  add_count("--token-expressions", of_token.expressions, "Displacement sets of one token", "TOKEN_EXPRESSIONS");
  add_count("--token-streams", of_token.streams, "Streams of one token", "TOKEN_STREAMS");
  add_count("--token-recordings", of_token.recordings, "Stored recordings of one token", "TOKEN_RECORDINGS");
  add_count("--token-speeches", of_token.speeches, "Stored speeches of one token", "TOKEN_SPEECHES");
  add_count("--token-jobs", of_token.jobs, "Jobs of one token that wait or run", "TOKEN_JOBS");
  add_count("--token-uploads", of_token.uploads, "Files that one token sends at the same time", "TOKEN_UPLOADS");
  add("--max-address-connections", options->max_connections_per_address,
      "Connections of one address (of IPv6: its first 64 bits); this machine and trusted proxies have no such limit",
      "MAX_ADDRESS_CONNECTIONS")
      ->check(CLI::Range(1, 1'000'000));
  add("--max-address-handshakes", options->max_handshakes_per_address,
      "Handshakes of TLS that one address has begun and not finished; likewise", "MAX_ADDRESS_HANDSHAKES")
      ->check(CLI::Range(1, 1'000'000));
  add("--log-level", options->log_level, "debug (one line per request), info, warning or error", "LOG_LEVEL");
  add("--log-format", options->log_format, "text, or json: one object per line", "LOG_FORMAT");
}

void add_serve_command(CLI::App& app) {
  const auto options = std::make_shared<ServeOptions>();
  auto* command = app.add_subcommand(
      "serve", "Serve the studio, the REST interface and the streams. Ctrl-C (SIGINT) or SIGTERM stops it cleanly.");
  declare_serve_options(*command, *options);
  const auto sources = OptionSources::declare(*command, OptionSources::Offers::config_and_printing);
  command->callback([options, sources] {
    sources->apply();
    if (sources->should_print()) return sources->print(std::cout);
    try {
      run_serve(*options);
    } catch (const store::StoreError& fault) {
      throw CommandFailure(CommandFailure::internal, std::string("serve: --data: ") + fault.what());
    }
  });
}

}  // namespace semblante
