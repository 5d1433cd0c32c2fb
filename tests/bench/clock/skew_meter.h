#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "clients/runtime/playout.h"
#include "protocol/http/url.h"
#include "tests/support/tcp_proxy.h"

namespace semblante::testing {

struct SkewOptions {
  client::Url server;
  std::string stream = "demo";
  ProxyOptions network;  ///< its port is the server's
  std::optional<double> delay;
  std::chrono::milliseconds shown_for{20'000}, settled_after{4000};
  bool cut_half_way = false;  ///< what is shown within 2 s of it does not count
};

/// What a client showed of a real stream, in real time. Times in ms.
struct Skew {
  /// |shown - (the stream's true clock - the client's delay)| of each display frame that was on time, rising.
  std::vector<double> sorted;
  /// The same of a client that plays on from the newest message's arrival, two messages behind.
  std::vector<double> plain_sorted;
  std::size_t frames = 0, backwards = 0, connections = 0;
  /// How far off the true clock may be as we know it.
  double truth = 0;
  /// The machine's own share: display frames that it was late with (they do not count), and by how much at most; the
  /// proxy's likewise.
  std::size_t disturbed = 0;
  double worst_late = 0, worst_proxy = 0;
  runtime::PlayoutStats stats;
  double uncertainty = 0;

  [[nodiscard]] double at(double share) const {
    return sorted.empty() ? 1e9 : sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  }
  [[nodiscard]] double plain_at(double share) const {
    return plain_sorted.empty()
               ? 1e9
               : plain_sorted[static_cast<std::size_t>(share * static_cast<double>(plain_sorted.size() - 1))];
  }
  /// The machine was not so busy that it made the tail of the distribution.
  [[nodiscard]] bool calm() const;
};

/// Plays a stream of a server on this machine through a proxy. nullopt when the stream cannot be had.
std::optional<Skew> measure_skew(const SkewOptions& options);

}  // namespace semblante::testing
