// Thousands of subscribers of one stream, on loopback: what they cost the server and what they get.
//   bench_fanout [compare]     CPU a delivered message beside a bare epoll loop, Beast and node's ws
//   bench_fanout --soak        many subscribers for long: gaps, disconnects, lateness, memory
//   bench_fanout --idle        memory of a subscriber that only waits
//   bench_fanout --stall       what readers that stop reading do to the others
//   bench_fanout --hostile     what clients that misbehave do to the others
//   bench_fanout --pressure    how much later batches are under loads that have nothing to do with them

#include <csignal>
#include <map>

#include <CLI/CLI.hpp>
#include <sys/resource.h>

#include "tests/bench/fanout/options.h"

namespace semblante::bench {
namespace {

/// As many descriptors as the machine lets us have; children inherit it.
void raise_descriptors() {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  setrlimit(RLIMIT_NOFILE, &limit);
}

}  // namespace
}  // namespace semblante::bench

int main(int count, char** words) {
  using namespace semblante::bench;
  std::signal(SIGPIPE, SIG_IGN);
  raise_descriptors();
  Options options;
  double minutes = 0.0;
  bool is_soak = false, is_idle = false, is_stall = false, is_hostile = false, is_pressure = false;
  CLI::App app("Subscribers of one stream by the thousand, on loopback. Built for measuring servers one owns.");
  auto* modes = app.add_option_group("modes", "without one: cost of a message beside the baselines");
  modes->add_flag("--soak", is_soak, "Many subscribers for long: gaps, disconnects, lateness, memory");
  modes->add_flag("--idle", is_idle, "Memory of subscribers that only wait");
  modes->add_flag("--stall", is_stall, "What readers that stop reading do to the others");
  modes->add_flag("--hostile", is_hostile, "What clients that misbehave do to the others");
  modes->add_flag("--pressure", is_pressure,
                  "How much later batches are under loads that have nothing to do with them");
  modes->require_option(0, 1);
  app.add_option("--subscribers", options.subscribers, "How many; else as the mode has it")
      ->check(CLI::Range(1, 19'000));
  app.add_option("--rate", options.feed.messages_per_second, "Messages a second from the publisher")
      ->check(CLI::Range(0.1, 10'000.0));
  app.add_option("--frames", options.feed.frames_per_message, "Frames a message from the publisher")
      ->check(CLI::Range(1, 1024));
  app.add_flag("--heavy", options.feed.heavy, "Every FAP changes in every frame: messages of many bytes");
  app.add_option("--batch", options.batch_ms, "The stream's batch interval, ms; 0: at once")
      ->check(CLI::Range(0, 1000));
  const std::map<std::string, Coding> codings = {{"packed", Coding::packed}, {"json", Coding::json}};
  app.add_option("--coding", options.coding, "How subscribers have the stream: packed or json")
      ->transform(CLI::CheckedTransformer(codings));
  app.add_option("--seconds", options.seconds, "Of each measurement")->check(CLI::Range(0.1, 86'400.0));
  app.add_option("--minutes", minutes, "The same in minutes")->check(CLI::Range(0.01, 1'440.0));
  app.add_option("--repetitions", options.repetitions,
                 "Rounds of the comparison, turns of --pressure; else as the mode has it")
      ->check(CLI::Range(1, 100));
  app.add_option("--stalled", options.stalled, "Share of readers that stop reading")->check(CLI::Range(0.0, 0.5));
  app.add_option("--servers", options.servers, "Which to compare: " + CLI::detail::join(options.servers, ", "))
      ->delimiter(',')
      ->check(CLI::IsMember(options.servers));
  app.add_flag("--tls", options.tls, "The server listens with TLS, in the other modes");
  app.add_option("--url", options.url,
                 "A server that runs already, http://127.0.0.1:PORT or https, in place of one of our own");
  app.add_option("--pid", options.pid, "Its process, for processor time and memory");
  app.add_option("--program", options.program, "The semblante to start; else the one beside this program");
  app.add_flag("--apart", options.apart, "The server has the first processor for itself, this program the others");
  app.add_option("--only", options.only, "Those pressures that have this in their name");
  app.add_flag("--smoke", options.smoke, "Short and small, to see that it works: judges no time");
  CLI11_PARSE(app, count, words);
  if (minutes > 0.0) options.seconds = minutes * 60.0;

  if (is_soak) return soak(options);
  if (is_idle) return idle(options);
  if (is_stall) return stall(options);
  if (is_hostile) return hostile(options);
  if (is_pressure) return pressure(options);
  return compare(options);
}
