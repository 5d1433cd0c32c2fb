#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "clients/runtime/playout.h"

namespace semblante::testing {

/// A network in one direction, as TCP shows it: late, never out of order. Times in ms.
struct NetworkModel {
  const char* name = "";
  double base = 20;        ///< each message
  double jitter = 0;       ///< and evenly up to so much more
  double burst_every = 0;  ///< seconds between times (of 2 s) at which jitter is four times that
  double stalls = 0;       ///< share of the messages that have to be sent again
  double stall = 300;      ///< and what that takes
  double loss_every = 0;   ///< seconds between losses of the connection, of 1 to 5 s
  double drift = 0;        ///< of the stream's clock against the client's, ms per ms
};

struct SimulationOptions {
  double batch_interval = 100, frame_interval = 40;
  double minutes = 30;
  double settled = 5000;  ///< what is shown before counts for nothing
  std::optional<double> delay;
  std::uint64_t seed = 1;
};

/// What a viewer saw. `skew`: |shown - (true clock of the stream - the client's delay)| of every display frame, sorted.
struct SimulationResult {
  std::vector<double> skew;
  double held_share = 0;            ///< of the display frames, without those during a lost connection
  double slowest = 1, fastest = 1;  ///< speed, where it was not held and did not jump
  double mean_delay = 0, worst_clock_error = 0;
  std::uint64_t backwards = 0, snaps = 0, starved = 0, losses = 0;
  std::vector<double> shown;  ///< media time less true clock, at even moments, to compare clients by

  [[nodiscard]] double skew_at(double share) const {
    return skew[static_cast<std::size_t>(share * static_cast<double>(skew.size() - 1))];
  }
};

/// Plays a stream of even frames over a network in simulated time. The same seed gives the same result.
SimulationResult simulate(const NetworkModel& network, const SimulationOptions& options);

}  // namespace semblante::testing
