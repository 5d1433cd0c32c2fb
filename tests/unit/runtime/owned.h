#pragma once

#include <memory>

#include "clients/runtime/semblante.h"

namespace semblante::testing {

struct DestroyHandle {
  void operator()(semblante_head* head) const { semblante_head_destroy(head); }
  void operator()(semblante_player* player) const { semblante_player_destroy(player); }
  void operator()(semblante_performance* performance) const { semblante_performance_destroy(performance); }
  void operator()(semblante_take* take) const { semblante_take_destroy(take); }
};
using OwnedHead = std::unique_ptr<semblante_head, DestroyHandle>;
using OwnedPlayer = std::unique_ptr<semblante_player, DestroyHandle>;
using OwnedPerformance = std::unique_ptr<semblante_performance, DestroyHandle>;
using OwnedTake = std::unique_ptr<semblante_take, DestroyHandle>;

/// A frame with FAP 3 (open_jaw) alone.
inline semblante_timed_frame jaw_at(double time, float units) {
  semblante_timed_frame frame{};
  frame.time = time;
  frame.frame.fap[3] = units;
  return frame;
}

}  // namespace semblante::testing
