// What the subscribers of a stream notice of loads that have nothing to do with them: each is measured in turn with a
// quiet phase before and after it.

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <thread>

#include "tests/bench/fanout/median.h"
#include "tests/bench/fanout/pressures.h"
#include "tests/bench/fanout/target.h"
#include "tests/bench/fanout/verdict.h"

namespace semblante::bench {
namespace {

/// p99 of one phase, ms.
double quiet_phase(SubscriberPool& pool, const Options& options) {
  pool.run_for(std::chrono::duration<double>(options.smoke ? 0.2 : 0.7));  // what was before has ended
  pool.begin_measuring();
  pool.run_for(std::chrono::duration<double>(options.seconds));
  pool.run_until_delivered();
  return pool.lateness().percentile_ms(0.99);
}

double pressed_phase(SubscriberPool& pool, const Options& options, const Attack& attack, Outcome& outcome) {
  std::atomic<bool> enough{false}, done{false};
  pool.begin_measuring();
  std::thread attacker([&] {
    outcome = attack.run(enough);
    done = true;
  });
  pool.run_for(std::chrono::duration<double>(options.seconds));
  pool.run_until_delivered();
  const double p99 = pool.lateness().percentile_ms(0.99);
  enough = true;
  while (!done) pool.run_for(std::chrono::milliseconds(20));
  attacker.join();
  return p99;
}

}  // namespace

int pressure(const Options& given) {
  Options options = given;
  if (options.subscribers == 0) options.subscribers = options.smoke ? 50 : 1000;
  if (options.seconds == 0.0) options.seconds = options.smoke ? 0.5 : 4.0;
  if (options.batch_ms == 0) options.batch_ms = 100;
  if (options.smoke) options.repetitions = 1;
  // Messages of many bytes, so that a reader that does not read fills its buffers within the phase.
  options.feed.heavy = true;
  options.feed.frames_per_message = std::max<std::size_t>(options.feed.frames_per_message, 8);

  SemblanteServer server(options);
  FedStream stream(server, options, 3600.0);
  SubscriberPool pool(server.endpoint(), stream.path, stream.timeline);
  pool.open(options.subscribers);
  pool.run_for(std::chrono::duration<double>(options.smoke ? 0.3 : 2.0));
  std::printf("%zu subscribers, %d ms batches%s; %d rounds of %.1f s quiet, %.1f s under pressure\n", pool.live(),
              options.batch_ms, options.tls ? ", TLS" : "", options.repetitions, options.seconds, options.seconds);
  std::printf("| pressure | p99 quiet, ms | under pressure | ratio (median) | least | most | the last came to |\n");
  std::printf("|---|---|---|---|---|---|---|\n");

  Verdict verdict;
  double before = quiet_phase(pool, options);
  for (const Attack& attack : pressures(server, stream.path, options)) {
    std::vector<double> quiet, pressed, ratios;
    Outcome outcome;
    for (int round = 0; round < options.repetitions; ++round) {
      pressed.push_back(pressed_phase(pool, options, attack, outcome));
      verdict.expect_whole(pool, stream.timeline, attack.name);
      const double after = quiet_phase(pool, options);
      quiet.push_back(0.5 * (before + after));
      ratios.push_back(pressed.back() / quiet.back());
      before = after;
      for (const auto& broken : outcome.broken) verdict.expect(false, attack.name + ": " + broken);
    }
    const double ratio = median(ratios);
    std::printf("| %s | %.2f | %.2f | %.3f | %.3f | %.3f | %s |\n", attack.name.c_str(), median(quiet), median(pressed),
                ratio, *std::min_element(ratios.begin(), ratios.end()), *std::max_element(ratios.begin(), ratios.end()),
                outcome.words.c_str());
    std::fflush(stdout);
    if (!options.smoke) verdict.expect(ratio <= 1.1, attack.name + ": p99 of the subscribers is over a tenth worse");
    verdict.expect(pool.live() == options.subscribers, attack.name + ": subscribers are missing");
    verdict.expect(server.healthy(), attack.name + ": the server does not answer any more");
  }
  return verdict.status();
}

}  // namespace semblante::bench
