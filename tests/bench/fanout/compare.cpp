// What a delivered message costs the server: ours beside a bare epoll loop, Beast as everyone writes it, node's ws.

#include <algorithm>
#include <cstdio>
#include <map>

#include "tests/bench/fanout/median.h"
#include "tests/bench/fanout/subscriber_pool.h"
#include "tests/bench/fanout/target.h"

namespace semblante::bench {
namespace {

struct Run {
  double total = 0.0, user = 0.0, system = 0.0;  ///< us a delivered message
  double delivered = 0.0;                        ///< share of what was to be delivered
  double p50 = 0.0, p99 = 0.0, p999 = 0.0, most = 0.0;
  double bytes = 0.0;
  bool sound = true;
};

Run measure(SubscriberPool& pool, Timeline& timeline, pid_t server, const Options& options,
            double messages_per_second) {
  pool.run_for(std::chrono::duration<double>(options.smoke ? 0.3 : 1.5));
  pool.begin_measuring();
  const auto before = processor_time(server);
  const auto begin = now_ns();
  pool.run_for(std::chrono::duration<double>(options.seconds));
  pool.run_until_delivered();
  const auto after = processor_time(server);
  const double seconds = static_cast<double>(now_ns() - begin) * 1e-9;

  const PoolCounts& counts = pool.counts();
  const double messages = std::max(1.0, static_cast<double>(counts.delivered));
  Run run;
  run.total = (after.total - before.total) * 1e6 / messages;
  run.user = (after.user - before.user) * 1e6 / messages;
  run.system = (after.system - before.system) * 1e6 / messages;
  run.delivered = messages / (static_cast<double>(options.subscribers) * messages_per_second * seconds);
  run.p50 = pool.lateness().percentile_ms(0.5);
  run.p99 = pool.lateness().percentile_ms(0.99);
  run.p999 = pool.lateness().percentile_ms(0.999);
  run.most = pool.lateness().max_ms();
  run.bytes = timeline.mean_bytes();
  run.sound = counts.delivered > 0 && counts.gaps == 0 && counts.replaced == 0 && counts.disconnected == 0 &&
              counts.disagreed == 0 && timeline.content().wrong_states() == 0;
  if (!run.sound)
    std::printf(
        "  BROKEN: %lu delivered, %lu gaps, %lu replaced, %lu disconnected, %lu samples and %lu states wrong; %s\n",
        counts.delivered, counts.gaps, counts.replaced, counts.disconnected, counts.disagreed,
        timeline.content().wrong_states(), pool.trouble().c_str());
  return run;
}

/// Messages a second that a stream gives when its frames are gathered for `batch_ms`.
double messages_per_second(const Options& options) {
  if (options.batch_ms == 0) return options.feed.messages_per_second;
  return std::min(options.feed.messages_per_second, 1000.0 / options.batch_ms);
}

std::optional<Run> run_one(const std::string& name, Options options, std::size_t bytes) {
  const double rate = messages_per_second(options);
  options.tls = name.ends_with("-tls");
  if (name.starts_with("semblante")) {
    SemblanteServer server(options);
    FedStream stream(server, options, options.seconds + 600.0);
    SubscriberPool pool(server.endpoint(), stream.path, stream.timeline);
    pool.open(options.subscribers);
    return measure(pool, stream.timeline, server.pid(), options, rate);
  }
  auto server = start_rival(name, rate, bytes);
  if (!server) return std::nullopt;
  Timeline timeline(rival_content());
  SubscriberPool pool(server->endpoint(), "/", timeline);
  pool.open(options.subscribers);
  return measure(pool, timeline, server->pid(), options, rate);
}

/// Size of our messages, which the baselines' shall have.
std::size_t message_bytes(Options options) {
  options.subscribers = 1;
  SemblanteServer server(options);
  FedStream stream(server, options, 600.0);
  SubscriberPool pool(server.endpoint(), stream.path, stream.timeline);
  pool.open(1);
  while (stream.timeline.batches() < 20) pool.run_for(std::chrono::milliseconds(50));
  return static_cast<std::size_t>(stream.timeline.mean_bytes() + 0.5);
}

}  // namespace

int compare(const Options& given) {
  Options options = given;
  if (options.subscribers == 0) options.subscribers = options.smoke ? 50 : 5000;
  if (options.seconds == 0.0) options.seconds = options.smoke ? 1.0 : 8.0;
  if (options.repetitions == 0) options.repetitions = options.smoke ? 1 : 3;

  const std::size_t bytes = message_bytes(options);
  std::printf("%zu subscribers, %.0f messages/s each, %zu bytes, %d rounds of %.0f s\n", options.subscribers,
              messages_per_second(options), bytes, options.repetitions, options.seconds);
  std::map<std::string, std::vector<Run>> runs;
  bool sound = true;
  std::vector<std::string> order = options.servers;
  for (int round = 0; round < options.repetitions; ++round) {
    for (const auto& name : order) {
      const auto run = run_one(name, options, bytes);
      if (!run) continue;
      runs[name].push_back(*run);
      sound = sound && run->sound;
      std::printf("  round %d %-10s %.3f us/message (user %.2f, system %.2f), %.1f %% delivered, p99 %.2f ms\n",
                  round + 1, name.c_str(), run->total, run->user, run->system, run->delivered * 100.0, run->p99);
      std::fflush(stdout);
    }
    std::rotate(order.begin(), order.begin() + 1, order.end());
  }

  const auto middle = [&](const std::string& name, double Run::*figure) {
    std::vector<double> values;
    for (const Run& run : runs[name]) values.push_back(run.*figure);
    return median(values);
  };
  // Each round against its own bare loop: what else the machine does changes from round to round.
  const auto ratio = [&](const std::string& name) {
    std::vector<double> values;
    for (std::size_t i = 0; i < std::min(runs[name].size(), runs["epoll"].size()); ++i)
      values.push_back(runs[name][i].total / runs["epoll"][i].total);
    return median(values);
  };
  std::printf(
      "\n| server | CPU, us/message | user | system | x bare loop | delivered, %% | late p50, ms | p99 | p99.9 | max "
      "|\n");
  std::printf("|---|---|---|---|---|---|---|---|---|---|\n");
  for (const auto& name : options.servers) {
    if (runs[name].empty()) continue;
    std::printf("| %s | %.3f | %.2f | %.2f | %.2f | %.1f | %.2f | %.2f | %.2f | %.2f |\n", name.c_str(),
                middle(name, &Run::total), middle(name, &Run::user), middle(name, &Run::system), ratio(name),
                middle(name, &Run::delivered) * 100.0, middle(name, &Run::p50), middle(name, &Run::p99),
                middle(name, &Run::p999), middle(name, &Run::most));
  }
  return sound ? 0 : 1;
}

}  // namespace semblante::bench
