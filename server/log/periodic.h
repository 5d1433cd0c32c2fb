#pragma once

#include <chrono>
#include <functional>
#include <stop_token>
#include <string>
#include <thread>

namespace semblante::log {

/// Does something once per interval, on its own thread, until it is destroyed. An exception is logged under `what` and
/// ends only that turn. Long work looks at the stop token.
class Periodic {
 public:
  enum class First { at_once, after_the_interval };
  using Work = std::function<void(const std::stop_token&)>;

  Periodic(std::string what, std::chrono::milliseconds interval, Work work, First first = First::after_the_interval);

 private:
  std::jthread thread_;
};

}  // namespace semblante::log
