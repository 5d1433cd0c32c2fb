// Many subscribers for long.

#include <algorithm>
#include <cstdio>
#include <unistd.h>

#include "tests/bench/fanout/target.h"
#include "tests/bench/fanout/verdict.h"

namespace semblante::bench {

int soak(const Options& given) {
  Options options = given;
  if (options.subscribers == 0) options.subscribers = options.smoke ? 50 : 10'000;
  if (options.seconds == 0.0) options.seconds = options.smoke ? 2.0 : 600.0;
  if (options.batch_ms == 0) options.batch_ms = 100;

  SemblanteServer server(options);
  FedStream stream(server, options, options.seconds + 600.0);
  SubscriberPool pool(server.endpoint(), stream.path, stream.timeline);
  const auto opening = now_ns();
  pool.open(options.subscribers);
  std::printf("%zu subscribers came within %.1f s; %.0f s of %d ms batches of %.1f frames/s\n", pool.live(),
              static_cast<double>(now_ns() - opening) * 1e-9, options.seconds, options.batch_ms,
              options.feed.messages_per_second * static_cast<double>(options.feed.frames_per_message));
  pool.run_for(std::chrono::duration<double>(options.smoke ? 0.3 : 2.0));
  pool.begin_measuring();

  std::printf(
      "| s | MiB resident | delivered | gaps | replaced | disconnected | late |\n|---|---|---|---|---|---|---|\n");
  const auto begin = now_ns();
  const auto before = processor_time(server.pid()), own_before = processor_time(getpid());
  constexpr int reports = 10;
  for (int report = 1; report <= reports; ++report) {
    pool.run_for(std::chrono::duration<double>(options.seconds / reports));
    const PoolCounts& counts = pool.counts();
    std::printf("| %.0f | %.1f | %lu | %lu | %lu | %lu | %s |\n", static_cast<double>(now_ns() - begin) * 1e-9,
                static_cast<double>(resident_bytes(server.pid())) / 1048576.0, counts.delivered, counts.gaps,
                counts.replaced, counts.disconnected, words(pool.lateness()).c_str());
    std::fflush(stdout);
  }
  const double seconds = static_cast<double>(now_ns() - begin) * 1e-9;
  const auto used = processor_time(server.pid()).total - before.total;
  const auto own = processor_time(getpid()).total - own_before.total;
  const auto delivered = static_cast<double>(std::max<std::uint64_t>(1, pool.counts().delivered));
  std::printf("after the first subscriber: %s\n", words(pool.spread()).c_str());
  std::printf("server: %.2f us a message, %.1f %% of a processor; %.0f bytes a message, %.2f kbit/s a subscriber\n",
              used * 1e6 / delivered, used * 100.0 / seconds, stream.timeline.mean_bytes(),
              stream.timeline.mean_bytes() * 8e-3 * delivered / (seconds * static_cast<double>(options.subscribers)));
  std::printf("this program: %.2f us a message, %.1f %% of a processor\n", own * 1e6 / delivered,
              own * 100.0 / seconds);

  Verdict verdict;
  verdict.expect_whole(pool, stream.timeline, "soak");
  verdict.expect(pool.live() == options.subscribers, "not all subscribers are there at the end");
  verdict.expect(!stream.publisher.lost() && stream.publisher.errors() == 0, "the publisher was refused something");
  if (!options.smoke) {
    const double late = std::max(pool.lateness().percentile_ms(0.99), pool.spread().percentile_ms(0.99));
    verdict.expect(late < options.batch_ms, "p99 lateness of " + std::to_string(late) + " ms is not under one batch");
  }
  return verdict.status();
}

}  // namespace semblante::bench
