#include "tests/bench/fanout/verdict.h"

#include <array>
#include <cstdio>

namespace semblante::bench {

void Verdict::expect(bool held, const std::string& otherwise) {
  if (held) return;
  broken_ = true;
  std::printf("  BROKEN: %s\n", otherwise.c_str());
}

void Verdict::expect_whole(SubscriberPool& pool, const Timeline& timeline, const std::string& when) {
  pool.run_until_delivered();
  const PoolCounts& counts = pool.counts();
  const auto none = [&](std::uint64_t count, const char* what) {
    expect(count == 0, when + ": " + std::to_string(count) + " " + what + "; " + pool.trouble());
  };
  expect(counts.delivered > 0, when + ": nothing was delivered");
  none(counts.gaps, "messages that are not the next one");
  none(counts.replaced, "times newest state in place of frames");
  none(counts.disconnected, "subscribers disconnected");
  none(counts.refused, "subscribers refused");
  none(counts.disagreed, "messages that a decoder of its own reads otherwise");
  none(timeline.content().wrong_states(), "frames that are not what was published");
}

std::string words(const Histogram& histogram) {
  std::array<char, 120> text{};
  std::snprintf(text.data(), text.size(), "p50 %.2f, p99 %.2f, p99.9 %.2f, max %.2f ms", histogram.percentile_ms(0.5),
                histogram.percentile_ms(0.99), histogram.percentile_ms(0.999), histogram.max_ms());
  return text.data();
}

}  // namespace semblante::bench
