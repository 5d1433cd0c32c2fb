#pragma once

#include <chrono>
#include <string_view>
#include <thread>
#include <utility>

namespace semblante::log {

/// Logs one error line for the current exception: "<where>: <what()>". To be called in a catch block.
void caught(std::string_view where) noexcept;

/// Runs `work`. An exception of any type is logged and ends only `work`, not the thread. False when there was one.
/// Every thread of the server runs its work under this, because an uncaught exception would end the process.
template <class Work>
bool guarded(std::string_view where, Work&& work) noexcept {
  try {
    std::forward<Work>(work)();
    return true;
  } catch (...) {
    caught(where);
    return false;
  }
}

/// Runs the loop of a thread until it returns. An exception is logged and, after a delay, the loop is started again.
template <class Loop>
void keep_running(std::string_view where, Loop loop) noexcept {
  while (!guarded(where, loop)) std::this_thread::sleep_for(std::chrono::milliseconds(100));
}

}  // namespace semblante::log
