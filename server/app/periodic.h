#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <thread>

namespace semblante {

/// Does something once per interval, on its own thread, until it is destroyed. An exception is logged under `what` and
/// ends only that turn.
class Periodic {
 public:
  Periodic(std::string what, std::chrono::milliseconds interval, std::function<void()> work);

 private:
  std::jthread thread_;
};

}  // namespace semblante
