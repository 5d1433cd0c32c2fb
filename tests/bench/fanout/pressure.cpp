// What the subscribers of a stream notice of loads that have nothing to do with them: short quiet phases and phases
// under pressure in turn. Each phase under pressure is compared with the quiet ones right before and after it, and the
// median of these comparisons counts, so that what else the machine does falls on both or drops out. How much the quiet
// phases differ from their neighbours says what the machine does by itself.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

#include "tests/bench/fanout/median.h"
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

/// What the phases of one attack have shown: a p99 in ms each, quiet ones first and last.
struct Turns {
  std::vector<double> quiet, pressed;
  std::vector<double> quiet_medians, pressed_medians;  ///< p50

  /// Each phase under pressure as a multiple of its two neighbours.
  [[nodiscard]] std::vector<double> ratios() const {
    std::vector<double> all;
    for (std::size_t i = 0; i < pressed.size(); ++i) all.push_back(pressed[i] / std::sqrt(quiet[i] * quiet[i + 1]));
    return all;
  }
  /// The same of quiet phases: each but the outer ones.
  [[nodiscard]] std::vector<double> ratios_of_quiet() const {
    std::vector<double> all;
    for (std::size_t i = 1; i + 1 < quiet.size(); ++i) all.push_back(quiet[i] / std::sqrt(quiet[i - 1] * quiet[i + 1]));
    return all;
  }
};

/// "0.98 (0.91 to 1.07)": the median, and between what half of the values lie.
std::string median_and_half(std::vector<double> values) {
  if (values.empty()) return "-";
  std::sort(values.begin(), values.end());
  char text[64];
  std::snprintf(text, sizeof text, "%.2f (%.2f to %.2f)", median(values), values[values.size() / 4],
                values[values.size() - 1 - values.size() / 4]);
  return text;
}

}  // namespace

int pressure(const Options& given) {
  Options options = given;
  if (options.subscribers == 0) options.subscribers = options.smoke ? 50 : 1000;
  if (options.seconds == 0.0) options.seconds = options.smoke ? 0.5 : 1.5;
  if (options.batch_ms == 0) options.batch_ms = 100;
  if (options.repetitions == 0) options.repetitions = options.smoke ? 1 : 9;
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
  std::printf("%zu subscribers, %d ms batches%s%s; %d turns of %.1f s quiet, %.1f s under pressure\n", pool.live(),
              options.batch_ms, options.tls ? ", TLS" : "",
              options.apart ? ", the server on a processor of its own" : "", options.repetitions, options.seconds,
              options.seconds);
  std::printf(
      "| pressure | p99 quiet, pressure, ms | ratio, half of them | the same of quiet phases | p50 quiet, pressure | "
      "server, attack, %% of a processor | the last came to |\n|---|---|---|---|---|---|---|\n");

  Verdict verdict;
  Phases phases(pool, server, options);
  for (const Attack& attack : pressures(server, stream.path, options)) {
    Turns turns;
    Used used;
    Outcome outcome;
    const auto quiet = [&] {
      Histogram lateness;
      phases.quiet(lateness);
      turns.quiet.push_back(p99(lateness));
      turns.quiet_medians.push_back(lateness.percentile_ms(0.5));
      verdict.expect_whole(pool, stream.timeline, attack.name);
    };
    quiet();
    for (int turn = 0; turn < options.repetitions; ++turn) {
      Histogram lateness;
      outcome = phases.pressed(attack, lateness, used);
      turns.pressed.push_back(p99(lateness));
      turns.pressed_medians.push_back(lateness.percentile_ms(0.5));
      verdict.expect_whole(pool, stream.timeline, attack.name);
      for (const auto& broken : outcome.broken) verdict.expect(false, attack.name + ": " + broken);
      quiet();
    }
    const double ratio = median(turns.ratios());
    std::printf("| %s | %.1f, %.1f | %s | %s | %.1f, %.1f | %.0f, %.0f | %s |\n", attack.name.c_str(),
                median(turns.quiet), median(turns.pressed), median_and_half(turns.ratios()).c_str(),
                median_and_half(turns.ratios_of_quiet()).c_str(), median(turns.quiet_medians),
                median(turns.pressed_medians), used.server * 100.0 / used.time, used.attack * 100.0 / used.time,
                outcome.words.c_str());
    std::fflush(stdout);
    if (!options.smoke) verdict.expect(ratio <= 1.1, attack.name + ": p99 of the subscribers is over a tenth worse");
    verdict.expect(pool.live() == options.subscribers, attack.name + ": subscribers are missing");
    verdict.expect(server.healthy(), attack.name + ": the server does not answer any more");
  }
  return verdict.status();
}

}  // namespace semblante::bench
