// What the subscribers of a stream notice of loads that have nothing to do with them: quiet phases and phases under
// pressure in turn. All phases of a kind are counted together, so that a p99 is of hundreds of batches; how much two
// halves of the quiet phases differ says what the machine does by itself.

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <ctime>
#include <thread>
#include <unistd.h>

#include "tests/bench/fanout/pressures.h"
#include "tests/bench/fanout/target.h"
#include "tests/bench/fanout/verdict.h"

namespace semblante::bench {
namespace {

/// Processor time in seconds: the server, and the clients of the attack, which are apart from those that are measured.
struct Used {
  double server = 0.0, attack = 0.0, time = 0.0;
};

double seconds_of(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

class Phases {
 public:
  Phases(SubscriberPool& pool, const SemblanteServer& server, const Options& options)
      : pool_(pool), server_(server), options_(options) {}

  void quiet(Histogram& into) {
    pool_.run_for(std::chrono::duration<double>(options_.smoke ? 0.2 : 0.7));  // the effects of the phase before end
    measure(into);
  }

  Outcome pressed(const Attack& attack, Histogram& into, Used& used) {
    std::atomic<bool> enough{false}, done{false};
    Outcome outcome;
    double attack_seconds = 0.0;
    std::thread attacker([&] {
      outcome = attack.run(enough);
      attack_seconds = seconds_of(CLOCK_THREAD_CPUTIME_ID);
      done = true;
    });
    const double before = processor_time(server_.pid()).total, begin = seconds_of(CLOCK_MONOTONIC);
    measure(into);
    used.server += processor_time(server_.pid()).total - before;
    used.time += seconds_of(CLOCK_MONOTONIC) - begin;
    enough = true;
    while (!done) pool_.run_for(std::chrono::milliseconds(20));
    attacker.join();
    used.attack += attack_seconds;
    return outcome;
  }

 private:
  void measure(Histogram& into) {
    pool_.begin_phase();
    pool_.run_for(std::chrono::duration<double>(options_.seconds));
    pool_.run_until_delivered();
    into += pool_.lateness();
  }

  SubscriberPool& pool_;
  const SemblanteServer& server_;
  const Options& options_;
};

double p99(const Histogram& histogram) { return histogram.percentile_ms(0.99); }

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
  pool.begin_measuring();
  pool.run_for(std::chrono::duration<double>(options.smoke ? 0.3 : 4.0));  // learns when batches are due
  std::printf("%zu subscribers, %d ms batches%s%s; %d rounds of %.1f s quiet, %.1f s under pressure\n", pool.live(),
              options.batch_ms, options.tls ? ", TLS" : "",
              options.apart ? ", the server on a processor of its own" : "", options.repetitions, options.seconds,
              options.seconds);
  std::printf(
      "| pressure | p99 quiet, ms | halves of it | p99 under pressure | ratio | p50 quiet, pressure | server, attack, "
      "%% "
      "of a processor | the last came to |\n|---|---|---|---|---|---|---|---|\n");

  Verdict verdict;
  Phases phases(pool, server, options);
  for (const Attack& attack : pressures(server, stream.path, options)) {
    Histogram halves[2], pressed;
    Used used;
    Outcome outcome;
    for (int round = 0; round < options.repetitions; ++round) {
      // The order alternates, so that neither half is measured earlier than the other on average.
      for (const int half : {round % 2, 1 - round % 2}) {
        phases.quiet(halves[half]);
        if (half == 1) outcome = phases.pressed(attack, pressed, used);
        verdict.expect_whole(pool, stream.timeline, attack.name);
      }
      for (const auto& broken : outcome.broken) verdict.expect(false, attack.name + ": " + broken);
    }
    Histogram quiet = halves[0];
    quiet += halves[1];
    const double ratio = p99(pressed) / p99(quiet);
    std::printf("| %s | %.2f | %.2f, %.2f | %.2f | %.3f | %.2f, %.2f | %.0f, %.0f | %s |\n", attack.name.c_str(),
                p99(quiet), p99(halves[0]), p99(halves[1]), p99(pressed), ratio, quiet.percentile_ms(0.5),
                pressed.percentile_ms(0.5), used.server * 100.0 / used.time, used.attack * 100.0 / used.time,
                outcome.words.c_str());
    std::fflush(stdout);
    if (!options.smoke) verdict.expect(ratio <= 1.1, attack.name + ": p99 of the subscribers is over a tenth worse");
    verdict.expect(pool.live() == options.subscribers, attack.name + ": subscribers are missing");
    verdict.expect(server.healthy(), attack.name + ": the server does not answer any more");
  }
  return verdict.status();
}

}  // namespace semblante::bench
