// Memory of subscribers that only wait.

#include <algorithm>
#include <cstdio>

#include "tests/bench/fanout/target.h"
#include "tests/bench/fanout/verdict.h"

namespace semblante::bench {
namespace {

constexpr double most_bytes = 8.0 * 1024.0;
constexpr double most_bytes_tls = 32.0 * 1024.0;  ///< with OpenSSL's state of a connection

}  // namespace

int idle(const Options& given) {
  Options options = given;
  if (options.subscribers == 0) options.subscribers = options.smoke ? 50 : 10'000;
  if (options.seconds == 0.0) options.seconds = options.smoke ? 0.3 : 3.0;
  // A keyframe so that there is a state to join, then silence for longer than this runs.
  options.feed.messages_per_second = 1e-4;

  SemblanteServer server(options);
  if (server.pid() == 0) give_up("--idle wants --pid beside --url");
  FedStream stream(server, options, 0.0);
  SubscriberPool pool(server.endpoint(), stream.path, stream.timeline);
  pool.open(1);  // what a first connection makes once is not the price of each
  pool.run_for(std::chrono::duration<double>(options.seconds));
  const auto empty = resident_bytes(server.pid());
  std::printf("| subscribers | MiB resident | bytes each |\n|---|---|---|\n| 1 | %.2f | |\n",
              static_cast<double>(empty) / 1048576.0);
  double each = 0.0;
  Verdict verdict;
  for (const std::size_t count : {options.subscribers / 10, options.subscribers}) {
    pool.open(count - std::min(count, pool.live() - 1));
    pool.run_for(std::chrono::duration<double>(options.seconds));
    const auto resident = resident_bytes(server.pid());
    each = (static_cast<double>(resident) - static_cast<double>(empty)) / static_cast<double>(count);
    std::printf("| %zu | %.2f | %.0f |\n", count, static_cast<double>(resident) / 1048576.0, each);
    std::fflush(stdout);
    verdict.expect(pool.live() == count + 1, "only " + std::to_string(pool.live()) + " are there; " + pool.trouble());
  }
  const double most = options.tls ? most_bytes_tls : most_bytes;
  if (!options.smoke)
    verdict.expect(each <= most, std::to_string(each) + " bytes a subscriber are over " + std::to_string(most));
  return verdict.status();
}

}  // namespace semblante::bench
