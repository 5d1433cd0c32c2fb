// Clients that misbehave: what those who behave feel of it, and whether the server keeps its promises.

#include <atomic>
#include <cstdio>
#include <thread>

#include "tests/bench/fanout/attacks.h"
#include "tests/bench/fanout/verdict.h"

namespace semblante::bench {

int hostile(const Options& given) {
  Options options = given;
  if (options.subscribers == 0) options.subscribers = options.smoke ? 50 : 1000;
  if (options.seconds == 0.0) options.seconds = options.smoke ? 1.0 : 5.0;

  SemblanteServer server(options);
  FedStream stream(server, options, 3600.0);
  SubscriberPool pool(server.endpoint(), stream.path, stream.timeline);
  pool.open(options.subscribers);
  pool.run_for(std::chrono::duration<double>(options.smoke ? 0.3 : 2.0));
  pool.begin_measuring();
  pool.run_for(std::chrono::duration<double>(options.seconds));

  Verdict verdict;
  std::printf("%zu subscribers, %.0f messages/s\n", pool.live(), options.feed.messages_per_second);
  std::printf("| meanwhile | the others' lateness | MiB resident | came to |\n|---|---|---|---|\n");
  const auto row = [&](const std::string& name, const std::string& outcome) {
    std::printf("| %s | %s | %.1f | %s |\n", name.c_str(), words(pool.lateness()).c_str(),
                static_cast<double>(resident_bytes(server.pid())) / 1048576.0, outcome.c_str());
    std::fflush(stdout);
  };
  row("nothing", "");
  for (const Attack& attack : attacks(server, stream.path, stream.sent, options)) {
    std::atomic<bool> enough{false}, done{false};
    Outcome outcome;
    pool.begin_measuring();
    std::thread attacker([&] {
      outcome = attack.run(enough);
      done = true;
    });
    pool.run_for(std::chrono::duration<double>(options.seconds));
    enough = true;
    while (!done) pool.run_for(std::chrono::milliseconds(50));
    attacker.join();
    row(attack.name, outcome.words);
    for (const auto& broken : outcome.broken) verdict.expect(false, attack.name + ": " + broken);
    verdict.expect_whole(pool, stream.timeline, attack.name);
    verdict.expect(pool.live() == options.subscribers, attack.name + ": subscribers are missing");
    verdict.expect(server.healthy(), attack.name + ": the server does not answer any more");
  }
  return verdict.status();
}

}  // namespace semblante::bench
