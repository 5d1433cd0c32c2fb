// What a client shows of a real stream over networks that are worse and worse, beside the stream's true clock.
//   bench_clock http://127.0.0.1:8080 [seconds each, 40]

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "tests/bench/clock/skew_meter.h"

int main(int argc, char** argv) {
  using namespace semblante;
  const auto url = client::parse_url(argc > 1 ? argv[1] : "http://127.0.0.1:8080");
  const double seconds = argc > 2 ? std::atof(argv[2]) : 40;
  if (!url || !(seconds >= 8 && seconds <= 3600)) {
    std::fprintf(stderr, "usage: bench_clock http://127.0.0.1:PORT [seconds each, from 8]\n");
    return 2;
  }
  struct Network {
    const char* name;
    double delay, jitter, stalls;
    bool cut;
  };
  const std::vector<Network> networks = {{"loopback", 0, 0, 0, false},
                                         {"20 ms", 20, 0, 0, false},
                                         {"20 ms, jitter 40", 20, 40, 0, false},
                                         {"20 ms, jitter 80", 20, 80, 0, false},
                                         {"20 ms, jitter 20, 2 % stalls of 300", 20, 20, 0.02, false},
                                         {"20 ms, jitter 40, connection lost", 20, 40, 0, true}};
  std::printf("%-38s %8s %8s %8s %10s %9s %8s %8s %8s\n", "network, each way", "p50, ms", "p99, ms", "worst",
              "plain p99", "x better", "delay", "starved", "machine");
  bool fine = true;
  for (const Network& network : networks) {
    testing::SkewOptions options;
    options.server = *url;
    options.network.delay = network.delay;
    options.network.jitter = network.jitter;
    options.network.stalls = network.stalls;
    options.shown_for = std::chrono::milliseconds(static_cast<long long>(seconds * 1000));
    options.cut_half_way = network.cut;
    const auto skew = testing::measure_skew(options);
    if (!skew) {
      std::fprintf(stderr, "bench_clock: there is no stream \"%s\" at this address\n", options.stream.c_str());
      return 1;
    }
    fine = fine && skew->at(0.99) < 20 && skew->backwards == 0;
    std::printf("%-38s %8.2f %8.2f %8.2f %10.2f %9.1f %8.0f %8llu %8s\n", network.name, skew->at(0.5), skew->at(0.99),
                skew->at(1), skew->plain_at(0.99), skew->plain_at(0.99) / skew->at(0.99), skew->stats.delay,
                static_cast<unsigned long long>(skew->stats.starved), skew->calm() ? "calm" : "busy");
  }
  std::printf(fine ? "p99 < 20 ms everywhere\n" : "p99 is NOT < 20 ms everywhere\n");
  return fine ? 0 : 1;
}
