#pragma once

#include <chrono>
#include <thread>

namespace semblante::testing {

/// How long a test waits for what must happen. Far longer than it takes on the busiest machine: only a fault meets it.
constexpr std::chrono::seconds patience{600};

/// Waits until `condition` holds. False when `patience` is over before.
template <class Condition>
bool eventually(Condition condition, std::chrono::milliseconds pause = std::chrono::milliseconds(10)) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(pause);
  }
  return true;
}

}  // namespace semblante::testing
